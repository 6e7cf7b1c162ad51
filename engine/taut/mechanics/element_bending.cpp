#include "taut/mechanics/private/element_bending.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "taut/core/error.h"
#include "taut/core/private/instruction_set.h"
#include "taut/core/private/parallel.h"
#include "taut/mechanics/pose_path.h"

namespace taut::mechanics {

TAUT_KERNELS(template <class Real> ElementKernels<Real> elementKernels();)

namespace {

using glm::dvec3;

template <class Real>
Real dotOf(const PackedVector<Real>& a, const PackedVector<Real>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Real>
PackedVector<Real> crossOf(const PackedVector<Real>& a, const PackedVector<Real>& b) {
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0}};
}

template <class Real>
dvec3 placeOf(const Motion<Real>& motion, const Real* x, int point) {
    const std::ptrdiff_t stride = motion.stride;
    return {static_cast<double>(x[point]), static_cast<double>(x[stride + point]),
            static_cast<double>(x[2 * stride + point])};
}

dvec3 turned(const glm::dquat& turn, const dvec3& v) {
    return PosePath::rotated(turn, v);
}

// Calls part(begin, end) for all numbers below count, in blocks.
template <class Part>
void inBlocks(int count, const Part& part) {
    constexpr int block = 2048;
    const auto task = [&](int i) { part(i * block, std::min((i + 1) * block, count)); };
    const int tasks = (count + block - 1) / block;
    if (tasks == 1)
        task(0);
    else
        core::parallelFor(tasks, task);
}

}  // namespace

template <class Real>
ElementBending<Real>::ElementBending(std::vector<BendingElement> elements, double dampingTime,
                                     std::span<const int> points, Turn turn)
    : points_(points.begin(), points.end()), slots_(points.size()), turn_(std::move(turn)) {
    kernels_ = TAUT_IN_USE(elementKernels<Real>)();
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
    for (std::size_t slot = 0; slot < order.size(); ++slot) {
        points_[slot] = points[order[slot]];
        slots_[order[slot]] = slot;
    }
    places_.resize(points_.size());
    set(std::move(elements), dampingTime);
}

template <class Real>
auto ElementBending<Real>::rowsOf(const std::vector<std::vector<Entry>>& lists) -> Rows {
    Rows rows{{0}, {}};
    for (const std::vector<Entry>& list : lists) {
        rows.entries.insert(rows.entries.end(), list.begin(), list.end());
        rows.first.push_back(static_cast<int>(rows.entries.size()));
    }
    return rows;
}

// Over 60 lines: one loop over elements fills all tables.
template <class Real>
void ElementBending<Real>::set(std::vector<BendingElement> elements, double dampingTime) {
    struct Coupling {
        int to;
        double weight;
    };
    std::vector<std::vector<Coupling>> couplings(points_.size());  // by the lower slot
    std::vector<std::vector<Entry>> pulls(points_.size()), sums;
    std::vector<dvec3> held(points_.size(), dvec3(0.0));
    elements_ = std::move(elements);
    dampingTime_ = dampingTime;
    curved_.clear();
    corners_.clear();
    hasHeldSums_ = false;
    frames_.clear();
    productFactor_ = 0;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
        BendingElement& element = elements_[e];
        const std::size_t count = element.points.size();
        const dvec3 moment = element.modulus * element.rest;
        const int number = 4 * static_cast<int>(curved_.size());
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t slot = slotOf(element.points[i]);
            const dvec3 row = element.modulus * element.weights[i];
            held[slot] -= element.held * row;
            for (std::size_t j = 0; j < count; ++j) {
                const std::size_t other = slotOf(element.points[j]);
                if (other <= slot) continue;
                auto& list = couplings[slot];
                const auto found = std::find_if(list.begin(), list.end(),
                                                [&](const Coupling& c) { return c.to == static_cast<int>(other); });
                const double weight = -glm::dot(row, element.weights[j]);
                if (found != list.end())
                    found->weight += weight;
                else
                    list.push_back({static_cast<int>(other), weight});
            }
        }
        if (element.isCurved()) {
            const Curved curved{element.held * moment, static_cast<Real>(glm::dot(element.rest, moment))};
            std::array<int, 3> corners{-1, -1, -1};
            auto& sum = sums.emplace_back();
            for (std::size_t i = 0; i < count; ++i) {
                const auto beta = static_cast<Real>(glm::dot(element.weights[i], moment));
                const std::size_t slot = slotOf(element.points[i]);
                sum.push_back({static_cast<int>(slot), beta});
                pulls[slot].push_back({number, beta});
            }
            for (int c = 0; c < 3 && !element.isOfRope; ++c) {
                const std::size_t slot = slotOf(element.corners[c]);
                corners[c] = static_cast<int>(slot);
                pulls[slot].push_back({number + 1 + c, 1});
            }
            curved_.push_back(curved);
            corners_.push_back(corners);
            hasHeldSums_ = hasHeldSums_ || curved.held != dvec3(0.0);
        }
        for (int& point : element.points) point = points_[slotOf(point)];
        if (!element.isOfRope)
            for (int& corner : element.corners) corner = points_[slotOf(corner)];
    }
    std::vector<std::vector<Entry>> rows(points_.size());
    for (std::size_t i = 0; i < couplings.size(); ++i) {
        std::sort(couplings[i].begin(), couplings[i].end(),
                  [](const Coupling& a, const Coupling& b) { return a.to < b.to; });
        for (const auto& [to, weight] : couplings[i]) {
            rows[i].push_back({to, static_cast<Real>(weight)});
            rows[to].push_back({static_cast<int>(i), static_cast<Real>(weight)});
        }
    }
    matrix_ = rowsOf(rows);
    pulls_ = rowsOf(pulls);
    sums_ = rowsOf(sums);
    pull_.assign(4 * curved_.size(), Four{});
    y_.assign(curved_.size(), Four{});
    heldSums_.assign(curved_.size(), Four{});
    held_.clear();
    for (std::size_t slot = 0; slot < held.size(); ++slot)
        if (held[slot] != dvec3(0.0)) held_.emplace_back(slot, held[slot]);
}

