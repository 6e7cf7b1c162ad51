#include "taut/mechanics/mass_spring_system.h"

#include <algorithm>

#include "taut/core/error.h"
#include "taut/core/private/parallel.h"

namespace taut::mechanics {
namespace {

std::vector<PointMass> pointMassesOf(const Model& model) {
    std::vector<PointMass> points;
    for (std::size_t i = 0; i < model.masses.size(); ++i)
        points.push_back({model.masses[i], model.dragRates[i], model.held[i]});
    return points;
}

}  // namespace

template <class Real>
MassSpringSystem<Real>::MassSpringSystem(const Model& model)
    : MassSpringSystem(pointMassesOf(model), std::vector<Body>{{0, model.grid[0] > 0 ? model.grid[0] + 1 : 0}},
                       model.springs) {}

template <class Real>
MassSpringSystem<Real>::MassSpringSystem(std::span<const PointMass> points, std::span<const Body> bodies,
                                         std::span<const Spring> springs)
    : network_(static_cast<int>(points.size()), bodies, springs), kernels_(springKernels<Real>()) {
    const int count = static_cast<int>(points.size());
    constexpr int lanes = static_cast<int>(core::cacheLine / sizeof(Real));
    // One more cache line than needed keeps the planes out of the same cache sets.
    layout_ = {count, (count + lanes - 1) / lanes * lanes + lanes, 3};
    const auto stride = static_cast<std::size_t>(layout_.stride);
    mass_ = core::AlignedArray<Real>(stride);
    inverseMass_ = mass_;
    drag_ = mass_;
    setPoints(points);
    layOutLanes();
}

template <class Real>
void MassSpringSystem<Real>::setPoints(std::span<const PointMass> points) {
    TAUT_EXPECTS(static_cast<int>(points.size()) == layout_.count);
    kinematic_.clear();
    sweep_.forget();
    for (std::size_t i = 0; i < points.size(); ++i) {
        TAUT_EXPECTS(points[i].mass > 0.0);
        mass_[i] = static_cast<Real>(points[i].mass);
        inverseMass_[i] = points[i].held ? Real(0) : static_cast<Real>(1.0 / points[i].mass);
        drag_[i] = static_cast<Real>(points[i].dragRate);
    }
}

// Makes a window for each chunk. It holds the points of a block and of its springs. Some slack
// keeps it from sliding for each block. It never holds more than the points that the chunk touches.
template <class Real>
void MassSpringSystem<Real>::layOutLanes() {
    constexpr int slack = 2048;  // points
    constexpr int lanes = static_cast<int>(core::cacheLine / sizeof(Real));
    const auto window = [](int first, int room) {
        room = (room + lanes - 1) / lanes * lanes + lanes;
        return Window{first, room, core::AlignedArray<Real>(3 * static_cast<std::size_t>(room))};
    };
    int incoming = 0;
    for (const SpringChunk& chunk : network_.chunks) {
        int need = 0, reach = chunk.firstPoint, blocksWaiting = 0;
        for (int i = chunk.firstBlock; i < chunk.lastBlock; ++i) {
            const SpringBlock& block = network_.blocks[i];
            reach = std::max(reach, block.reach);
            need = std::max(need, reach - block.firstPoint);
            if (block.firstPoint < chunk.firstPoint + incoming) ++blocksWaiting;
        }
        // Blocks whose points the chunk before spills onto wait until the end.
        const SpringBlock& lastWaiting = network_.blocks[chunk.firstBlock + std::max(0, blocksWaiting - 1)];
        const int waiting = blocksWaiting > 0 ? lastWaiting.lastPoint - chunk.firstPoint : 0;
        const int all = chunk.lastPoint + chunk.spill - chunk.firstPoint;
        const int singles = network_.blocks[static_cast<std::size_t>(chunk.lastBlock) - 1].lastSingle -
                            network_.blocks[chunk.firstBlock].firstSingle;
        const bool isPacked = 2 * singles >= chunk.lastPoint - chunk.firstPoint;
        lanes_.push_back(
            {window(chunk.firstPoint, std::min(need + slack, all)), window(chunk.firstPoint, waiting), blocksWaiting});
        if (isPacked) {
            Lane& lane = lanes_.back();
            lane.state = core::AlignedArray<Real>(static_cast<std::size_t>(packedState * lane.window.room));
            lane.force = core::AlignedArray<Real>(static_cast<std::size_t>(packedForce * lane.window.room));
        }
        incoming = chunk.spill;
    }
}

template <class Real>
void MassSpringSystem<Real>::add(std::unique_ptr<ForceGenerator<Real>> generator) {
    if (!generator->isUniform() && external_.empty()) external_ = core::AlignedArray<Real>(layout_.size());
    generators_.push_back(std::move(generator));
}

template <class Real>
void MassSpringSystem<Real>::removeGenerators(std::size_t from) {
    generators_.resize(from);
    if (std::all_of(generators_.begin(), generators_.end(), [](const auto& g) { return g->isUniform(); }))
        external_ = {};
}

template <class Real>
void MassSpringSystem<Real>::lead(LedPoints led) {
    for (const int i : led.points) TAUT_EXPECTS(i >= 0 && i < layout_.count && inverseMass_[i] == Real(0));
    const std::size_t count = led.points.size();
    kinematic_.push_back({std::move(led), std::vector<glm::dvec3>(count), std::vector<glm::dvec3>(count)});
}

template <class Real>
void MassSpringSystem<Real>::prescribe(double t, Real* x, Real* v) {
    for (KinematicPoints& kinematic : kinematic_) {
        kinematic.led.path(t, kinematic.x, kinematic.v);
        for (std::size_t i = 0; i < kinematic.x.size(); ++i)
            for (int p = 0; p < 3; ++p) {
                const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(p) * layout_.stride + kinematic.led.points[i];
                if (x != nullptr) x[at] = static_cast<Real>(kinematic.x[i][p]);
                if (v != nullptr) v[at] = static_cast<Real>(kinematic.v[i][p]);
            }
    }
}

template <class Real>
Motion<Real> MassSpringSystem<Real>::motion(double t, const Real* x, const Real* v) const {
    return {layout_.count, layout_.stride, t, x, v, mass_.data(), inverseMass_.data()};
}

// Forces that need the whole island come first. Then each chunk sweeps its blocks and hands them over block by block.
// Last come the blocks that had to wait for the spill of the chunk before.
template <class Real>
void MassSpringSystem<Real>::accelerate(double t, const Real* x, const Real* v, ode::AccelerationSink<Real>& sink) {
    const Motion<Real> now = motion(t, x, v);
    isExternalFilled_ = false;
    glm::dvec3 uniform(0.0);
    for (const auto& generator : generators_) {
        if (generator->isUniform()) {
            uniform += generator->uniformAcceleration(t);
        } else if (!generator->isLocal()) {
            if (!isExternalFilled_) std::fill(external_.begin(), external_.end(), Real(0));
            isExternalFilled_ = true;
            generator->addForces(now, 0, now.count, external_.data());
        }
    }
    for (int p = 0; p < 3; ++p) uniform_[p] = static_cast<Real>(uniform[p]);
    const int chunks = static_cast<int>(network_.chunks.size());
    core::parallelFor(chunks, [&](int c) { sweep(static_cast<std::size_t>(c), now, sink); });
    if (chunks > 1)
        core::parallelFor(chunks - 1, [&](int c) { takeSpill(static_cast<std::size_t>(c) + 1, now, sink); });
}

template <class Real>
void MassSpringSystem<Real>::sweep(std::size_t c, const Motion<Real>& now, ode::AccelerationSink<Real>& sink) {
    const SpringChunk& chunk = network_.chunks[c];
    Lane& lane = lanes_[c];
    Window& window = lane.window;
    int reach = window.first = chunk.firstPoint;
    for (int i = chunk.firstBlock; i < chunk.lastBlock; ++i) {
        const SpringBlock& block = network_.blocks[i];
        moveOn(lane, block, now, reach);
        applySprings(block, now, lane);
        if (lane.isPacked()) unpack(lane, block.firstPoint, block.lastPoint);
        if (i - chunk.firstBlock >= lane.blocksWaiting)
            finish(block, now, window, sink);
        else
            for (int p = 0; p < 3; ++p)
                std::copy(window.at(p, block.firstPoint), window.at(p, block.lastPoint),
                          lane.waiting.at(p, block.firstPoint));
    }
    if (lane.isPacked()) unpack(lane, chunk.lastPoint, chunk.lastPoint + chunk.spill);
}

// Extends the window as far as the block's springs reach. The forces there start at zero.
template <class Real>
void MassSpringSystem<Real>::moveOn(Lane& lane, const SpringBlock& block, const Motion<Real>& now, int& reach) {
    if (block.reach <= reach) return;
    Window& window = lane.window;
    const auto state = [&](int point) { return lane.state.data() + (point - window.first) * packedState; };
    const auto force = [&](int point) { return lane.force.data() + (point - window.first) * packedForce; };
    if (block.reach > window.first + window.room) {
        if (lane.isPacked()) {
            std::copy(state(block.firstPoint), state(reach), state(window.first));
            std::copy(force(block.firstPoint), force(reach), force(window.first));
        }
        window.slide(block.firstPoint, reach);
    }
    for (int p = 0; p < 3; ++p) std::fill(window.at(p, reach), window.at(p, block.reach), Real(0));
    if (lane.isPacked())
        kernels_.pack({block.reach - reach, now.stride, now.x + reach, now.v + reach, state(reach), force(reach)});
    reach = block.reach;
}

template <class Real>
void MassSpringSystem<Real>::applySprings(const SpringBlock& block, const Motion<Real>& now, Lane& lane) {
    Window& window = lane.window;
    for (int r = block.firstRun; r < block.lastRun; r += network_.runs[r].together) {
        const SpringRun<Real>& run = network_.runs[r];
        kernels_.bundle({&run, network_.stiffness.data(), network_.mixed.data(), now.stride, window.room, now.x + run.a,
                         now.v + run.a, window.at(0, run.a)});
    }
    if (block.firstSingle == block.lastSingle) return;
    const SpringSingles<Real>& s = network_.singles;
    const int at = block.firstSingle, n = block.lastSingle - at;
    if (lane.isPacked())
        kernels_.packedList({n, window.first, lane.state.data(), lane.force.data(), s.a.data() + at, s.b.data() + at,
                             s.k.data() + at, s.restLength.data() + at, s.tau.data() + at});
    else
        kernels_.list({n, now.stride, window.room, window.first, now.x, now.v, window.f.data(), s.a.data() + at,
                       s.b.data() + at, s.k.data() + at, s.restLength.data() + at, s.tau.data() + at});
}

template <class Real>
void MassSpringSystem<Real>::unpack(Lane& lane, int first, int last) {
    kernels_.unpack({last - first, lane.force.data() + (first - lane.window.first) * packedForce,
                     lane.window.at(0, first), lane.window.room});
}

template <class Real>
void MassSpringSystem<Real>::takeSpill(std::size_t c, const Motion<Real>& now, ode::AccelerationSink<Real>& sink) {
    const SpringChunk& chunk = network_.chunks[c];
    Window &spilt = lanes_[c - 1].window, &waiting = lanes_[c].waiting;
    for (int p = 0; p < 3; ++p) {
        Real* f = waiting.at(p, chunk.firstPoint);
        const Real* more = spilt.at(p, chunk.firstPoint);
        for (int i = 0; i < network_.chunks[c - 1].spill; ++i) f[i] += more[i];
    }
    for (int i = 0; i < lanes_[c].blocksWaiting; ++i) finish(network_.blocks[chunk.firstBlock + i], now, waiting, sink);
}

// Adds the local forces, turns forces into accelerations, and hands them to the sink.
template <class Real>
void MassSpringSystem<Real>::finish(const SpringBlock& block, const Motion<Real>& now, Window& window,
                                    ode::AccelerationSink<Real>& sink) {
    const int first = block.firstPoint, last = block.lastPoint;
    if (!external_.empty()) {
        if (!isExternalFilled_)
            for (int p = 0; p < 3; ++p) {
                Real* plane = external_.data() + static_cast<std::ptrdiff_t>(p) * layout_.stride;
                std::fill(plane + first, plane + last, Real(0));
            }
        for (const auto& generator : generators_)
            if (generator->isLocal() && !generator->isUniform())
                generator->addForces(now, first, last, external_.data());
    }
    kernels_.accelerate({last - first,
                         inverseMass_.data() + first,
                         {uniform_[0], uniform_[1], uniform_[2]},
                         external_.empty() ? nullptr : external_.data() + first,
                         layout_.stride,
                         window.at(0, first),
                         window.room});
    const Real* const a[3] = {window.at(0, first), window.at(1, first), window.at(2, first)};
    sink.take(first, last, a);
}

template <class Real>
void MassSpringSystem<Real>::setSprings(std::span<const Spring> springs) {
    sweep_.forget();
    (isSplit_ ? damped_ : network_).setSprings(springs);
    if (isSplit_) network_.takeUndamped(damped_);
}

template <class Real>
void MassSpringSystem<Real>::changeSprings(std::span<const int> which, std::span<const Spring> springs) {
    bool isOther = false;
    for (const int s : which) {
        const Spring& now = springs[s];
        if (isSplit_) damped_.setSpring(s, now);
        isOther = network_.setSpring(s, now) || isOther;
    }
    if (isOther) sweep_.forget();
}

template <class Real>
void MassSpringSystem<Real>::split(bool isSplit) {
    if (isSplit_ == isSplit) return;
    isSplit_ = isSplit;
    if (!isSplit) {
        network_ = damped_;
        return;
    }
    damped_ = network_;
    network_.takeUndamped(damped_);
}

template <class Real>
void MassSpringSystem<Real>::linearise(double t, const Real* x, const Real* v, double stiffness, double damping) {
    products_.linearise(network_, layout_.stride, x, stiffness, damping);
    for (const auto& generator : generators_) generator->linearise(motion(t, x, v), stiffness, damping);
}

template <class Real>
void MassSpringSystem<Real>::addProduct(const Real* u, Real* out) const {
    products_.addProduct(network_, layout_.stride, u, out);
    for (const auto& generator : generators_) generator->addProduct(layout_.stride, u, out);
}

template <class Real>
void MassSpringSystem<Real>::addDiagonal(Real* out) const {
    products_.addDiagonal(network_, layout_.stride, out);
    for (const auto& generator : generators_) generator->addDiagonal(layout_.stride, out);
}

template <class Real>
std::uint64_t MassSpringSystem<Real>::bytes() const {
    std::uint64_t reals = mass_.size() * 3 + external_.size() + network_.stiffness.size() + network_.mixed.size();
    for (const Lane& lane : lanes_)
        reals += lane.window.f.size() + lane.waiting.f.size() + lane.state.size() + lane.force.size();
    const std::uint64_t single = 2 * sizeof(int) + 3 * sizeof(Real);
    return reals * sizeof(Real) + network_.runs.size() * sizeof(SpringRun<Real>) + network_.singles.a.size() * single +
           network_.blocks.size() * sizeof(SpringBlock) +
           (network_.order.size() + network_.places.size()) * sizeof(int) + products_.bytes();
}

template class MassSpringSystem<float>;
template class MassSpringSystem<double>;

}  // namespace taut::mechanics
