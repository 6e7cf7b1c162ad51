#include "taut/mechanics/rigid.h"

#include <cmath>
#include <glm/glm.hpp>

#include "taut/core/error.h"
#include "taut/core/rigid_motion.h"

namespace taut::mechanics {
namespace {

// Share of the mass at points that touch: the more, the less spread is left for the inner ones, which needs to be some.
constexpr double touchingShare = 0.05;
constexpr double leastTouching = 1e-9;  // the same share: with less, rounding would decide where they are

dmat3 outer(const dvec3& a, const dvec3& b) {
    return glm::outerProduct(a, b);
}

// L of S = L Lᵀ, lower. Returns whether S is positive definite.
bool factor(const dmat3& s, dmat3& l) {
    l = dmat3(0.0);
    for (int j = 0; j < 3; ++j)
        for (int i = j; i < 3; ++i) {
            double sum = s[j][i];
            for (int k = 0; k < j; ++k) sum -= l[k][i] * l[k][j];
            if (i == j && !(sum > 1e-12 * s[j][j])) return false;
            l[j][i] = i == j ? std::sqrt(sum) : sum / l[j][j];
        }
    return true;
}

RigidPart shifted(RigidPart part, int points) {
    part.first += points;
    part.last += points;
    return part;
}

dmat3 turnedBy(const dvec3& angle) {
    const double w = 1.0 / std::sqrt(1.0 + 0.25 * glm::dot(angle, angle));
    const dvec3 q = (0.5 * w) * angle;
    const dmat3 across(0, q.z, -q.y, -q.z, 0, q.x, q.y, -q.x, 0);
    return dmat3(1.0) + 2.0 * (w * across + across * across);
}

dvec3 centreOf(std::span<const double> masses, std::span<const dvec3> x, double& mass) {
    dvec3 sum(0.0);
    mass = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        sum += masses[i] * x[i];
        mass += masses[i];
    }
    return sum / mass;
}

}  // namespace

void join(RigidShape& compound, const RigidShape& shape) {
    const int first = static_cast<int>(compound.positions.size());
    for (const dvec3& x : shape.positions) compound.positions.push_back(shape.place + shape.axes * x);
    for (const auto& [a, b, c] : shape.triangles) compound.triangles.push_back({first + a, first + b, first + c});
    for (const auto& [a, b] : shape.lines) compound.lines.push_back({first + a, first + b});
    const std::string name = "part" + std::to_string(compound.parts.size());
    for (int i = first; i < static_cast<int>(compound.positions.size()); ++i) compound.groups[name].push_back(i);
    for (const auto& [side, points] : shape.groups)
        for (const int i : points) compound.groups[name + "-" + side].push_back(first + i);
    for (const RigidPart& part : shape.parts) compound.parts.push_back(shifted(part, first));
    core::MassProperties& all = compound.properties;
    const core::MassProperties& own = shape.properties;
    const double mass = compound.mass + shape.mass, volume = all.volume + own.volume;
    const dvec3 centre = shape.place + shape.axes * own.centre;
    const dvec3 between = centre - all.centre;
    dmat3 spread = (shape.mass / own.volume) * (shape.axes * own.spread * glm::transpose(shape.axes));  // [kg m²]
    if (compound.mass > 0) spread += (compound.mass / all.volume) * all.spread;
    spread += (compound.mass * shape.mass / mass) * outer(between, between);
    all = {volume, all.centre + (shape.mass / mass) * between, (volume / mass) * spread};
    compound.mass = mass;
}

Model buildRigid(const RigidShape& shape) {
    const std::size_t count = shape.positions.size();
    const double density = shape.mass / shape.properties.volume;
    const dvec3& centre = shape.properties.centre;
    // The inner points compensate: the touching ones draw centre and spread towards them.
    dmat3 axes(0.0);
    dvec3 innerCentre(0.0);
    double share = touchingShare;
    for (;; share *= 0.5) {
        if (!(share > leastTouching))
            throw core::Error(core::ErrorKind::badContent,
                              "nearly all of the mass is in one place, and parts without much of it lie far away; put "
                              "them nearer, or give them more");
        const double each = share * shape.mass / static_cast<double>(count);
        dvec3 moment(0.0);
        dmat3 spread = density * shape.properties.spread;
        for (const dvec3& x : shape.positions) {
            moment += each * (x - centre);
            spread -= each * outer(x - centre, x - centre);
        }
        const double inner = (1.0 - share) * shape.mass;
        innerCentre = -moment / inner;
        spread -= inner * outer(innerCentre, innerCentre);
        if (factor(spread * (3.0 / inner), axes)) break;
    }

    Model model;
    const auto add = [&](const dvec3& x, double mass) {
        model.positions.push_back(shape.place + shape.axes * x);
        model.masses.push_back(mass);
    };
    for (int i = 0; i < innerPoints; ++i) {
        const dvec3 arm = (i % 2 == 0 ? 1.0 : -1.0) * axes[i / 2];
        add(centre + innerCentre + arm, (1.0 - share) * shape.mass / innerPoints);
    }
    for (const dvec3& x : shape.positions) add(x, share * shape.mass / static_cast<double>(count));
    const std::size_t all = model.positions.size();
    model.velocities.assign(all, dvec3(0.0));
    model.dragRates.assign(all, shape.dragRate);
    model.held.assign(all, false);
    model.uv.assign(all, glm::dvec2(0.0));
    for (std::array<int, 3> t : shape.triangles) {
        for (int& i : t) i += innerPoints;
        model.triangles.push_back(t);
    }
    for (const std::array<int, 2>& line : shape.lines)
        model.springs.push_back({.a = line[0] + innerPoints,
                                 .b = line[1] + innerPoints,
                                 .restLength = glm::length(shape.positions[line[1]] - shape.positions[line[0]])});
    for (int i = 0; i < model.pointCount(); ++i) model.groups["all"].push_back(i);
    for (int i = 0; i < innerPoints; ++i) model.groups["inner"].push_back(i);
    for (const auto& [name, points] : shape.groups)
        for (const int i : points) model.groups[name].push_back(i + innerPoints);
    model.innerPoints = innerPoints;
    for (const RigidPart& part : shape.parts) model.parts.push_back(shifted(part, innerPoints));
    return model;
}