template <class Real>
void ElementBending<Real>::gather(const Real* x, const Real* v, double dampingTime, int stride) const {
    const bool isDamped = v != nullptr && dampingTime > 0;
    const auto tau = static_cast<Real>(dampingTime);
    const std::ptrdiff_t up = stride;
    for (std::size_t slot = 0; slot < points_.size(); ++slot) {
        const Real* from = x + points_[slot];
        if (isDamped) {
            const Real* moving = v + points_[slot];
            places_[slot] = {
                {from[0] + tau * moving[0], from[up] + tau * moving[up], from[2 * up] + tau * moving[2 * up], 0}};
        } else {
            places_[slot] = {{from[0], from[up], from[2 * up], 0}};
        }
    }
}

template <class Real>
void ElementBending<Real>::findSums() const {
    if (curved_.empty()) return;
    inBlocks(static_cast<int>(curved_.size()), [&](int begin, int end) {
        kernels_.sums({weighted(sums_, places_), begin, end, y_[0].of});
    });
}

// A triangle without an area, or a rope that is straight, has no normal: 0.
template <class Real>
auto ElementBending<Real>::frameOf(const int* corners, const Four& y) const -> Frame {
    Frame frame{};
    if (corners[0] < 0) {
        frame.length = std::sqrt(dotOf(y, y));
        if (frame.length > 0) frame.normal = 1 / frame.length * y;
        return frame;
    }
    const Four from = places_[corners[0]];
    const Four b = places_[corners[1]] - from, c = places_[corners[2]] - from;
    const Four n = crossOf(b, c);
    const Real length = std::sqrt(dotOf(n, n));
    if (!(length > 0)) return frame;
    frame.normal = 1 / length * n;
    frame.toB = 1 / length * crossOf(c, frame.normal);
    frame.toC = 1 / length * crossOf(frame.normal, b);
    return frame;
}

template <class Real>
void ElementBending<Real>::findPulls(double t) const {
    if (curved_.empty()) return;
    const bool isHeld = turnHeld(t);
    inBlocks(static_cast<int>(curved_.size()), [&](int begin, int end) {
        kernels_.pulls({weighted(sums_, places_), begin, end, corners_[0].data(), isHeld ? heldSums_[0].of : nullptr,
                        pull_[0].of});
    });
}

// The held parts of y as they are at t. Returns whether there are any.
template <class Real>
bool ElementBending<Real>::turnHeld(double t) const {
    if (!hasHeldSums_) return false;
    const glm::dquat turn = turnAt(t);
    for (std::size_t e = 0; e < curved_.size(); ++e) heldSums_[e] = four(turned(turn, curved_[e].held));
    return true;
}

template <class Real>
auto ElementBending<Real>::framesAt(double t) const -> std::vector<Frame> {
    findSums();
    const bool isHeld = turnHeld(t);
    std::vector<Frame> frames;
    for (std::size_t e = 0; e < curved_.size(); ++e)
        frames.push_back(frameOf(corners_[e].data(), isHeld ? y_[e] + heldSums_[e] : y_[e]));
    return frames;
}

