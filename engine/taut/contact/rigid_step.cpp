#include "taut/contact/rigid_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "taut/contact/row_arithmetic.h"

namespace taut::contact {
namespace {

constexpr int mostSteps = 30;         // of the interior point method
constexpr double mostWork = 2e6;      // multiplications of a step
constexpr double softness = 1e-6;     // of the inverse effective mass: what nothing satisfies stays finite
constexpr double nearlyToEdge = 0.9;  // share of the way to the edge of a cone that a step may take
constexpr std::size_t none = static_cast<std::size_t>(-1);

using glm::dmat3;
using Six = std::array<double, 6>;

// The cone x.x >= |(x.y, x.z)|, with the algebra in which x ∘ x lies in it: (x·y, x.x y' + y.x x'). One is (1, 0, 0).
double determinantOf(const dvec3& x) {
    return x.x * x.x - x.y * x.y - x.z * x.z;
}
dvec3 product(const dvec3& a, const dvec3& b) {
    return {glm::dot(a, b), a.x * b.y + b.x * a.y, a.x * b.z + b.x * a.z};
}
// x with a ∘ x = b.
dvec3 quotient(const dvec3& b, const dvec3& a) {
    const double first = (a.x * b.x - a.y * b.y - a.z * b.z) / determinantOf(a);
    return {first, (b.y - first * a.y) / a.x, (b.z - first * a.z) / a.x};
}
// How many times `way` one can go from x within the cone; at most 1e300.
double roomOf(const dvec3& x, const dvec3& way) {
    const double a = determinantOf(way), c = determinantOf(x), b = x.x * way.x - x.y * way.y - x.z * way.z;
    const double most = std::sqrt(std::max(b * b - a * c, 0.0)) - b;
    return most > 0 ? c / most : 1e300;
}

// The scaling of Nesterov and Todd: a symmetric W, a reflection and a factor, with W z = W⁻¹ s for s, z in the
// cone.
struct Scaling {
    double factor = 1;
    dvec3 axis{1, 0, 0};

    static Scaling between(const dvec3& s, const dvec3& z) {
        const double sizeS = std::sqrt(determinantOf(s)), sizeZ = std::sqrt(determinantOf(z));
        const dvec3 unitS = s / sizeS, unitZ = z / sizeZ;
        const dvec3 sum(unitS.x + unitZ.x, unitS.y - unitZ.y, unitS.z - unitZ.z);
        return {std::sqrt(sizeS / sizeZ), sum / std::sqrt(2.0 * (1.0 + glm::dot(unitS, unitZ)))};
    }
    dvec3 apply(const dvec3& x) const { return factor * turned(axis, x); }
    dvec3 undo(const dvec3& x) const { return turned({axis.x, -axis.y, -axis.z}, x) / factor; }
    // W²
    dmat3 square() const {
        dmat3 square = 2.0 * glm::outerProduct(axis, axis);
        square[0][0] -= 1.0;
        square[1][1] += 1.0;
        square[2][2] += 1.0;
        return factor * factor * square;
    }

  private:
    static dvec3 turned(const dvec3& w, const dvec3& x) {
        const double across = w.y * x.y + w.z * x.z, more = x.x + across / (1.0 + w.x);
        return {w.x * x.x + across, x.y + more * w.y, x.z + more * w.z};
    }
};

// A row, as the solids see it: u = Σ weight v + spin × arm of up to two of them. The coordinates of s and z are along
// its axes, and such that both lie in the same cone: z is the impulse by which (n, μ t, μ b) go, s is
// (n·u + closing, μ t·u, μ b·u) + softness z.
struct Equation {
    Row* row = nullptr;
    std::array<std::size_t, 2> solids{none, none};
    std::array<dvec3, 3> axes{};                    // unit: its normal, and two across
    std::array<std::array<Six, 3>, 2> gradients{};  // (sides, axes) what velocity and spin of a side give to s
    dvec3 now{0.0}, next{0.0};                      // [N s] its impulse
    dvec3 offset{0.0};                              // [m/s] s without any impulses of these rows
    dvec3 s{0.0}, z{0.0}, wayS{0.0}, wayZ{0.0};     // [m/s], [N s], and by a step
    Scaling scaling;
    dvec3 scaled{0.0};    // W z
    double softness = 0;  // [1/kg]
    dmat3 weight{0.0};    // (W² + softness)⁻¹

