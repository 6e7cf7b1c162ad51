#include "taut/forces/filling.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "taut/core/error.h"
#include "taut/forces/force.h"
#include "taut/mechanics/private/filling.h"
#include "taut/plan/private/pins.h"
#include "taut/spec/common_rows.h"
#include "taut/spec/spec.h"
#include "taut/spec/targets.h"

namespace taut::world {

using fields::Affects;
using fields::FieldList;
using fields::Range;
using fields::Role;
using fields::Section;
using mechanics::Chamber;
using mechanics::FillingKeeps;

namespace {

bool isIn(const FillingSpec& filling, const Body& body) {
    return !body.model.triangles.empty() &&
           std::any_of(
               filling.in.begin(), filling.in.end(), [&](const std::string& target) { return names(target, body); });
}

// (points) One of the points that welds keep in one place, or seams, also before they are closed.
std::vector<int> sewnPoints(const IslandPlan& plan) {
    std::vector<int> one(plan.points.size());
    std::iota(one.begin(), one.end(), 0);
    const auto isPin = [&](const JointTie::Part& part) {
        return dynamic_cast<const Pins*>(plan.constraints[part.constraint].get()) != nullptr;
    };
    for (const JointTie& tie : plan.ties) {
        if (tie.b < 0 || !holds(plan, tie) || std::none_of(tie.parts.begin(), tie.parts.end(), isPin)) continue;
        const int kept = one[tie.a], other = one[tie.b];
        std::replace(one.begin(), one.end(), other, kept);
    }
    return one;
}

bool isDamaged(const IslandPlan& plan) {
    return std::any_of(
               plan.bodies.begin(), plan.bodies.end(), [](const Body* b) { return !b->damage.isEmpty(); }) ||
           std::any_of(
               plan.ties.begin(), plan.ties.end(), [&](const JointTie& tie) { return !holds(plan, tie); });
}

class FillingForce final : public ForceOf<FillingForce> {
  public:
    FillingForce(const FillingSpec& filling, const WorldSpec& world)
        : ForceOf(filling.fullName()),
          spec_(filling),
          law_{filling.keeps, world.airPressure, world.sealedPressure, filling.bulkModulus},
          pressure_{filling.pressure, filling.pressure} {}

    // A body that is cut or torn open holds nothing any more.
    template <class Real>
    std::unique_ptr<mechanics::ForceGenerator<Real>> make(const IslandPlan& plan) const {
        std::vector<std::array<int, 3>> triangles;
        std::vector<dvec3> places(plan.points.size(), dvec3(0.0));
        for (const Body* body : plan.bodies) {
            if (!isIn(spec_, *body)) continue;
            for (std::size_t i = 0; i < body->pointOf.size(); ++i) places[body->pointOf[i]] = body->model.positions[i];
            for (std::size_t t = 0; t < body->model.triangles.size(); ++t) {
                if (body->damage.isTriangleGone(t)) continue;
                triangles.push_back(body->model.triangles[t]);
                for (int& i : triangles.back()) i = body->pointOf[i];
            }
        }
        std::vector<Chamber> chambers = mechanics::chambersOf(triangles, places, sewnPoints(plan));
        if (!isDamaged(plan))
            for (const Chamber& chamber : chambers) check(chamber, plan, places);
        std::erase_if(chambers, [](const Chamber& chamber) { return !chamber.isClosed(); });
        if (chambers.empty()) return nullptr;
        return std::make_unique<mechanics::Filling<Real>>(std::move(chambers), places, law_, pressure_);
    }
    void changeEvenly(const FillingForce& from, const FillingForce& to, double t0, double t1) {
        pressure_ = mechanics::LinearPathOf<double>::between(from.pressure_.to, to.pressure_.to, t0, t1);
    }
    bool follows(const FillingForce& before) const {
        return before.law_ == law_ && before.pressure_.to == pressure_.from;
    }
    template <class Real>
    void guide(mechanics::ForceGenerator<Real>& generator) const {
        static_cast<mechanics::Filling<Real>&>(generator).setPressure(pressure_);
    }
    bool isSteady() const override { return true; }
    void visit(StateBytes& bytes) override {
        bytes(pressure_);
        bytes.notNegative(law_.outside);
        bytes.notNegative(law_.sealedIn);
        bytes.notNegative(law_.bulkModulus);
    }