// A corner moves by the vector with `outward` along the normals of all faces there, by least squares; across all of
// them it stays.
std::vector<dvec3> withFacesOutward(std::span<const dvec3> positions, std::span<const std::array<int, 3>> triangles,
                                    double outward) {
    constexpr double none = 1e-6;
    std::vector<dmat3> squares(positions.size(), dmat3(none));
    std::vector<dvec3> sums(positions.size(), dvec3(0.0));
    for (const std::array<int, 3>& t : triangles) {
        const auto at = [&](std::size_t k) { return positions[t[k]]; };
        const dvec3 normal = glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0)));
        for (const int i : t) {
            squares[i] += glm::outerProduct(normal, normal);
            sums[i] += outward * normal;
        }
    }
    std::vector<dvec3> moved(positions.begin(), positions.end());
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += glm::inverse(squares[i]) * sums[i];
    return moved;
}

dmat3 rotationBetween(const std::array<dvec3, 3>& rest, const std::array<dvec3, 3>& now) {
    const auto triad = [](const std::array<dvec3, 3>& p) {
        const dvec3 u = glm::normalize(p[1] - p[0]), w = glm::normalize(glm::cross(u, p[2] - p[0]));
        return dmat3(u, glm::cross(w, u), w);
    };
    return triad(now) * glm::transpose(triad(rest));
}

void placeRigidly(std::span<const double> masses, std::span<const dvec3> rest, std::span<const dvec3> from,
                  std::span<dvec3> x) {
    constexpr int mostRounds = 30;
    constexpr double settled = 1e-15;  // [rad]
    constexpr double longest = 0.5;    // [rad] of a round
    double mass = 0;
    const dvec3 restCentre = centreOf(masses, rest, mass), oldCentre = centreOf(masses, from, mass);
    const dvec3 centre = centreOf(masses, std::span<const dvec3>(x), mass);
    // b(Q) = Σ m from × Q rest has to become b0 = Σ m from × x. Newton's method over rotations. A quarter turn has the
    // most momentum: if more is wanted, it ends with about that turn.
    dmat3 mixed(0.0);  // Σ m rest fromᵀ
    dvec3 wanted(0.0);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const dvec3 old = from[i] - oldCentre;
        mixed += outer(masses[i] * (rest[i] - restCentre), old);
        wanted += masses[i] * glm::cross(old, x[i] - centre);
    }
    dmat3 turn = rotationBetween({rest[0], rest[2], rest[4]}, {x[0], x[2], x[4]});
    for (int round = 0; round < mostRounds; ++round) {
        const dmat3 b = turn * mixed;  // b[j][i] = Σ m (Q rest)_i from_j
        const dvec3 now(b[2][1] - b[1][2], b[0][2] - b[2][0], b[1][0] - b[0][1]);
        dvec3 angle = glm::inverse(core::inertiaOf(b)) * (wanted + now);
        const double size = std::sqrt(glm::dot(angle, angle));
        if (!std::isfinite(size)) break;
        if (size > longest) angle *= longest / size;
        turn = turnedBy(angle) * turn;
        if (glm::dot(angle, angle) < settled * settled) break;
    }
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = centre + turn * (rest[i] - restCentre);
}

void moveRigidly(std::span<const double> masses, std::span<const dvec3> x, std::span<dvec3> v) {
    const core::RigidMotion motion = core::rigidMotionOf(masses, x, v);
    for (std::size_t i = 0; i < x.size(); ++i) v[i] = motion.velocityAt(x[i]);
}

}  // namespace taut::mechanics