    dvec3 impulse() const { return z.x * axes[0] + row->friction * (z.y * axes[1] + z.z * axes[2]); }
};

using Block = std::array<Six, 6>;  // of a matrix, transposed: columns of it stand together

// A symmetric matrix of blocks, of which each row keeps what is from its first block to the diagonal.
class Envelope {
  public:
    // first (rows of blocks): the column of the first.
    explicit Envelope(std::span<const std::size_t> first) : first_(first.begin(), first.end()) {
        for (std::size_t i = 0; i < first_.size(); ++i) {
            start_.push_back(blocks_.size());
            blocks_.resize(blocks_.size() + i - first_[i] + 1);
        }
    }
    void clear() { std::fill(blocks_.begin(), blocks_.end(), Block{}); }
    Block& at(std::size_t i, std::size_t j) { return blocks_[start_[i] + j - first_[i]]; }  // first <= j <= i
    // L Lᵀ in its place. Returns whether it is positive definite.
    bool factor() {
        for (std::size_t i = 0; i < first_.size(); ++i)
            for (std::size_t j = first_[i]; j <= i; ++j) {
                Block& own = at(i, j);
                for (std::size_t k = std::max(first_[i], first_[j]); k < j; ++k) subtract(at(i, k), at(j, k), own);
                if (j == i && !factorDiagonal(own)) return false;
                if (j < i) divide(at(j, j), own);
            }
        return true;
    }
    // L Lᵀ x = b, in place.
    void solve(std::span<Six> b) {
        for (std::size_t i = 0; i < b.size(); ++i) {
            for (std::size_t j = first_[i]; j < i; ++j) {
                const Block& own = at(i, j);
                for (std::size_t k = 0; k < 6; ++k)
                    for (std::size_t r = 0; r < 6; ++r) b[i][r] -= own[k][r] * b[j][k];
            }
            const Block& own = at(i, i);
            for (std::size_t k = 0; k < 6; ++k) {
                b[i][k] /= own[k][k];
                for (std::size_t r = k + 1; r < 6; ++r) b[i][r] -= own[k][r] * b[i][k];
            }
        }
        for (std::size_t i = b.size(); i-- > 0;) {
            const Block& own = at(i, i);
            for (std::size_t k = 6; k-- > 0;) {
                for (std::size_t r = k + 1; r < 6; ++r) b[i][k] -= own[k][r] * b[i][r];
                b[i][k] /= own[k][k];
            }
            for (std::size_t j = first_[i]; j < i; ++j) {
                const Block& other = at(i, j);
                for (std::size_t k = 0; k < 6; ++k)
                    for (std::size_t r = 0; r < 6; ++r) b[j][k] -= other[k][r] * b[i][r];
            }
        }
    }

  private:
    // c -= a bᵀ
    static void subtract(const Block& a, const Block& b, Block& c) {
        for (std::size_t k = 0; k < 6; ++k)
            for (std::size_t j = 0; j < 6; ++j) {
                const double factor = b[k][j];
                for (std::size_t i = 0; i < 6; ++i) c[j][i] -= a[k][i] * factor;
            }
    }
    static bool factorDiagonal(Block& own) {
        for (std::size_t j = 0; j < 6; ++j) {
            if (!(own[j][j] > 0)) return false;
            const double root = std::sqrt(own[j][j]);
            for (std::size_t i = j; i < 6; ++i) own[j][i] /= root;
            for (std::size_t k = j + 1; k < 6; ++k)
                for (std::size_t i = k; i < 6; ++i) own[k][i] -= own[j][i] * own[j][k];
        }
        return true;
    }
    // x with x Lᵀ = own, in its place.
    static void divide(const Block& diagonal, Block& own) {
        for (std::size_t j = 0; j < 6; ++j) {
            for (double& entry : own[j]) entry /= diagonal[j][j];
            for (std::size_t k = j + 1; k < 6; ++k)
                for (std::size_t i = 0; i < 6; ++i) own[k][i] -= own[j][i] * diagonal[j][k];
        }
    }