  private:
    void check(const Chamber& chamber, const IslandPlan& plan, const std::vector<dvec3>& places) const {
        const auto fail = [&](const std::string& what) {
            const int point = chamber.triangles.front()[0];
            const dvec3& place = places[point];
            throw core::Error(core::ErrorKind::badContent,
                              at(spec_.source) + fmt::format("{}: the surface of {} at [{:.3g}, {:.3g}, {:.3g}] {}",
                                                             name(), authored(plan, point).first->fullName(), place.x,
                                                             place.y, place.z, what));
        };
        if (chamber.openEdges > 0)
            fail(fmt::format(
                "is open along {} edges, so that it encloses nothing; close the mesh, or weld or sew the edges of "
                "its parts",
                chamber.openEdges));
        if (chamber.isTwisted) fail("has only one side, like a Möbius strip, and encloses nothing");
        if (law_.keeps == FillingKeeps::amount && law_.sealedIn + pressure_.to < 0)
            fail(fmt::format("would have a negative pressure: pressure_Pa = {:.6g}, and world.air_pressure_Pa = {:.6g}",
                             pressure_.to, law_.sealedIn));
        if (law_.keeps != FillingKeeps::pressure && !(chamber.firstVolume > 0))
            fail("is flat when the scene starts, and has no volume to keep; keeps = \"pressure\" inflates it");
    }

    FillingSpec spec_;
    mechanics::FillingLaw law_;
    mechanics::LinearPathOf<double> pressure_;  // [Pa]
};

}  // namespace

Section FillingSpec::section() {
    Section section;
    section.help = "A gas or liquid in a closed surface; cut or torn surfaces hold none.";
    section.variantKey = "keeps";
    section.variant = [](const fields::Node& table) {
        const std::string own = table.textAt("keeps");
        return own.empty() ? "pressure" : own;
    };
    section.fields = FieldList<FillingSpec>()
                         .texts("in", &FillingSpec::in, Role::bodies,
                                "Bodies whose surfaces enclose it, alone, welded or sewn together; each closed part "
                                "has its own filling.")
                         .required()
                         .number("pressure_Pa", &FillingSpec::pressure, "Pa", Range{-1e5, 1e7},
                                 "Pressure above that of the air outside, at the initial volume.")
                         .ramps(Affects::forces)
                         .choice("keeps", &FillingSpec::keeps, {"pressure", "amount", "volume"},
                                 "Conserved quantity: the pressure, as of a pump; the amount of a sealed gas, pressure "
                                 "times volume; or the volume, as of a liquid.")
                         .number("bulk_modulus_Pa", &FillingSpec::bulkModulus, "Pa", Range{1.0, 1e10},
                                 "Pressure per relative change of a kept volume.")
                         .only({"volume"})
                         .take();
    return section;
}

std::shared_ptr<const Force> FillingSpec::make(const SceneSpec& scene) const {
    return std::make_shared<FillingForce>(*this, scene.world);
}

void FillingSpec::checkBodies(std::span<Body* const> bodies) const {
    if (in.empty())
        throw core::Error(core::ErrorKind::badContent,
                          world::at(source) + "in is empty; name the bodies that hold it, e.g. in = [\"cloth.ball\"]");
    for (const std::string& target : in)
        if (std::none_of(bodies.begin(), bodies.end(),
                         [&](const Body* body) { return names(target, *body) && !body->model.triangles.empty(); }))
            throw core::Error(core::ErrorKind::badContent,
                              world::at(source) + "in = \"" + target + "\" names no body with a surface");
}

Kind<ForceSpec> fillingKind() {
    return forceKind<FillingSpec>();
}

}  // namespace taut::world
