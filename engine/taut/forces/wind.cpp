#include "taut/forces/wind.h"

#include <algorithm>

#include "taut/mechanics/private/wind.h"
#include "taut/spec/common_rows.h"
#include "taut/forces/force.h"
#include "taut/spec/spec.h"

namespace taut::world {

using fields::Affects;
using fields::FieldList;
using fields::Range;
using fields::Role;
using fields::Section;

namespace {

class WindForce final : public ForceOf<WindForce> {
  public:
    WindForce(const WindSpec& wind, double airDensity)
        : ForceOf(wind.fullName()),
          velocity_{wind.velocity, wind.velocity},
          targets_(wind.surroundedBodies()) {
        settings_.airDensity = airDensity;
        settings_.drag = wind.drag;
        settings_.lift = wind.lift;
        settings_.gust = {wind.gustAmplitude, wind.gustPeriod, wind.gustLength, wind.gustSeed};
    }

    template <class Real>
    std::unique_ptr<mechanics::ForceGenerator<Real>> make(const IslandPlan& plan) const {
        std::vector<std::array<int, 3>> triangles;
        std::vector<double> plateAir;  // [kg]
        bool doesFlutter = false;
        for (const Body* body : plan.bodies) {
            if (!actsOn(*body)) continue;
            doesFlutter = doesFlutter || body->model.plateAir > 0;
            for (std::size_t t = 0; t < body->model.triangles.size(); ++t) {
                if (body->damage.isTriangleGone(t)) continue;
                triangles.push_back(body->model.triangles[t]);
                const auto at = [&](std::size_t k) {
                    return body->model.positions[static_cast<std::size_t>(triangles.back()[k])];
                };
                const double area = 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
                plateAir.push_back(body->model.plateAir * area);
                for (int& i : triangles.back()) i = body->pointOf[static_cast<std::size_t>(i)];
            }
        }
        if (triangles.empty()) return nullptr;
        if (!doesFlutter) plateAir.clear();
        return std::make_unique<mechanics::Wind<Real>>(triangles, velocity_, settings_, plateAir);
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
                      .number("period_s", &WindSpec::gustPeriod, "s", Range{1e-3, 1e6}, "Time of a change.")
                      .number("length_m", &WindSpec::gustLength, "m", Range{1e-3, 1e6}, "Size of an eddy.")
                      .whole("seed", &WindSpec::gustSeed, "", Range{0.0, 1e12}, "Seed: the same gusts each time.")
                      .take();
    Section section;
    section.help = "Moving air; acts on surfaces.";
    section.fields =
        FieldList<WindSpec>()
            .vector("velocity", &WindSpec::velocity, "m/s", Range{-1e3, 1e3}, "Mean velocity.")
            .ramps(Affects::forces)
            .tableOfSelf("gust", gust, "How it changes in space and time.")
            .number("drag", &WindSpec::drag, "", Range{0.0, 100.0}, "Drag coefficient across the flow.")
            .ramps(Affects::forces)
            .number("lift", &WindSpec::lift, "", Range{0.0, 100.0}, "Lift coefficient.")
            .ramps(Affects::forces)
            .texts("on", &WindSpec::on, Role::bodies, "Bodies it acts on, e.g. \"cloth.*\"; every cloth if not given.")
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