    std::vector<std::size_t> first_, start_;
    std::vector<Block> blocks_;
};

class RigidStep {
  public:
    RigidStep(std::span<Row> rows, std::span<const RigidSlots> solids, const Levers& levers, double tolerance,
              std::span<Four> velocities)
        : solids_(solids), levers_(levers), tolerance_(tolerance), velocities_(velocities) {
        for (Row& row : rows) take(row);
    }

    void run() {
        if (equations_.empty() || !order()) return;
        begin();
        Envelope matrix(first_);
        for (int step = 0; step < mostSteps && goOn(matrix); ++step) {
        }
        apply();
    }

  private:
    void take(Row& row) {
        if (row.turns.isEmpty() || !row.shares.isEmpty() || row.softness > 0) return;
        Equation equation;
        equation.row = &row;
        std::array<double, 2> weights{};
        std::array<dvec3, 2> arms{};
        for (std::size_t k = 0; k < 4; ++k) {
            if (row.gains[k] == 0) continue;
            const auto at = std::lower_bound(solids_.begin(), solids_.end(), row.slots[k],
                                             [](const RigidSlots& solid, int slot) { return solid.slot < slot; });
            if (at == solids_.end() || at->slot != row.slots[k]) return;  // it moves, and is no solid
            const auto solid = static_cast<std::size_t>(at - solids_.begin());
            const std::size_t side = equation.solids[0] == none || equation.solids[0] == solid ? 0 : 1;
            equation.solids[side] = solid;
            weights[side] += row.weights[k];
        }
        for (const Turn& turn : row.turns.of(levers_.turns))
            arms[equation.solids[0] != none && solids_[equation.solids[0]].slot + 1 == turn.slot ? 0 : 1] = armOf(turn);
        const dvec3 normal = vectorOf(row.normal), across = acrossOf(normal);
        equation.axes = {normal, across, glm::cross(normal, across)};
        for (std::size_t side = 0; side < 2 && equation.solids[side] != none; ++side)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const dvec3 along = axis == 0 ? normal : row.friction * equation.axes[axis];
                const dvec3 way = weights[side] * along, turn = glm::cross(arms[side], along);
                equation.gradients[side][axis] = {way.x, way.y, way.z, turn.x, turn.y, turn.z};
            }
        equation.softness = softness / row.mass;
        equation.now = vectorOf(row.impulse) + row.impulse.of[3] * normal;
        if (row.least < 0) equation.weight[0][0] = 1.0 / equation.softness;
        (row.least < 0 ? joints_ : equations_).push_back(equation);
    }
    template <class Each>
    void forEach(const Each& each) {
        std::for_each(equations_.begin(), equations_.end(), each);
        std::for_each(joints_.begin(), joints_.end(), each);
    }

    // Cuthill and McKee: from a solid with fewest neighbours on, those that come next to each other stand so. Returns
    // whether the matrix is cheap enough.
    bool order() {
        const std::size_t n = solids_.size();
        std::vector<std::vector<std::size_t>> neighbours(n);
        forEach([&](const Equation& equation) {
            const auto [a, b] = equation.solids;
            if (b == none) return;
            neighbours[a].push_back(b);
            neighbours[b].push_back(a);
        });
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
            first_.push_back(lowest);
        }
        return work < mostWork;
    }

    void give(const Equation& equation, const dvec3& impulse) { push(*equation.row, impulse, velocities_, levers_); }
    // [m/s] what is wrong with a row.
    dvec3 wrong(const Equation& equation) const {
        return relativeVelocity(*equation.row, velocities_, levers_) + equation.row->closing * equation.axes[0];
    }
    // What a change of the velocities gives to s.
    dvec3 seen(const Equation& equation, std::span<const Six> change) const {
        dvec3 sum(0.0);
        for (std::size_t side = 0; side < 2 && equation.solids[side] != none; ++side) {
            const Six& own = change[place_[equation.solids[side]]];
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (std::size_t i = 0; i < 6; ++i)
                    sum[static_cast<int>(axis)] += equation.gradients[side][axis][i] * own[i];
        }
        return sum;
    }
    // Adds what impulses give: Gᵀ z.
    void addPush(const Equation& equation, const dvec3& z, std::span<Six> sums) const {
        for (std::size_t side = 0; side < 2 && equation.solids[side] != none; ++side) {
            Six& own = sums[place_[equation.solids[side]]];
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (std::size_t i = 0; i < 6; ++i)
                    own[i] += equation.gradients[side][axis][i] * z[static_cast<int>(axis)];
        }
    }
    // Subtracts M times a change.
    void subtractMomentum(std::span<const Six> change, std::span<Six> sums) const {
        for (std::size_t k = 0; k < solids_.size(); ++k) {
            const Six& own = change[place_[k]];
            Six& sum = sums[place_[k]];
            const dvec3 turn = solids_[k].inertia * dvec3(own[3], own[4], own[5]);
            for (std::size_t i = 0; i < 3; ++i) {
                sum[i] -= solids_[k].mass * own[i];
                sum[3 + i] -= turn[static_cast<int>(i)];
            }
        }
    }

