#include "taut/mechanics/private/wind.h"

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/core/private/instruction_set.h"

namespace taut::mechanics {

TAUT_KERNELS(template <class Real> void addWind(const WindBatch<Real>&);)

namespace {

// Of a triangle: the unit normal and the gradients of its corners' coordinates. 0 where it has no area.
template <class Real>
struct Facet {
    using Vec = glm::vec<3, Real>;
    Vec normal{Real(0)};
    Vec gradients[3]{Vec(Real(0)), Vec(Real(0)), Vec(Real(0))};  // [1/m]

    Facet(const Vec& a, const Vec& b, const Vec& c) {
        const Vec cross = glm::cross(b - a, c - a);
        const Real size = std::sqrt(glm::dot(cross, cross));
        if (!(size > 0)) return;
        normal = cross / size;
        gradients[1] = glm::cross(c - a, normal) / size;
        gradients[2] = glm::cross(normal, b - a) / size;
        gradients[0] = -gradients[1] - gradients[2];
    }
};

}  // namespace

template <class Real>
Wind<Real>::Wind(std::span<const Triangle> triangles, const glm::dvec3& velocity, const WindSettings& settings)
    : Wind({.triangles = {triangles.begin(), triangles.end()}}, LinearPath{velocity, velocity}, settings) {}

template <class Real>
Wind<Real>::Wind(const WindTargets& targets, const LinearPath& velocity, const WindSettings& settings)
    : triangles_(targets.triangles),
      sides_(targets.sides),
      plateAir_(targets.plateAir.begin(), targets.plateAir.end()),
      rounds_(targets.rounds),
      runs_(triangles_),
      weight_(runs_.sources().size()),
      velocity_(velocity),
      settings_(settings),
      addBatch_(TAUT_IN_USE(addWind<Real>)) {
    if (sides_.empty()) sides_.assign(triangles_.size(), 1.0);
    for (std::size_t lane = 0; lane < weight_.size(); ++lane) {
        const int source = runs_.sources()[lane];
        weight_[lane] = source >= 0 ? static_cast<Real>(sides_[source]) : Real(0);
    }
    if (triangles_.empty()) return;
    firstPoint_ = triangles_[0][0];
    int last = firstPoint_;
    for (const Triangle& triangle : triangles_)
        for (int point : triangle) {
            firstPoint_ = std::min(firstPoint_, point);
            last = std::max(last, point);
        }
    pointCount_ = last + 1 - firstPoint_;
    packed_ = core::AlignedArray<Real>(12 * static_cast<std::size_t>(runs_.lanes().loosePointCount));
    setSettings(settings);
}

template <class Real>
void Wind<Real>::setSettings(const WindSettings& settings) {
    settings_ = settings;
    if (settings_.gust.amplitude > 0.0 && slip_.empty())
        slip_ = core::AlignedArray<Real>(3 * static_cast<std::size_t>(pointCount_));
}

template <class Real>
glm::dvec3 Wind<Real>::airVelocity(const glm::dvec3& x, double t) const {
    const glm::dvec3 steady = velocity_.at(t);
    return settings_.gust.amplitude > 0.0 ? steady + gustVelocity(settings_.gust, t, x) : steady;
}

template <class Real>
double Wind<Real>::workingSpeed() const {
    if (settings_.workingSpeed > 0.0) return settings_.workingSpeed;
    const double steady = std::max(glm::length(velocity_.from), glm::length(velocity_.to));
    return std::max(10.0, 2.0 * (steady + settings_.gust.amplitude));
}

template <class Real>
void Wind<Real>::addForces(const Motion<Real>& motion, int first, int last, Real* f) const {
    TAUT_EXPECTS(first == 0 && last == motion.count);
    if (!triangles_.empty()) addTriangles(motion, f);
    if (!plateAir_.empty()) addFlutter(motion, f);
    const auto pressure = static_cast<Real>(0.25 * settings_.airDensity * settings_.drag);  // half for each end
    for (const Round& round : rounds_) {
        const Past air = past(round, motion);
        const Vec force = pressure * air.area * std::sqrt(glm::dot(air.u, air.u)) * air.u;
        for (const int i : {round.a, round.b})
            for (int axis = 0; axis < 3; ++axis) f[axis * motion.stride + i] += force[axis];
    }
}

template <class Real>
auto Wind<Real>::wayAlong(const Round& round, const Motion<Real>& motion) -> Vec {
    const auto along = [&](std::ptrdiff_t axis) {
        return motion.x[round.b + axis * motion.stride] - motion.x[round.a + axis * motion.stride];
    };
    return {along(0), along(1), along(2)};
}

template <class Real>
auto Wind<Real>::past(const Round& round, const Motion<Real>& motion) const -> Past {
    const auto middle = [&](const Real* planes) {
        const auto at = [&](std::ptrdiff_t axis) {
            return (planes[round.a + axis * motion.stride] + planes[round.b + axis * motion.stride]) / Real(2);
        };
        return Vec(at(0), at(1), at(2));
    };
    Past air{Vec(airVelocity(glm::dvec3(middle(motion.x)), motion.t)) - middle(motion.v), Vec(Real(0)),
             static_cast<Real>(round.area)};
    const Vec way = wayAlong(round, motion);
    const Real length = std::sqrt(glm::dot(way, way));
    if (!(length > 0)) return air;
    air.axis = way / length;
    air.u -= glm::dot(air.u, air.axis) * air.axis;
    air.area = static_cast<Real>(round.width) * length;
    return air;
}

template <class Real>
void Wind<Real>::addTriangles(const Motion<Real>& motion, Real* f) const {
    GustWaves<Real> gust;
    WindBatch<Real> batch{};
    batch.lanes = runs_.lanes();
    batch.weight = weight_.data();
    batch.stride = motion.stride;
    batch.x = motion.x;
    batch.v = motion.v;
    batch.f = f;
    const glm::dvec3 flow = velocity_.at(motion.t);
    for (int axis = 0; axis < 3; ++axis) batch.flow[axis] = static_cast<Real>(flow[axis]);
    batch.drag = static_cast<Real>(settings_.airDensity * settings_.drag / 12.0);
    batch.lift = static_cast<Real>(settings_.airDensity * settings_.lift / 12.0);
    batch.packed = packed_.data();
    if (settings_.gust.amplitude > 0.0) {
        batch.firstPoint = firstPoint_;
        batch.pointCount = pointCount_;
        batch.slip = slip_.data();
        gust = gustWaves<Real>(settings_.gust, motion.t);
        batch.gust = &gust;
    }
    addBatch_(batch);
}

// Scalar: few bodies ask for it.
template <class Real>
void Wind<Real>::addFlutter(const Motion<Real>& motion, Real* f) const {
    const auto at = [](const Real* planes, std::ptrdiff_t stride, int i) {
        return Vec(planes[i], planes[i + stride], planes[i + 2 * stride]);
    };
    const bool hasGust = settings_.gust.amplitude > 0.0;  // the kernel has left slip_ then
    const Real* moving = hasGust ? slip_.data() - firstPoint_ : motion.v;
    const std::ptrdiff_t pitch = hasGust ? pointCount_ : motion.stride;
    const Vec flow(velocity_.at(motion.t));
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        const Triangle& corners = triangles_[t];
        const Facet<Real> facet(at(motion.x, motion.stride, corners[0]), at(motion.x, motion.stride, corners[1]),
                                at(motion.x, motion.stride, corners[2]));
        const Vec& n = facet.normal;
        Vec mean(Real(0)), turn(Real(0));
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec v = at(moving, pitch, corners[k]) - flow;
            mean += v / Real(3);
            turn -= facet.gradients[k] * glm::dot(n, v);
        }
        const Real w = glm::dot(mean, n), air = plateAir_[t];
        const Vec shared = air / Real(3) * (w * turn - Real(2) * glm::dot(mean, turn) * n);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec force = shared - air * w * glm::dot(mean, facet.gradients[k]) * n;
            for (int axis = 0; axis < 3; ++axis) f[axis * motion.stride + corners[k]] += force[axis];
        }
    }
}

