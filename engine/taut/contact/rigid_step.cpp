#include "taut/contact/rigid_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "taut/contact/row_arithmetic.h"

namespace taut::contact {
namespace {

constexpr double overMass = 1e6;  // k over the effective mass
constexpr int mostSteps = 16;     // of Newton in a round
constexpr int mostRounds = 4;     // of letting go what does not stick
constexpr double mostWork = 2e6;  // multiplications of a Newton step
constexpr std::size_t none = static_cast<std::size_t>(-1);

// A row, as the solids see it: u = Σ weight v + spin × arm of up to two of them.
struct Equation {
    Row* row;
    std::array<std::size_t, 2> solids{none, none};
    std::array<double, 2> weights{};
    std::array<dvec3, 2> arms{};
    std::array<dvec3, 3> axes{};       // unit: its normal, and two across
    dvec3 now{0.0}, next{0.0};         // [N s] its impulse
    dvec3 kept{0.0};                   // [N s] of it, what the energy does not speak of: friction of what slides
    dvec3 velocity{0.0}, change{0.0};  // [m/s] along the axes, with what it may close; by one Newton step
    bool presses = true;               // the first axis is in the energy
    bool sticks = true;                // so are the others

    bool has(std::size_t axis) const { return axis == 0 ? presses : sticks; }
    // (6) of solid `side`: what its velocity and spin give along an axis.
    std::array<double, 6> gradient(std::size_t side, std::size_t axis) const {
        const dvec3 way = weights[side] * axes[axis], turn = glm::cross(arms[side], axes[axis]);
        return {way.x, way.y, way.z, turn.x, turn.y, turn.z};
    }
};

// A symmetric matrix of which each row keeps what is from its first entry to the diagonal.
class Envelope {
  public:
    // first (rows): the column of the first entry.
    explicit Envelope(std::span<const std::size_t> first) : first_(first.begin(), first.end()) {
        for (std::size_t i = 0; i < first_.size(); ++i) {
            start_.push_back(values_.size());
            values_.resize(values_.size() + i - first_[i] + 1, 0.0);
        }
    }
    double& at(std::size_t i, std::size_t j) { return values_[start_[i] + j - first_[i]]; }  // first <= j <= i
    // L Lᵀ in its place. Returns whether it is positive definite.
    bool factor() {
        for (std::size_t i = 0; i < first_.size(); ++i)
            for (std::size_t j = first_[i]; j <= i; ++j) {
                double sum = at(i, j);
                for (std::size_t k = std::max(first_[i], first_[j]); k < j; ++k) sum -= at(i, k) * at(j, k);
                if (j == i && !(sum > 0)) return false;
                at(i, j) = j == i ? std::sqrt(sum) : sum / at(j, j);
            }
        return true;
    }
    // L Lᵀ x = b, in place.
    void solve(std::span<double> b) {
        for (std::size_t i = 0; i < b.size(); ++i) {
            for (std::size_t k = first_[i]; k < i; ++k) b[i] -= at(i, k) * b[k];
            b[i] /= at(i, i);
        }
        for (std::size_t i = b.size(); i-- > 0;) {
            b[i] /= at(i, i);
            for (std::size_t k = first_[i]; k < i; ++k) b[k] -= at(i, k) * b[i];
        }
    }

  private:
    std::vector<std::size_t> first_, start_;
    std::vector<double> values_;
};

class RigidStep {
  public:
    RigidStep(std::span<Row> rows, std::span<const RigidSlots> solids, const Levers& levers,
              std::span<Four> velocities)
        : solids_(solids), levers_(levers), velocities_(velocities) {
        for (Row& row : rows) take(row);
    }

    bool run() {
        if (equations_.empty() || !order()) return false;
        total_.assign(first_.size(), 0.0);
        leaveToEnergy([](const Equation& equation) { return equation.now - equation.kept; });
        for (int round = 0; round < mostRounds; ++round) {
            if (!minimise()) return false;
            if (!letGo()) break;
        }
        return apply();
    }

