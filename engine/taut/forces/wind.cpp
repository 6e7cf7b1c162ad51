#include "taut/forces/wind.h"

#include <algorithm>

#include "taut/core/trig.h"
#include "taut/forces/force.h"
#include "taut/mechanics/private/wind.h"
#include "taut/mechanics/rigid.h"
#include "taut/spec/common_rows.h"
#include "taut/spec/spec.h"

namespace taut::world {

using fields::Affects;
using fields::FieldList;
using fields::Range;
using fields::Role;
using fields::Section;

namespace {

// The triangles of a surface, or, where it has none, its springs as rods and the ends of a round solid as balls.
void addTo(mechanics::WindTargets& targets, const Body& body, const mechanics::RigidPart& surface) {
    const mechanics::Model& model = body.model;
    const bool hasInside = body.spec->isRigid() || !model.cells.empty();
    const auto pointOf = [&](int i) { return body.pointOf[i]; };
    const auto isOfSurface = [&](int i) { return i >= surface.first && i < surface.last; };
    const double rounding = surface.rounding;
    std::vector<dvec3> rounded;  // corners of faces that lie farther out than the triangles
    if (rounding > 0) rounded = mechanics::withFacesOutward(model.positions, model.triangles, rounding);
    bool hasTriangles = false;
    for (std::size_t t = 0; t < model.triangles.size(); ++t) {
        const std::array<int, 3>& corners = model.triangles[t];
        if (!isOfSurface(corners[0])) continue;
        hasTriangles = true;
        if (body.damage.isTriangleGone(t)) continue;
        const auto areaOf = [&](std::span<const dvec3> x) {
            const auto at = [&](std::size_t k) { return x[corners[k]]; };
            return 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
        };
        const double area = areaOf(model.positions);
        targets.triangles.push_back({pointOf(corners[0]), pointOf(corners[1]), pointOf(corners[2])});
        targets.sides.push_back((hasInside ? 0.5 : 1.0) * (rounding > 0 ? areaOf(rounded) / area : 1.0));
        targets.plateAir.push_back(model.plateAir * area);
    }
    if (hasTriangles) return;
    const double radius = surface.thickness;
    for (const mechanics::Spring& spring : model.springs)
        if (isOfSurface(spring.a) && spring.kind == mechanics::SpringKind::structural &&
            !body.damage.isSevered(spring.a, spring.b))
            targets.rounds.push_back({.a = pointOf(spring.a), .b = pointOf(spring.b), .width = 2 * radius});
    if (!body.spec->isRigid()) return;
    const int ends = surface.last - surface.first;
    for (int i = surface.first; i < surface.last; ++i)
        targets.rounds.push_back({.a = pointOf(i), .b = pointOf(i), .area = core::pi * radius * radius / ends});
}

class WindForce final : public ForceOf<WindForce> {
  public:
    WindForce(const WindSpec& wind, double airDensity)
        : ForceOf(wind.fullName()), velocity_{wind.velocity, wind.velocity}, targets_(wind.surroundedBodies()) {
        settings_.airDensity = airDensity;
        settings_.drag = wind.drag;
        settings_.lift = wind.lift;
        settings_.gust = {wind.gustAmplitude, wind.gustPeriod, wind.gustLength, wind.gustSeed};
    }

    template <class Real>
    std::unique_ptr<mechanics::ForceGenerator<Real>> make(const IslandPlan& plan) const {
        mechanics::WindTargets targets;
        bool doesFlutter = false;
        for (const Body* body : plan.bodies) {
            if (!actsOn(*body)) continue;
            doesFlutter = doesFlutter || body->model.plateAir > 0;
            for (const mechanics::RigidPart& surface : surfacesOf(*body)) addTo(targets, *body, surface);
        }
        if (targets.triangles.empty() && targets.rounds.empty()) return nullptr;
        if (!doesFlutter) targets.plateAir.clear();
        return std::make_unique<mechanics::Wind<Real>>(targets, velocity_, settings_);
    }
    void changeEvenly(const WindForce& from, const WindForce& to, double t0, double t1) {
        velocity_ = mechanics::LinearPath::between(from.velocity_.to, to.velocity_.to, t0, t1);
    }
    bool follows(const WindForce& before) const {
        return before.settings_ == settings_ && before.targets_ == targets_ && before.velocity_.to == velocity_.from;
    }
    template <class Real>
    void guide(mechanics::ForceGenerator<Real>& generator) const {
        static_cast<mechanics::Wind<Real>&>(generator).setVelocity(velocity_);
    }
    bool isSteady() const override { return settings_.gust.amplitude == 0.0; }
    void visit(StateBytes& bytes) override {
        bytes(velocity_);
        mechanics::WindSettings& s = settings_;
        for (double* number : {&s.airDensity, &s.drag, &s.lift, &s.gust.amplitude, &s.gust.period, &s.gust.length})
            bytes(*number);
        bytes(s.gust.seed);
    }

  private:
    bool actsOn(const Body& body) const {
        return std::any_of(
            targets_.begin(), targets_.end(), [&](const std::string& t) { return names(t, body); });
    }

    mechanics::LinearPath velocity_;  // [m/s]
    mechanics::WindSettings settings_;
    std::vector<std::string> targets_;  // bodies
};

}  // namespace

Section WindSpec::section() {
    Section gust;
    gust.fields = FieldList<WindSpec>()
                      .number("amplitude", &WindSpec::gustAmplitude, "m/s", Range{0.0, 1e3}, "Strength.")
                      .ramps(Affects::forces)
                      .number("period_s", &WindSpec::gustPeriod, "s", Range{1e-3, 1e6}, "Period of a gust.")
                      .number("length_m", &WindSpec::gustLength, "m", Range{1e-3, 1e6}, "Size of an eddy.")
                      .whole("seed", &WindSpec::gustSeed, "", Range{0.0, 1e12}, "Seed of the gusts.")
                      .take();
    Section section;
    section.help = "Moving air.";
    section.fields =
        FieldList<WindSpec>()
            .vector("velocity", &WindSpec::velocity, "m/s", Range{-1e3, 1e3}, "Mean velocity.")
            .ramps(Affects::forces)
            .tableOfSelf("gust", gust, "Variation in space and time.")
            .number("drag", &WindSpec::drag, "", Range{0.0, 100.0}, "Drag coefficient across the flow.")
            .ramps(Affects::forces)
            .number("lift", &WindSpec::lift, "", Range{0.0, 100.0}, "Lift coefficient.")
            .ramps(Affects::forces)
            .texts("on", &WindSpec::on, Role::anyBodies, "Bodies it acts on, e.g. \"cloth.*\"; default every cloth.")
            .take();
    return section;
}

std::vector<std::string> WindSpec::surroundedBodies() const {
    return on.empty() ? std::vector<std::string>{"cloth.*"} : on;
}

std::shared_ptr<const Force> WindSpec::make(const SceneSpec& scene) const {
    if (drag == 0.0 && lift == 0.0) return nullptr;
    return std::make_shared<WindForce>(*this, scene.world.airDensity);
}

Kind<ForceSpec> windKind() {
    return forceKind<WindSpec>();
}

}  // namespace taut::world
