#include "taut/mechanics/wind.h"

#include <algorithm>

#include "taut/world/forces/scene_forces.h"
#include "taut/world/targets.h"

namespace taut::world {
namespace {

class WindForce final : public ForceOf<WindForce> {
  public:
    WindForce(const WindSpec& wind, double airDensity)
        : ForceOf("wind." + wind.name),
          velocity_{wind.velocity, wind.velocity},
          targets_(wind.on.empty() ? std::vector<std::string>{"cloth.*"} : wind.on) {
        settings_.airDensity = airDensity;
        settings_.drag = wind.drag;
        settings_.lift = wind.lift;
        settings_.gust = {wind.gustAmplitude, wind.gustPeriod, wind.gustLength, wind.gustSeed};
    }

    template <class Real>
    std::unique_ptr<mechanics::ForceGenerator<Real>> make(const IslandPlan& plan) const {
        std::vector<std::array<int, 3>> triangles;
        for (const Body* body : plan.bodies) {
            if (!actsOn(*body)) continue;
            for (std::size_t t = 0; t < body->model.triangles.size(); ++t) {
                if (body->damage.isTriangleGone(t)) continue;
                triangles.push_back(body->model.triangles[t]);
                for (int& i : triangles.back()) i = body->pointOf[static_cast<std::size_t>(i)];
            }
        }
        if (triangles.empty()) return nullptr;
        return std::make_unique<mechanics::Wind<Real>>(triangles, velocity_, settings_);
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
    void visit(StateBytes& bytes) override {
        bytes(velocity_);
        mechanics::WindSettings& s = settings_;
        for (double* number : {&s.airDensity, &s.drag, &s.lift, &s.gust.amplitude, &s.gust.period, &s.gust.length})
            bytes(*number);
        bytes(s.gust.seed);
    }

  private:
    bool actsOn(const Body& body) const {
        return std::any_of(targets_.begin(), targets_.end(), [&](const std::string& t) { return names(t, body); });
    }

    mechanics::LinearPath velocity_;  // [m/s]
    mechanics::WindSettings settings_;
    std::vector<std::string> targets_;  // bodies
};

}  // namespace

std::shared_ptr<const Force> windForce(const WindSpec& wind, double airDensity) {
    if (wind.drag == 0.0 && wind.lift == 0.0) return nullptr;
    return std::make_shared<WindForce>(wind, airDensity);
}

}  // namespace taut::world