  private:
    void take(Row& row) {
        if (row.turns.isEmpty() || !row.shares.isEmpty() || row.softness > 0) return;
        Equation equation{&row};
        for (std::size_t k = 0; k < 4; ++k) {
            if (row.gains[k] == 0) continue;
            const auto at = std::lower_bound(solids_.begin(), solids_.end(), row.slots[k],
                                             [](const RigidSlots& solid, int slot) { return solid.slot < slot; });
            if (at == solids_.end() || at->slot != row.slots[k]) return;  // it moves, and is no solid
            const auto solid = static_cast<std::size_t>(at - solids_.begin());
            const std::size_t side = equation.solids[0] == none || equation.solids[0] == solid ? 0 : 1;
            equation.solids[side] = solid;
            equation.weights[side] += row.weights[k];
        }
        for (const Turn& turn : row.turns.of(levers_.turns))
            equation.arms[equation.solids[0] != none && solids_[equation.solids[0]].slot + 1 == turn.slot ? 0 : 1] =
                armOf(turn);
        const dvec3 normal = vectorOf(row.normal), friction = vectorOf(row.impulse);
        const dvec3 across = acrossOf(normal);
        equation.axes = {normal, across, glm::cross(normal, across)};
        const dvec3 velocity = wrong(equation);
        for (std::size_t k = 0; k < 3; ++k)
            equation.velocity[static_cast<int>(k)] = glm::dot(velocity, equation.axes[k]);
        const double pressing = row.impulse.of[3], limit = insideCone * row.friction * pressing;
        equation.presses = pressing > 0;
        if (!equation.presses && equation.velocity.x >= 0) return;
        equation.sticks = glm::dot(friction, friction) < limit * limit;
        equation.now = friction + pressing * normal;
        if (!equation.sticks) equation.kept = friction;
        equations_.push_back(equation);
    }

    // Cuthill and McKee: from a solid with fewest neighbours on, those that come next to each other stand so. Returns
    // whether the matrix is cheap enough.
    bool order() {
        const std::size_t n = solids_.size();
        std::vector<std::vector<std::size_t>> neighbours(n);
        for (const Equation& equation : equations_) {
            const auto [a, b] = equation.solids;
            if (b == none) continue;
            neighbours[a].push_back(b);
            neighbours[b].push_back(a);
        }
        for (auto& own : neighbours) {
            std::sort(own.begin(), own.end());
            own.erase(std::unique(own.begin(), own.end()), own.end());
        }
        const auto hasFewer = [&](std::size_t a, std::size_t b) {
            return std::pair(neighbours[a].size(), a) < std::pair(neighbours[b].size(), b);
        };
        std::vector<std::size_t> starts(n), queue;
        for (std::size_t s = 0; s < n; ++s) starts[s] = s;
        std::sort(starts.begin(), starts.end(), hasFewer);
        place_.assign(n, none);
        for (const std::size_t start : starts) {
            if (place_[start] != none) continue;
            std::size_t next = queue.size();
            place_[start] = next;
            queue.push_back(start);
            for (; next < queue.size(); ++next) {
                auto& own = neighbours[queue[next]];
                std::sort(own.begin(), own.end(), hasFewer);
                for (const std::size_t s : own) {
                    if (place_[s] != none) continue;
                    place_[s] = queue.size();
                    queue.push_back(s);
                }
            }
        }
        first_.clear();
        double work = 0;
        for (const std::size_t s : queue) {
            std::size_t lowest = place_[s];
            for (const std::size_t other : neighbours[s]) lowest = std::min(lowest, place_[other]);
            const double width = 6.0 * static_cast<double>(place_[s] - lowest + 1);
            work += 6.0 * width * width;
            first_.insert(first_.end(), 6, 6 * lowest);
        }
        return work < mostWork;
    }

    void give(const Equation& equation, const dvec3& impulse) { push(*equation.row, impulse, velocities_, levers_); }
    static double stiffnessOf(const Equation& equation) { return overMass * equation.row->mass; }
    // [m/s] what is wrong with a row.
    dvec3 wrong(const Equation& equation) const {
        return relativeVelocity(*equation.row, velocities_, levers_) + equation.row->closing * equation.axes[0];
    }
    // Calls each(place in the matrix, axis of `equation`, its gradient).
    template <class Each>
    void forEachGradient(const Equation& equation, std::size_t axis, const Each& each) const {
        for (std::size_t side = 0; side < 2 && equation.solids[side] != none; ++side)
            each(6 * place_[equation.solids[side]], equation.gradient(side, axis));
    }
    // M times a change.
    std::vector<double> timesMass(std::span<const double> change) const {
        std::vector<double> product(change.size());
        for (std::size_t s = 0; s < solids_.size(); ++s) {
            const std::size_t at = 6 * place_[s];
            const dvec3 turn = solids_[s].inertia * dvec3(change[at + 3], change[at + 4], change[at + 5]);
            for (std::size_t i = 0; i < 3; ++i) {
                product[at + i] = solids_[s].mass * change[at + i];
                product[at + 3 + i] = turn[static_cast<int>(i)];
            }
        }
        return product;
    }