    // A start inside all cones.
    void begin() {
        total_.assign(solids_.size(), Six{});
        step_.assign(solids_.size(), Six{});
        forEach([&](const Equation& equation) { give(equation, -equation.now); });
        double fastest = tolerance_;
        forEach([&](Equation& equation) {
            const dvec3 velocity = wrong(equation);
            const double mu = equation.row->friction;
            equation.offset = {glm::dot(velocity, equation.axes[0]), mu * glm::dot(velocity, equation.axes[1]),
                               mu * glm::dot(velocity, equation.axes[2])};
            fastest = std::max(fastest, std::sqrt(glm::dot(equation.offset, equation.offset)));
        });
        forEach([&](const Equation& equation) { give(equation, equation.now); });
        for (Equation& equation : equations_) {
            equation.s = {fastest, 0.0, 0.0};
            equation.z = {equation.row->mass * fastest, 0.0, 0.0};
        }
    }

    // Mean of s·z [N m].
    double complementarity() const {
        double sum = 0;
        for (const Equation& equation : equations_) sum += glm::dot(equation.s, equation.z);
        return sum / static_cast<double>(equations_.size());
    }

    // Solves for a step that leaves W z ∘ (W z + W dz + W⁻¹ ds) = aim of each row.
    template <class Aim>
    void solve(Envelope& matrix, const Aim& aim) {
        std::fill(step_.begin(), step_.end(), Six{});
        subtractMomentum(total_, step_);
        for (const Equation& joint : joints_) addPush(joint, pullOf(joint), step_);
        for (Equation& equation : equations_) {
            const Scaling& scaling = equation.scaling;
            const dvec3 missing =
                equation.s - equation.offset - seen(equation, total_) - equation.softness * equation.z;
            const dvec3 wanted = quotient(aim(equation), equation.scaled) - equation.scaled;
            equation.wayZ = equation.weight * (scaling.apply(wanted) + missing);
            equation.wayS = -missing;
            addPush(equation, equation.z + equation.wayZ, step_);
        }
        matrix.solve(step_);
        for (Equation& equation : equations_) {
            const dvec3 change = seen(equation, step_);
            equation.wayZ -= equation.weight * change;
            equation.wayS += change + equation.softness * equation.wayZ;
        }
    }
    double room() const {
        double most = 1e300;
        for (const Equation& equation : equations_)
            most = std::min({most, roomOf(equation.s, equation.wayS), roomOf(equation.z, equation.wayZ)});
        return most;
    }

    // [N s] The impulse of a joint, a stiff spring between velocities.
    dvec3 pullOf(const Equation& joint) const {
        return {-(joint.offset.x + seen(joint, total_).x) / joint.softness, 0.0, 0.0};
    }

    void assemble(Envelope& matrix) {
        matrix.clear();
        for (std::size_t k = 0; k < solids_.size(); ++k) {
            Block& own = matrix.at(place_[k], place_[k]);
            for (std::size_t i = 0; i < 3; ++i) {
                own[i][i] = solids_[k].mass;
                for (std::size_t j = 0; j < 3; ++j)
                    own[3 + j][3 + i] = solids_[k].inertia[static_cast<int>(j)][static_cast<int>(i)];
            }
        }
        forEach([&](const Equation& equation) {
            for (std::size_t a = 0; a < 2 && equation.solids[a] != none; ++a) {
                std::array<Six, 3> weighted{};
                for (std::size_t p = 0; p < 3; ++p)
                    for (std::size_t q = 0; q < 3; ++q)
                        for (std::size_t i = 0; i < 6; ++i)
                            weighted[p][i] +=
                                equation.weight[static_cast<int>(q)][static_cast<int>(p)] * equation.gradients[a][q][i];
                const std::size_t row = place_[equation.solids[a]];
                for (std::size_t b = 0; b < 2 && equation.solids[b] != none; ++b) {
                    const std::size_t column = place_[equation.solids[b]];
                    if (column > row) continue;
                    Block& own = matrix.at(row, column);
                    for (std::size_t p = 0; p < 3; ++p)
                        for (std::size_t j = 0; j < 6; ++j)
                            for (std::size_t i = 0; i < 6; ++i)
                                own[j][i] += weighted[p][i] * equation.gradients[b][p][j];
                }
            }
        });
    }