// As if the element were at rest but for its place (Gauss and Newton): d = κ - rest n, δd = δκ - rest δn, and
// -Σ δdᵀ M δd beyond the product of the matrix. It is never positive.
template <class Real>
void ElementBending<Real>::findPulls(const std::vector<Frame>& frames) const {
    findSums();
    for (std::size_t e = 0; e < curved_.size(); ++e) {
        const Curved& curved = curved_[e];
        const int* corners = corners_[e].data();
        const Frame& frame = frames[e];
        const Four y = y_[e];
        Four turn{};  // δn
        if (corners[0] < 0) {
            const Real most = std::max(frame.length, curved.square);
            if (most > 0) turn = 1 / most * (y - dotOf(frame.normal, y) * frame.normal);
        } else {
            const Four from = places_[corners[0]];
            turn -= dotOf(frame.normal, places_[corners[1]] - from) * frame.toB;
            turn -= dotOf(frame.normal, places_[corners[2]] - from) * frame.toC;
        }
        const Four left = y - curved.square * turn;
        const Real b = dotOf(frame.toB, left), c = dotOf(frame.toC, left);
        pull_[4 * e] = turn;
        pull_[4 * e + 1] = (b + c) * frame.normal;
        pull_[4 * e + 2] = -b * frame.normal;
        pull_[4 * e + 3] = -c * frame.normal;
    }
}

template <class Real>
void ElementBending<Real>::addSums(Real scale, int stride, Real* out) const {
    inBlocks(
        static_cast<int>(points_.size()),
        [&](int begin, int end) {
            kernels_.couplings(
                {weighted(matrix_, places_), weighted(pulls_, pull_), begin, end, points_.data(), scale, stride, out});
        });
}

template <class Real>
void ElementBending<Real>::addForces(const Motion<Real>& motion, int first, int last, Real* f) const {
    TAUT_EXPECTS(first == 0 && last == motion.count);
    gather(motion.x, motion.v, dampingTime_, motion.stride);
    findPulls(motion.t);
    addSums(Real(1), motion.stride, f);
    if (held_.empty()) return;
    const glm::dquat turn = turnAt(motion.t);
    for (const auto& [slot, force] : held_) {
        const dvec3 more = turned(turn, force);
        for (std::ptrdiff_t axis = 0; axis < 3; ++axis)
            f[axis * motion.stride + points_[slot]] += static_cast<Real>(more[static_cast<int>(axis)]);
    }
}

// Columns κ_uu, κ_vv, κ_uv.
template <class Real>
glm::dmat3 ElementBending<Real>::curvatureOf(const BendingElement& element, const Motion<Real>& motion) const {
    const glm::dquat turn = turnAt(motion.t);
    glm::dmat3 curvature;
    for (int k = 0; k < 3; ++k) curvature[k] = turned(turn, element.held[k]);
    const dvec3 from = placeOf(motion, motion.x, element.points[0]);
    for (std::size_t i = 1; i < element.points.size(); ++i)
        curvature += glm::outerProduct(placeOf(motion, motion.x, element.points[i]) - from, element.weights[i]);
    return curvature;
}

template <class Real>
double ElementBending<Real>::potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only) const {
    double energy = 0;
    for (const BendingElement& element : elements_) {
        if (!only.empty() && !std::all_of(element.points.begin(), element.points.end(), [&](int i) { return only[i]; }))
            continue;
        glm::dmat3 off = curvatureOf(element, motion);
        if (element.isCurved()) {
            dvec3 n = off[0];
            if (!element.isOfRope) {
                const dvec3 a = placeOf(motion, motion.x, element.corners[0]);
                n = glm::cross(placeOf(motion, motion.x, element.corners[1]) - a,
                               placeOf(motion, motion.x, element.corners[2]) - a);
            }
            const double length = glm::length(n);
            if (length > 0) off -= glm::outerProduct(n / length, element.rest);
        }
        for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l) energy += 0.5 * element.modulus[k][l] * glm::dot(off[k], off[l]);
    }
    return energy;
}

template <class Real>
void ElementBending<Real>::addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const {
    gather(motion.x, nullptr, 0, motion.stride);
    const std::vector<Frame> frames = framesAt(motion.t);
    gather(u, nullptr, 0, motion.stride);
    findPulls(frames);
    addSums(Real(-1), motion.stride, out);
}