    // Adds to total_ what impulseOf() each has done to the velocities.
    template <class ImpulseOf>
    void leaveToEnergy(const ImpulseOf& impulseOf) {
        const auto addMotion = [&](double sign) {
            for (std::size_t s = 0; s < solids_.size(); ++s)
                for (std::size_t i = 0; i < 6; ++i)
                    total_[6 * place_[s] + i] +=
                        sign * velocities_[static_cast<std::size_t>(solids_[s].slot) + i / 3].of[i % 3];
        };
        addMotion(1.0);
        for (const Equation& equation : equations_) give(equation, -impulseOf(equation));
        addMotion(-1.0);
        for (const Equation& equation : equations_) give(equation, impulseOf(equation));
    }

    // Newton's method. Returns whether it can be done.
    bool minimise() {
        bool isDone = false;
        for (int step = 0; step < mostSteps && !isDone; ++step) {
            if (!findStep()) return false;
            const double share = shareOfStep();
            isDone = goOn(share) && share == 1.0;
        }
        return true;
    }
    // [N s] with what the rows see.
    static double pressingOf(const Equation& equation) {
        return stiffnessOf(equation) * std::max(-equation.velocity.x, 0.0);
    }
    static dvec3 frictionOf(const Equation& equation) {
        const dvec3& v = equation.velocity;
        return equation.sticks ? -stiffnessOf(equation) * (v.y * equation.axes[1] + v.z * equation.axes[2])
                               : equation.kept;
    }
    // What is beyond the cone of friction slides. Returns whether there was any.
    bool letGo() {
        constexpr double nearly = 1.001;
        bool isAny = false;
        for (Equation& equation : equations_) {
            const dvec3 friction = frictionOf(equation);
            const double limit = equation.row->friction * pressingOf(equation);
            const double room = (equation.sticks ? 1.0 : nearly) * limit;
            equation.next = equation.kept;  // as it was
            if (glm::dot(friction, friction) <= room * room) continue;
            equation.sticks = false;
            equation.kept = withinCone(friction, limit);
            isAny = true;
        }
        if (isAny) leaveToEnergy([](const Equation& equation) { return equation.next - equation.kept; });
        return isAny;
    }

    // Newton's step -> step_, changes of the rows. Returns whether there is one.
    bool findStep() {
        Envelope matrix(first_);
        step_ = timesMass(total_);
        for (std::size_t s = 0; s < solids_.size(); ++s) {
            const std::size_t at = 6 * place_[s];
            for (std::size_t i = 0; i < 3; ++i) {
                matrix.at(at + i, at + i) += solids_[s].mass;
                for (std::size_t j = 0; j <= i; ++j)
                    matrix.at(at + 3 + i, at + 3 + j) += solids_[s].inertia[static_cast<int>(j)][static_cast<int>(i)];
            }
        }
        for (const Equation& equation : equations_)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (!equation.has(axis)) continue;
                const double k = stiffnessOf(equation), off = k * equation.velocity[static_cast<int>(axis)];
                forEachGradient(equation, axis, [&](std::size_t row, const std::array<double, 6>& own) {
                    for (std::size_t i = 0; i < 6; ++i) step_[row + i] += off * own[i];
                    forEachGradient(equation, axis, [&](std::size_t column, const std::array<double, 6>& other) {
                        for (std::size_t i = 0; i < 6; ++i)
                            for (std::size_t j = 0; j < 6 && column + j <= row + i; ++j)
                                matrix.at(row + i, column + j) += k * own[i] * other[j];
                    });
                });
            }
        if (!matrix.factor()) return false;
        for (double& own : step_) own = -own;
        matrix.solve(step_);
        for (Equation& equation : equations_) {
            equation.change = dvec3(0.0);
            for (std::size_t axis = 0; axis < 3; ++axis)
                forEachGradient(equation, axis, [&](std::size_t row, const std::array<double, 6>& own) {
                    for (std::size_t i = 0; i < 6; ++i)
                        equation.change[static_cast<int>(axis)] += own[i] * step_[row + i];
                });
        }
        return true;
    }