    // A step of Mehrotra's method. Returns whether to go on.
    bool goOn(Envelope& matrix) {
        const double before = complementarity();
        double lightest = 1e300;
        for (Equation& equation : equations_) {
            lightest = std::min(lightest, equation.row->mass);
            equation.scaling = Scaling::between(equation.s, equation.z);
            equation.scaled = equation.scaling.apply(equation.z);
            equation.weight = glm::inverse(equation.scaling.square() + dmat3(equation.softness));
        }
        if (before < lightest * tolerance_ * tolerance_) return false;
        assemble(matrix);
        if (!matrix.factor()) return false;
        // How far one would get without keeping to the middle says how much to keep to it.
        solve(matrix, [](const Equation&) { return dvec3(0.0); });
        const double reach = std::min(room(), 1.0), centring = (1.0 - reach) * (1.0 - reach) * (1.0 - reach);
        solve(matrix, [&](const Equation& equation) {
            const dvec3 bend = product(equation.scaling.undo(equation.wayS), equation.scaling.apply(equation.wayZ));
            return dvec3(centring * before, 0.0, 0.0) - bend;
        });
        const double share = std::min(nearlyToEdge * room(), 1.0);
        for (std::size_t k = 0; k < step_.size(); ++k)
            for (std::size_t i = 0; i < 6; ++i) total_[k][i] += share * step_[k][i];
        for (Equation& equation : equations_) {
            equation.s += share * equation.wayS;
            equation.z += share * equation.wayZ;
        }
        return share > 1e-3;
    }

    // (change of λ) · (u + closing n), summed: the slope of the energy of the motion along the change.
    double slope() {
        double sum = 0;
        forEach([&](const Equation& equation) { sum += glm::dot(equation.next - equation.now, wrong(equation)); });
        return sum;
    }
    void giveAll(double share) {
        forEach([&](const Equation& equation) { give(equation, share * (equation.next - equation.now)); });
    }

    // Takes the impulses as far as the energy of the motion falls.
    void apply() {
        for (Equation& equation : equations_) equation.next = equation.impulse();
        for (Equation& joint : joints_) joint.next = pullOf(joint).x * joint.axes[0];
        const double before = slope();
        giveAll(1.0);
        const double rise = slope() - before;
        const double share = before < 0 && rise > 0 ? std::min(-before / rise, 1.0) : 0.0;
        giveAll(share - 1.0);
        forEach([&](const Equation& equation) {
            const dvec3& normal = equation.axes[0];
            const dvec3 impulse = equation.now + share * (equation.next - equation.now);
            const double pressing = std::max(glm::dot(impulse, normal), equation.row->least);
            const dvec3 friction = impulse - glm::dot(impulse, normal) * normal;
            equation.row->impulse = {{friction.x, friction.y, friction.z, pressing}};
        });
    }

    std::span<const RigidSlots> solids_;
    const Levers& levers_;
    double tolerance_;  // [m/s]
    std::span<Four> velocities_;
    std::vector<Equation> equations_, joints_;
    std::vector<std::size_t> place_;  // (solids) in the matrix
    std::vector<std::size_t> first_;  // (rows of blocks) see Envelope
    std::vector<Six> total_, step_;   // (places) [m/s, rad/s] change of the velocities without impulses, and by a step
};

}  // namespace

void stepRigidly(std::span<Row> rows, std::span<const RigidSlots> solids, const Levers& levers, double tolerance,
                 std::span<Four> velocities) {
    RigidStep(rows, solids, levers, tolerance, velocities).run();
}

}  // namespace taut::contact
