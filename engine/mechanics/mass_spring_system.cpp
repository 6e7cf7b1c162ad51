#include "mechanics/mass_spring_system.h"

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"

namespace taut::mechanics {

template <class Real>
MassSpringSystem<Real>::MassSpringSystem(std::span<const PointMass> points, std::span<const Body> bodies,
                                         std::span<const Spring> springs)
    : network_(static_cast<int>(points.size()), bodies, springs), kernels_(springKernels<Real>()) {
    const int count = static_cast<int>(points.size());
    constexpr int lanes = static_cast<int>(core::cacheLine / sizeof(Real));
    // One line more than needed keeps the planes off the same cache sets.
    layout_ = {count, (count + lanes - 1) / lanes * lanes + lanes, 3};
    const auto stride = static_cast<std::size_t>(layout_.stride);
    mass_ = core::AlignedArray<Real>(stride);
    inverseMass_ = mass_;
    drag_ = mass_;
    force_ = core::AlignedArray<Real>(layout_.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        TAUT_EXPECTS(points[i].mass > 0.0);
        mass_[i] = static_cast<Real>(points[i].mass);
        inverseMass_[i] = points[i].held ? Real(0) : static_cast<Real>(1.0 / points[i].mass);
        drag_[i] = static_cast<Real>(points[i].dragRate);
    }
    int incoming = 0;
    for (const SpringChunk& chunk : network_.chunks) {
        int deferred = 0;
        while (incoming > 0 && chunk.firstBlock + deferred < chunk.lastBlock &&
               network_.blocks[static_cast<std::size_t>(chunk.firstBlock + deferred)].firstPoint <
                   chunk.firstPoint + incoming)
            ++deferred;
        deferred_.push_back(deferred);
        spill_.emplace_back(3 * static_cast<std::size_t>(chunk.spill));
        scratch_.emplace_back(3 * static_cast<std::size_t>(chunk.longestRun));
        incoming = chunk.spill;
    }
}

template <class Real>
void MassSpringSystem<Real>::add(std::unique_ptr<ForceGenerator<Real>> generator) {
    generators_.push_back(std::move(generator));
}

template <class Real>
Motion<Real> MassSpringSystem<Real>::motion(double t, const Real* x, const Real* v) const {
    return {layout_.count, layout_.stride, t, x, v, mass_.data(), inverseMass_.data()};
}

// Forces that need the whole island come first; then each chunk sweeps its blocks and hands them over row by row;
// last the blocks that had to wait for the spill of the chunk before.
template <class Real>
void MassSpringSystem<Real>::accelerate(double t, const Real* x, const Real* v, ode::AccelerationSink<Real>& sink) {
    const Motion<Real> now = motion(t, x, v);
    bool prefilled = false;
    for (const auto& generator : generators_) {
        if (generator->isLocal()) continue;
        if (!prefilled) std::fill(force_.begin(), force_.end(), Real(0));
        prefilled = true;
        generator->addForces(now, 0, now.count, force_.data());
    }
    const int chunks = static_cast<int>(network_.chunks.size());
    core::parallelFor(chunks, [&](int c) { sweep(network_.chunks[static_cast<std::size_t>(c)], prefilled, now, sink); });
    if (chunks > 1)
        core::parallelFor(chunks - 1, [&](int c) { takeSpill(static_cast<std::size_t>(c) + 1, now, sink); });
}

template <class Real>
void MassSpringSystem<Real>::sweep(const SpringChunk& chunk, bool prefilled, const Motion<Real>& now,
                                   ode::AccelerationSink<Real>& sink) {
    const auto c = static_cast<std::size_t>(&chunk - network_.chunks.data());
    std::fill(spill_[c].begin(), spill_[c].end(), Real(0));
    int cleared = prefilled ? chunk.lastPoint : chunk.firstPoint;
    for (int i = chunk.firstBlock; i < chunk.lastBlock; ++i) {
        const SpringBlock& block = network_.blocks[static_cast<std::size_t>(i)];
        if (const int reach = std::min(block.reach, chunk.lastPoint); reach > cleared) {
            for (int p = 0; p < 3; ++p) {
                Real* plane = force_.data() + static_cast<std::ptrdiff_t>(p) * layout_.stride;
                std::fill(plane + cleared, plane + reach, Real(0));
            }
            cleared = reach;
        }
        applySprings(chunk, block, now);
        if (i - chunk.firstBlock >= deferred_[c]) finish(block, now, sink);
    }
}

template <class Real>
void MassSpringSystem<Real>::applySprings(const SpringChunk& chunk, const SpringBlock& block, const Motion<Real>& now) {
    const auto c = static_cast<std::size_t>(&chunk - network_.chunks.data());
    Real* spill = spill_[c].data();
    for (int r = block.firstRun; r < block.lastRun; ++r) {
        const SpringRun<Real>& run = network_.runs[static_cast<std::size_t>(r)];
        const int b = run.a + run.offset;
        Real* fb = run.crossing ? spill + (b - chunk.lastPoint) : force_.data() + b;
        const bool overlapping = !run.crossing && run.offset < run.count;
        kernels_.run({run.count, run.offset, now.stride, run.crossing ? chunk.spill : now.stride, now.x + run.a,
                      now.v + run.a, force_.data() + run.a, fb, network_.stiffness.data() + run.table, run.restLength,
                      run.tau, overlapping ? scratch_[c].data() : nullptr});
    }
    const SpringSingles<Real>& s = network_.singles;
    const auto list = [&](int first, int last, Real* fb, int strideB, int firstB) {
        if (first == last) return;
        kernels_.list({last - first, now.stride, strideB, now.x, now.v, force_.data(), fb, firstB, s.a.data() + first,
                       s.b.data() + first, s.k.data() + first, s.restLength.data() + first, s.tau.data() + first});
    };
    list(block.firstSingle, block.lastSingle, force_.data(), now.stride, 0);
    list(block.firstCrossing, block.lastCrossing, spill, chunk.spill, chunk.lastPoint);
}

template <class Real>
void MassSpringSystem<Real>::takeSpill(std::size_t c, const Motion<Real>& now, ode::AccelerationSink<Real>& sink) {
    const SpringChunk& chunk = network_.chunks[c];
    const int spill = network_.chunks[c - 1].spill;
    for (int p = 0; p < 3; ++p) {
        Real* plane = force_.data() + static_cast<std::ptrdiff_t>(p) * layout_.stride + chunk.firstPoint;
        const Real* more = spill_[c - 1].data() + static_cast<std::ptrdiff_t>(p) * spill;
        for (int i = 0; i < spill; ++i) plane[i] += more[i];
    }
    for (int i = 0; i < deferred_[c]; ++i)
        finish(network_.blocks[static_cast<std::size_t>(chunk.firstBlock + i)], now, sink);
}

// From forces to accelerations, and away with them.
template <class Real>
void MassSpringSystem<Real>::finish(const SpringBlock& block, const Motion<Real>& now,
                                    ode::AccelerationSink<Real>& sink) {
    for (const auto& generator : generators_)
        if (generator->isLocal()) generator->addForces(now, block.firstPoint, block.lastPoint, force_.data());
    const Real* a[3];
    for (int p = 0; p < 3; ++p) {
        Real* f = force_.data() + static_cast<std::ptrdiff_t>(p) * layout_.stride + block.firstPoint;
        kernels_.scale(block.lastPoint - block.firstPoint, inverseMass_.data() + block.firstPoint, f);
        a[p] = f;
    }
    sink.take(block.firstPoint, block.lastPoint, a);
}

template <class Real>
std::uint64_t MassSpringSystem<Real>::bytes() const {
    std::uint64_t reals = mass_.size() * 3 + force_.size() + network_.stiffness.size();
    for (const auto& array : spill_) reals += array.size();
    for (const auto& array : scratch_) reals += array.size();
    const std::uint64_t single = 2 * sizeof(int) + 3 * sizeof(Real);
    return reals * sizeof(Real) + network_.runs.size() * sizeof(SpringRun<Real>) +
           network_.singles.a.size() * single + network_.blocks.size() * sizeof(SpringBlock);
}

template class MassSpringSystem<float>;
template class MassSpringSystem<double>;

}  // namespace taut::mechanics