    // The share of the step for which the energy is least: where its slope is 0, which only grows.
    double shareOfStep() const {
        const std::vector<double> heavy = timesMass(step_);
        double at0 = 0, rise = 0;
        for (std::size_t i = 0; i < step_.size(); ++i) {
            at0 += heavy[i] * total_[i];
            rise += heavy[i] * step_[i];
        }
        const auto slopeAt = [&](double share) {
            double slope = at0 + share * rise;
            for (const Equation& equation : equations_) {
                const dvec3 velocity = equation.velocity + share * equation.change;
                double sum = std::min(velocity.x, 0.0) * equation.change.x;
                if (equation.sticks) sum += velocity.y * equation.change.y + velocity.z * equation.change.z;
                slope += stiffnessOf(equation) * sum;
            }
            return slope;
        };
        constexpr double settled = 1e-6;  // of the slope at 0
        if (slopeAt(1.0) <= settled * std::abs(slopeAt(0.0))) return 1.0;
        double low = 0, high = 1;
        for (int k = 0; k < 30; ++k) {
            const double middle = 0.5 * (low + high);
            (slopeAt(middle) < 0 ? low : high) = middle;
        }
        return low;
    }

    // Takes a share of the step. Returns whether the same rows press as before.
    bool goOn(double share) {
        for (std::size_t i = 0; i < step_.size(); ++i) total_[i] += share * step_[i];
        bool isSame = true;
        for (Equation& equation : equations_) {
            equation.velocity += share * equation.change;
            const bool presses = equation.velocity.x < 0;
            isSame = isSame && presses == equation.presses;
            equation.presses = presses;
        }
        return isSame;
    }

    // (change of λ) · (u + closing n), summed: the slope of the energy of the motion along the change.
    double slope() const {
        double sum = 0;
        for (const Equation& equation : equations_) sum += glm::dot(equation.next - equation.now, wrong(equation));
        return sum;
    }
    void giveAll(double share) {
        for (const Equation& equation : equations_) give(equation, share * (equation.next - equation.now));
    }

    // Takes the impulses, within the cone of friction, as far as the energy of the motion falls. Returns whether it
    // does.
    bool apply() {
        for (Equation& equation : equations_) {
            const double pressing = pressingOf(equation);
            equation.next =
                withinCone(frictionOf(equation), equation.row->friction * pressing) + pressing * equation.axes[0];
        }
        const double before = slope();
        giveAll(1.0);
        const double rise = slope() - before;
        const double share = before < 0 && rise > 0 ? std::min(-before / rise, 1.0) : 0.0;
        giveAll(share - 1.0);
        for (const Equation& equation : equations_) {
            const dvec3& normal = equation.axes[0];
            const dvec3 impulse = equation.now + share * (equation.next - equation.now);
            const double pressing = std::max(glm::dot(impulse, normal), 0.0);
            const dvec3 friction = impulse - glm::dot(impulse, normal) * normal;
            equation.row->impulse = {{friction.x, friction.y, friction.z, pressing}};
        }
        return share > 0;
    }

    static constexpr double insideCone = 0.999;  // up to there it sticks

    std::span<const RigidSlots> solids_;
    const Levers& levers_;
    std::span<Four> velocities_;
    std::vector<Equation> equations_;
    std::vector<std::size_t> place_;    // (solids) in the matrix
    std::vector<std::size_t> first_;    // (six rows a solid) see Envelope
    std::vector<double> total_, step_;  // (six rows a solid) [m/s, rad/s] δ, and Newton's step
};

}  // namespace

bool stepRigidly(std::span<Row> rows, std::span<const RigidSlots> solids, const Levers& levers,
                 std::span<Four> velocities) {
    return RigidStep(rows, solids, levers, velocities).run();
}

}  // namespace taut::contact