template <class Real>
void Wind<Real>::linearise(const Motion<Real>& motion, double, double damping) {
    resistances_.resize(triangles_.size());
    const std::ptrdiff_t stride = motion.stride;
    const glm::dvec3 flow = velocity_.at(motion.t);
    const auto vectorAt = [&](const Real* planes, int i) {
        return glm::dvec3(planes[i], planes[i + stride], planes[i + 2 * stride]);
    };
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        const auto& [a, b, c] = triangles_[t];
        const glm::dvec3 xa = vectorAt(motion.x, a), xb = vectorAt(motion.x, b), xc = vectorAt(motion.x, c);
        const glm::dvec3 cross = glm::cross(xb - xa, xc - xa);
        const double size = std::sqrt(glm::dot(cross, cross));  // 2 A
        const glm::dvec3 normal = size > 0.0 ? cross / size : glm::dvec3(0.0);
        const glm::dvec3 mean = (vectorAt(motion.v, a) + vectorAt(motion.v, b) + vectorAt(motion.v, c)) / 3.0;
        const glm::dvec3 air = flow - mean;
        const double pressure =
            0.25 * settings_.airDensity * sides_[t] * size * settings_.drag * std::abs(glm::dot(air, normal));
        for (int axis = 0; axis < 3; ++axis) resistances_[t].normal[axis] = static_cast<Real>(normal[axis]);
        resistances_[t].each = static_cast<Real>(damping * std::max(0.0, pressure) / 9.0);
    }
    roundResistances_.clear();
    for (const Round& round : rounds_) {
        const Past air = past(round, motion);
        const Real speed = std::sqrt(glm::dot(air.u, air.u));
        const auto drag = static_cast<Real>(damping * std::max(0.0, 0.5 * settings_.airDensity * settings_.drag) / 4.0);
        roundResistances_.push_back({air.axis, speed > 0 ? air.u / speed : Vec(Real(0)), drag * air.area * speed});
    }
}

