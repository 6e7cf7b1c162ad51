#include "taut/forces/anchor.h"

#include <algorithm>
#include <map>

#include "taut/core/error.h"
#include "taut/forces/force.h"
#include "taut/mechanics/private/anchor.h"
#include "taut/spec/common_rows.h"
#include "taut/spec/targets.h"

namespace taut::world {

using fields::Affects;
using fields::FieldList;
using fields::notNegative;
using fields::Role;
using fields::Section;

namespace {

std::vector<int> pointsIn(const std::string& target, const Body& body) {
    if (!names(target, body)) return {};
    return selectPoints(body.model, parseTarget(target).selector);
}

dvec3 rateOf(const mechanics::LinearPath& path) {
    return path.isLine ? path.to - path.from : dvec3(0.0);
}

class AnchorForce final : public ForceOf<AnchorForce> {
  public:
    explicit AnchorForce(const AnchorSpec& anchor)
        : ForceOf(anchor.fullName()),
          target_(anchor.target),
          place_{anchor.at, anchor.at},
          stiffness_(anchor.stiffness),
          damping_(anchor.damping) {}

    // Each of the bodies that share a point draws it once.
    template <class Real>
    std::unique_ptr<mechanics::ForceGenerator<Real>> make(const IslandPlan& plan) const {
        std::map<int, int> times;  // by point
        for (const Body* body : plan.bodies)
            for (int i : pointsIn(target_, *body)) ++times[body->pointOf[i]];
        if (times.empty()) return nullptr;
        std::vector<int> points;
        std::vector<double> stiffness, damping;
        for (const auto& [point, count] : times) {
            points.push_back(point);
            stiffness.push_back(count * stiffness_);
            damping.push_back(count * damping_);
        }
        auto anchor = std::make_unique<mechanics::Anchor<Real>>(points, place_.to, stiffness, damping);
        anchor->setPlace(place_);
        return anchor;
    }
    void changeEvenly(const AnchorForce& from, const AnchorForce& to, double t0, double t1) {
        const dvec3 a = from.place_.to, b = to.place_.to;
        place_ = a == b ? mechanics::LinearPath{a, a} : mechanics::LinearPath::line(a, (b - a) / (t1 - t0), t0);
    }
    // Whether it moves on from the old place with the old velocity.
    bool follows(const AnchorForce& before) const {
        return before.stiffness_ == stiffness_ && before.damping_ == damping_ && before.target_ == target_ &&
               rateOf(before.place_) == rateOf(place_) && (before.place_.isLine || before.place_.to == place_.from);
    }
    template <class Real>
    void guide(mechanics::ForceGenerator<Real>& generator) const {
        static_cast<mechanics::Anchor<Real>&>(generator).setPlace(place_);
    }
    bool isSteady() const override { return !place_.isLine; }
    void visit(StateBytes& bytes) override {
        bytes(place_);
        bytes.notNegative(stiffness_);
        bytes.notNegative(damping_);
    }

  private:
    std::string target_;
    mechanics::LinearPath place_;  // [m]
    double stiffness_, damping_;   // [N/m], [kg/s] of each point
};

}  // namespace

Section AnchorSpec::section() {
    Section section;
    section.help = "Springs of rest length 0 from points to a place.";
    section.fields =
        FieldList<AnchorSpec>()
            .text("target", &AnchorSpec::target, Role::points, "Points: KIND.NAME@SELECTOR.")
            .required()
            .vector("at", &AnchorSpec::at, "m", placeRange, "Place.")
            .ramps(Affects::forces)
            .required()
            .number("stiffness_N_per_m", &AnchorSpec::stiffness, "N/m", notNegative, "Spring constant of each point.")
            .ramps(Affects::forces)
            .number("damping_kg_per_s", &AnchorSpec::damping, "kg/s", notNegative, "Damping constant of each point.")
            .ramps(Affects::forces)
            .take();
    return section;
}

std::shared_ptr<const Force> AnchorSpec::make(const SceneSpec&) const {
    return std::make_shared<AnchorForce>(*this);
}

void AnchorSpec::checkBodies(std::span<Body* const> bodies) const {
    if (std::all_of(bodies.begin(), bodies.end(), [&](const Body* body) { return pointsIn(target, *body).empty(); }))
        throw core::Error(core::ErrorKind::badContent,
                          world::at(source) + "target = \"" + target + "\" names no point");
}

Kind<ForceSpec> anchorKind() {
    return forceKind<AnchorSpec>();
}

}  // namespace taut::world
