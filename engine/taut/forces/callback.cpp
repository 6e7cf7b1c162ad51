#include "taut/forces/callback.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "taut/core/error.h"
#include "taut/spec/targets.h"

namespace taut::world {
namespace {

// A point as the function sees it.
struct Seen {
    int point = -1;  // in the island
    bool isFirst = true;
    std::string body;
    int number = -1;  // in the body
};

std::vector<Seen> pointsSeen(const std::vector<std::string>& targets, const IslandPlan& plan) {
    std::vector<Seen> seen;
    std::vector<bool> isThere(plan.points.size(), false);
    for (const Body* body : plan.bodies) {
        std::vector<bool> isWanted(body->pointOf.size(), targets.empty());
        for (const std::string& target : targets)
            if (names(target, *body))
                for (int i : selectPoints(body->model, parseTarget(target).selector)) isWanted[i] = true;
        for (std::size_t i = 0; i < isWanted.size(); ++i) {
            if (!isWanted[i]) continue;
            const auto point = static_cast<std::size_t>(body->pointOf[i]);
            seen.push_back({body->pointOf[i], !isThere[point], body->fullName(), static_cast<int>(i)});
            isThere[point] = true;
        }
    }
    return seen;
}

template <class Real>
class Callback final : public mechanics::ForceGenerator<Real> {
  public:
    using Motion = mechanics::Motion<Real>;
    Callback(std::shared_ptr<const CallbackSpec> spec, std::vector<Seen> seen)
        : spec_(std::move(spec)),
          seen_(std::move(seen)),
          x_(seen_.size()),
          v_(seen_.size()),
          f_(seen_.size()),
          mass_(seen_.size()) {}

    void addForces(const Motion& motion, int, int, Real* f) const override {
        std::fill(f_.begin(), f_.end(), dvec3(0.0));
        spec_->force(read(motion), f_);
        for (std::size_t i = 0; i < seen_.size(); ++i) {
            if (!std::isfinite(f_[i].x) || !std::isfinite(f_[i].y) || !std::isfinite(f_[i].z))
                fail("force on", i, motion.t);
            if (!seen_[i].isFirst) continue;
            for (int p = 0; p < 3; ++p) f[p * motion.stride + seen_[i].point] += static_cast<Real>(f_[i][p]);
        }
    }
    double potentialEnergy(const Motion& motion, const std::vector<bool>& only) const override {
        if (!spec_->energy) return 0.0;
        std::vector<double> energies(seen_.size(), 0.0);
        spec_->energy(read(motion), energies);
        double sum = 0;
        for (std::size_t i = 0; i < seen_.size(); ++i) {
            if (!std::isfinite(energies[i])) fail("energy of", i, motion.t);
            if (seen_[i].isFirst && (only.empty() || only[seen_[i].point])) sum += energies[i];
        }
        return sum;
    }
    void addStiffnessProduct(const Motion& motion, const Real* u, Real* out) const override {
        addScaled(motion.stride, static_cast<Real>(spec_->stiffness), u, out);
    }
    void addStability(const Motion&, mechanics::StabilityShare& share) const override {
        for (const Seen& each : seen_) {
            if (!each.isFirst) continue;
            share.stiffness[each.point] += spec_->stiffness;
            share.dampingRate[each.point] += spec_->dampingRate;
        }
    }

  private:
    CallbackPoints read(const Motion& motion) const {
        for (std::size_t i = 0; i < seen_.size(); ++i) {
            const int at = seen_[i].point, s = motion.stride;
            x_[i] = dvec3(motion.x[at], motion.x[s + at], motion.x[2 * s + at]);
            v_[i] = dvec3(motion.v[at], motion.v[s + at], motion.v[2 * s + at]);
            mass_[i] = static_cast<double>(motion.mass[at]);
        }
        return {motion.t, x_, v_, mass_};
    }
    void addScaled(int stride, Real factor, const Real* u, Real* out) const {
        for (const Seen& each : seen_)
            if (each.isFirst)
                for (int p = 0; p < 3; ++p) out[p * stride + each.point] += factor * u[p * stride + each.point];
    }
    [[noreturn]] void fail(const char* what, std::size_t i, double t) const {
        char text[120];
        std::snprintf(text, sizeof text, " at %.6g s is not finite; look for a division by 0 in the function", t);
        throw core::Error(core::ErrorKind::badContent, spec_->name + ": its " + what + " point " +
                                                           std::to_string(seen_[i].number) + " of " + seen_[i].body +
                                                           text);
    }

    std::shared_ptr<const CallbackSpec> spec_;
    std::vector<Seen> seen_;
    mutable std::vector<dvec3> x_, v_, f_;  // (seen) scratch; never used by two at a time
    mutable std::vector<double> mass_;
};

class CallbackForce final : public ForceOf<CallbackForce> {
  public:
    explicit CallbackForce(CallbackSpec spec)
        : ForceOf(spec.name), spec_(std::make_shared<const CallbackSpec>(std::move(spec))) {}
    template <class Real>
    std::unique_ptr<mechanics::ForceGenerator<Real>> make(const IslandPlan& plan) const {
        std::vector<Seen> seen = pointsSeen(spec_->targets, plan);
        if (seen.empty()) return nullptr;
        return std::make_unique<Callback<Real>>(spec_, std::move(seen));
    }
    bool isCallback() const override { return true; }

  private:
    std::shared_ptr<const CallbackSpec> spec_;
};

}  // namespace

std::shared_ptr<const Force> callbackForce(CallbackSpec spec) {
    TAUT_EXPECTS(spec.force != nullptr);
    return std::make_shared<CallbackForce>(std::move(spec));
}

}  // namespace taut::world