template <class Real>
void Wind<Real>::addProduct(int stride, const Real* u, Real* out) const {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        const auto& [a, b, c] = triangles_[t];
        const Resistance& r = resistances_[t];
        Real sum[3], along = 0;
        for (int p = 0; p < 3; ++p) {
            sum[p] = u[p * stride + a] + u[p * stride + b] + u[p * stride + c];
            along += r.normal[p] * sum[p];
        }
        for (int p = 0; p < 3; ++p) {
            const Real product = r.each * (sum[p] + along * r.normal[p]);
            for (int i : {a, b, c}) out[p * stride + i] += product;
        }
    }
    for (std::size_t k = 0; k < rounds_.size(); ++k) {
        const auto& [a, b, width, area] = rounds_[k];
        const auto& [axis, along, each] = roundResistances_[k];
        const Vec sum(u[a] + u[b], u[stride + a] + u[stride + b], u[2 * stride + a] + u[2 * stride + b]);
        const Vec product = each * (sum - glm::dot(sum, axis) * axis + glm::dot(sum, along) * along);
        for (int p = 0; p < 3; ++p)
            for (const int i : {a, b}) out[p * stride + i] += product[p];
    }
}

template <class Real>
void Wind<Real>::addDiagonal(int stride, Real* out) const {
    for (std::size_t t = 0; t < triangles_.size(); ++t)
        for (int p = 0; p < 3; ++p) {
            const Real normal = resistances_[t].normal[p];
            for (int i : triangles_[t]) out[p * stride + i] += resistances_[t].each * (Real(1) + normal * normal);
        }
    for (std::size_t k = 0; k < rounds_.size(); ++k) {
        const auto& [a, b, width, area] = rounds_[k];
        const auto& [axis, along, each] = roundResistances_[k];
        const Real pairs = a == b ? 2 : 1;  // a ball is both of its ends
        for (int p = 0; p < 3; ++p)
            for (const int i : {a, b})
                out[p * stride + i] += pairs * each * (Real(1) - axis[p] * axis[p] + along[p] * along[p]);
    }
}

template <class Real>
void Wind<Real>::addStability(const Motion<Real>& motion, StabilityShare& share) const {
    const double speed = workingSpeed();
    const double slope = 2.0 * std::abs(settings_.drag) + 1.5 * std::abs(settings_.lift);
    auto at = [&](int i) {
        const std::ptrdiff_t stride = motion.stride;
        return glm::dvec3(motion.x[i], motion.x[i + stride], motion.x[i + 2 * stride]);
    };
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        const auto& [a, b, c] = triangles_[t];
        const double area = 0.5 * glm::length(glm::cross(at(b) - at(a), at(c) - at(a)));
        const double damping =
            0.5 * settings_.airDensity * sides_[t] * area * speed * slope / 3.0;  // [kg/s] of a corner
        for (int i : {a, b, c}) share.dampingRate[i] += damping * static_cast<double>(motion.inverseMass[i]);
        if (plateAir_.empty()) continue;
        const Facet<double> facet(at(a), at(b), at(c));
        double steepness[3];
        for (std::size_t k = 0; k < 3; ++k) steepness[k] = glm::length(facet.gradients[k]);
        const double all = steepness[0] + steepness[1] + steepness[2];
        for (std::size_t k = 0; k < 3; ++k) {
            const auto own = static_cast<std::size_t>(triangles_[t][k]);
            const double rate = static_cast<double>(plateAir_[t]) * speed * (2.0 * steepness[k] + 5.0 / 3.0 * all);
            share.dampingRate[own] += rate * static_cast<double>(motion.inverseMass[own]);
            share.stiffness[own] += rate * speed * all;
        }
    }
    for (const Round& round : rounds_) {
        const Vec way = wayAlong(round, motion);
        const double across = round.area + round.width * std::sqrt(static_cast<double>(glm::dot(way, way)));
        const double damping =
            0.5 * settings_.airDensity * std::abs(settings_.drag) * across * speed;  // [kg/s] of an end
        for (const int i : {round.a, round.b})
            share.dampingRate[i] += damping * static_cast<double>(motion.inverseMass[i]);
    }
}

template class Wind<float>;
template class Wind<double>;

}  // namespace taut::mechanics