template <class Real>
void ElementBending<Real>::linearise(const Motion<Real>& motion, double stiffness, double damping) {
    productFactor_ = stiffness + damping * dampingTime_;
    if (curved_.empty()) return;
    gather(motion.x, nullptr, 0, motion.stride);
    frames_ = framesAt(motion.t);
}

template <class Real>
void ElementBending<Real>::addProduct(int stride, const Real* u, Real* out) const {
    gather(u, nullptr, 0, stride);
    findPulls(frames_);
    addSums(static_cast<Real>(-productFactor_), stride, out);
}

template <class Real>
void ElementBending<Real>::addDiagonal(int stride, Real* out) const {
    const auto factor = static_cast<Real>(productFactor_);
    const auto add = [&](int slot, int axis, Real more) {
        out[static_cast<std::ptrdiff_t>(axis) * stride + points_[slot]] += factor * more;
    };
    for (std::size_t slot = 0; slot < points_.size(); ++slot) {
        Real sum = 0;
        for (int k = matrix_.first[slot]; k < matrix_.first[slot + 1]; ++k) sum += matrix_.entries[k].weight;
        for (int axis = 0; axis < 3; ++axis) add(static_cast<int>(slot), axis, sum);
    }
    // 2 β g n + square |g|² n² of a corner, as ∂n/∂x_i = -g_i nᵀ; of a rope -β² (1 - n²) over the length.
    for (std::size_t e = 0; e < curved_.size(); ++e) {
        const Curved& curved = curved_[e];
        const int* corners = corners_[e].data();
        const Frame& frame = frames_[e];
        const Four gradients[3] = {Real(-1) * (frame.toB + frame.toC), frame.toB, frame.toC};
        const Real most = std::max(frame.length, curved.square);
        for (int k = sums_.first[e]; k < sums_.first[e + 1]; ++k) {
            const auto& [slot, beta] = sums_.entries[k];
            for (int axis = 0; axis < 3; ++axis) {
                const Real n = frame.normal[axis];
                if (corners[0] < 0 && most > 0) add(slot, axis, -beta * beta / most * (1 - n * n));
                for (int c = 0; c < 3; ++c)
                    if (corners[c] == slot)
                        add(slot, axis,
                            2 * beta * gradients[c][axis] * n +
                                curved.square * dotOf(gradients[c], gradients[c]) * n * n);
            }
        }
    }
}

// Rows of the matrix, and the largest share of the normals of curved elements: β ∂n/∂x both ways, square |∂n/∂x|², and
// the change of ∂n/∂x times y.
template <class Real>
void ElementBending<Real>::addStability(const Motion<Real>& motion, StabilityShare& share) const {
    const auto add = [&](std::size_t slot, double row) {
        const auto own = static_cast<std::size_t>(points_[slot]);
        share.stiffness[own] += row;
        share.dampingRate[own] += dampingTime_ * row * static_cast<double>(motion.inverseMass[own]);
    };
    for (std::size_t slot = 0; slot < points_.size(); ++slot) {
        double diagonal = 0, others = 0;
        for (int k = matrix_.first[slot]; k < matrix_.first[slot + 1]; ++k) {
            const auto weight = static_cast<double>(matrix_.entries[k].weight);
            diagonal += weight;
            others += std::abs(weight);
        }
        add(slot, std::abs(diagonal) + others);
    }
    if (curved_.empty()) return;
    gather(motion.x, nullptr, 0, motion.stride);
    const std::vector<Frame> frames = framesAt(motion.t);
    for (std::size_t e = 0; e < curved_.size(); ++e) {
        const Curved& curved = curved_[e];
        const int* corners = corners_[e].data();
        if (corners[0] < 0) continue;  // it only takes off the matrix
        const dvec3 b = vectorOf(frames[e].toB), c = vectorOf(frames[e].toC);
        const double gradients[3] = {glm::length(b + c), glm::length(b), glm::length(c)};
        const double steepness = gradients[0] + gradients[1] + gradients[2];
        const double pull = glm::length(vectorOf(y_[e])) + static_cast<double>(curved.square);
        double betas = 0;
        for (int k = sums_.first[e]; k < sums_.first[e + 1]; ++k) {
            const auto& [slot, weight] = sums_.entries[k];
            const double beta = std::abs(static_cast<double>(weight));
            betas += beta;
            add(static_cast<std::size_t>(slot), beta * steepness);
        }
        for (int k = 0; k < 3; ++k)
            add(static_cast<std::size_t>(corners[k]), gradients[k] * (betas + pull * steepness));
    }
}

template class ElementBending<float>;
template class ElementBending<double>;

}  // namespace taut::mechanics
