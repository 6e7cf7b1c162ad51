#include "taut/contact/round_solids.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <optional>

#include "taut/contact/closest_points.h"

namespace taut::contact {
namespace {

constexpr double flat = 0.02;    // sine of the angle to the axis up to which a normal meets an end as a whole
constexpr double inside = 1e-9;  // weight of a corner of a triangle from which a place is on its face
constexpr double level = 1e-6;   // sine of the angle up to which a face beside an edge does not rise
constexpr double rounding = 1e-9;
constexpr int mostRounds = 40;

// The side of a solid of revolution, without its rounding by the thickness.
class Mantle {
  public:
    Mantle(const ContactSurface::Revolution& own, std::span<const dvec3> x)
        : from_(x[static_cast<std::size_t>(own.ends[0])]), radii_(own.radii) {
        axis_ = x[static_cast<std::size_t>(own.ends[1])] - from_;
        length_ = length(axis_);
        axis_ /= length_;
        const double widest = std::max(radii_[0], radii_[1]);
        cosine_ = 1.0 - own.sag / widest;
        const double narrows = radii_[0] - radii_[1];
        slope_ = narrows / std::sqrt(narrows * narrows + length_ * length_);
        least_ = 1e-3 * widest;
    }

    const dvec3& axis() const { return axis_; }
    bool isCylinder() const { return std::abs(slope_) < rounding; }
    double along(const dvec3& place) const { return glm::dot(place - from_, axis_); }
    dvec3 middleAt(double along) const { return from_ + along * axis_; }
    double radiusAt(double along) const {
        return radii_[0] + (radii_[1] - radii_[0]) * std::clamp(along / length_, 0.0, 1.0);
    }
    // Of a place of the prism.
    bool isAround(const dvec3& place) const {
        const double z = along(place), radius = radiusAt(z);
        return radius > least_ && length(place - middleAt(z)) > radius * cosine_ * (1 - rounding);
    }
    // Whether this normal (unit, outward) is the side's, not that of a rim.
    bool isOfSide(const dvec3& normal) const { return std::abs(glm::dot(normal, axis_) - slope_) < flat; }
    // Its place nearest to one outside, which is not on the axis.
    std::optional<dvec3> nearestTo(const dvec3& place) const {
        const double z = along(place);
        const dvec3 way = place - middleAt(z);
        const double rho = length(way), narrows = radii_[0] - radii_[1];
        if (!(rho > 0)) return std::nullopt;
        // In the half-plane of the place: along the line from one rim to the other.
        const double share = ((radii_[0] - rho) * narrows + z * length_) / (narrows * narrows + length_ * length_);
        const double at = std::clamp(share, 0.0, 1.0), radius = radii_[0] - at * narrows;
        const double radial = share < 0 || share > 1 ? std::min(rho, radius) : radius;  // over an end, or not
        const double outside = (rho - radii_[0]) * length_ + z * narrows;               // of the line
        if (!(outside > 0 || z < 0 || z > length_)) return std::nullopt;
        return middleAt(at * length_) + (radial / rho) * way;
    }
    // Whether edges of the prism that make an angle of this cosine with the axis are lines of its side, not diagonals.
    bool isLine(double lean) const { return lean > (1 - rounding) * std::sqrt(1 - slope_ * slope_); }
    // Of a corner of the prism, the place of the ridge in this direction (unit, across the axis) if that is no further
    // than half of a side, else its own as if it were not beside the ridge.
    dvec3 ridgeAt(const dvec3& corner, const dvec3& out) const {
        const double z = along(corner), radius = radiusAt(z), own = glm::dot(corner - middleAt(z), out);
        return middleAt(z) + (own > radius * cosine_ * (1 - rounding) ? radius : own) * out;
    }

  private:
    dvec3 from_, axis_;
    double length_;
    std::array<double, 2> radii_;
    double cosine_;  // of half the angle of one of the prism's sides
    double slope_;   // of the side's normal along the axis
    double least_;   // radius of a tip
};

std::optional<Mantle> mantleOf(const Elements& elements, int surface, std::span<const dvec3> x) {
    if (surface < 0 || elements.surface(surface).revolution.isNone()) return std::nullopt;
    return Mantle(elements.surface(surface).revolution, x);
}

// What is across an axis of a vector.
dvec3 acrossAxis(const dvec3& v, const dvec3& axis) {
    return v - glm::dot(v, axis) * axis;
}

// A pair as two feet on its sides.
struct Feet {
    ContactConstraint& pair;
    std::span<const dvec3> x;
    std::optional<Mantle> mantles[2];
    dvec3 at[2];
    int first(int side) const { return side == 0 ? 0 : pair.firstSide(); }
    int last(int side) const { return side == 0 ? pair.firstSide() : 4; }
    const dvec3& corner(int k) const { return x[static_cast<std::size_t>(pair.points[static_cast<std::size_t>(k)])]; }
    double weight(int k) const { return std::abs(pair.weights[static_cast<std::size_t>(k)]); }
    // The corners of the feature that a foot is on: of a face, an edge, or one alone; of a pair of edges, of the edge.
    // Those of no length or area have one alone.
    std::vector<int> feature(int side) const {
        std::vector<int> corners;
        for (int k = first(side); k < last(side); ++k)
            if (!pair.isPoint || weight(k) > inside) corners.push_back(k);
        const auto way = [&](std::size_t k) { return corner(corners[k]) - corner(corners[0]); };
        const bool isFlat = (corners.size() == 2 && way(1) == dvec3(0.0)) ||
                            (corners.size() == 3 && glm::cross(way(1), way(2)) == dvec3(0.0));
        if (isFlat) corners.resize(1);
        return corners;
    }
    dvec3 outward(int side) const { return side == 0 ? -pair.normal : pair.normal; }
};

// Moves the foot along a face or an edge with these corners, so that the impulse acts there.
void moveFoot(Feet& feet, int side, const std::vector<int>& corners, const dvec3& way) {
    const double sign = side == 0 ? 1.0 : -1.0;
    const auto add = [&](std::size_t k, double share) {
        feet.pair.weights[static_cast<std::size_t>(corners[k])] += sign * share;
        feet.pair.weights[static_cast<std::size_t>(corners[0])] -= sign * share;
    };
    const dvec3 a = feet.corner(corners[0]), ab = feet.corner(corners[1]) - a;
    feet.at[side] += way;
    if (corners.size() == 2) return add(1, glm::dot(way, ab) / glm::dot(ab, ab));
    const dvec3 ac = feet.corner(corners[2]) - a, normal = glm::cross(ab, ac);
    const double square = glm::dot(normal, normal);
    add(1, glm::dot(normal, glm::cross(way, ac)) / square);
    add(2, glm::dot(normal, glm::cross(ab, way)) / square);
}

// A corner of the prism, at a face that says the normal.
void touchFace(Feet& feet, int own, const std::vector<int>& corners, const dvec3& out) {
    const dvec3 before = feet.at[own], outward = feet.outward(own);
    feet.at[own] = feet.mantles[own]->ridgeAt(before, out);
    const dvec3 way = feet.at[own] - before;
    moveFoot(feet, 1 - own, corners, way - glm::dot(way, outward) * outward);
}

// The place between two where a line is nearest to the round solid: from there on it goes away. None if that is not
// between them. What is as far everywhere stays at `before`.
std::optional<dvec3> nearestBetween(const Mantle& mantle, const dvec3& a, const dvec3& b, const dvec3& before) {
    const double size = glm::distance(a, b);
    const dvec3 edge = (b - a) / size;
    const auto leaves = [&](double s) {
        const dvec3 place = a + s * edge;
        const std::optional<dvec3> nearest = mantle.nearestTo(place);
        return nearest ? glm::dot((place - *nearest) / glm::distance(place, *nearest), edge) : 0.0;
    };
    double low = 0.0, high = size, atLow = leaves(low), atHigh = leaves(high);
    if (std::max(std::abs(atLow), std::abs(atHigh)) < level) return before;
    if (!(atLow < 0 && atHigh > 0)) return std::nullopt;
    // Regula falsi, with the halves of Illinois.
    double s = low;
    for (int round = 0, last = 0; round < mostRounds; ++round) {
        s = (low * atHigh - high * atLow) / (atHigh - atLow);
        const double at = leaves(s);
        if (std::abs(at) < rounding) break;
        const int sign = at < 0 ? -1 : 1;
        (sign < 0 ? low : high) = s;
        (sign < 0 ? atLow : atHigh) = at;
        if (sign == last) (sign < 0 ? atHigh : atLow) *= 0.5;
        last = sign;
    }
    return a + s * edge;
}

// The round side says the normal: it points to the nearest place of an edge or a corner, or of the axis of a cylinder
// that these are on. Returns whether there is one.
bool pointAt(Feet& feet, int own, const std::vector<int>& corners) {
    const int other = 1 - own;
    const Mantle& mantle = *feet.mantles[own];
    const std::optional<Mantle>& others = feet.mantles[other];
    const bool isRound =
        others && others->isCylinder() && others->isAround(feet.at[other]) && others->isOfSide(-feet.outward(own));
    dvec3 place = feet.at[other];
    if (corners.size() == 2) {
        const dvec3 a = feet.corner(corners[0]), b = feet.corner(corners[1]);
        const auto middle = [&](const dvec3& of) { return isRound ? others->middleAt(others->along(of)) : of; };
        const std::optional<dvec3> found = nearestBetween(mantle, middle(a), middle(b), middle(place));
        if (!found) return false;
        const dvec3 edge = (b - a) / glm::distance(a, b);
        moveFoot(feet, other, corners, glm::dot(*found - place, edge) * edge);
        place = *found;
    } else if (isRound) {
        place = others->middleAt(others->along(place));
    }
    const std::optional<dvec3> nearest = mantle.nearestTo(place);
    if (!nearest) return false;
    feet.at[own] = *nearest;
    const dvec3 outward = (place - *nearest) / glm::distance(place, *nearest);
    feet.pair.normal = own == 0 ? -outward : outward;
    return true;
}

// Puts the foot on the round side where it touches the other. Returns whether it does there.
bool roundOff(Feet& feet, int own) {
    ContactConstraint& pair = feet.pair;
    const Mantle& mantle = *feet.mantles[own];
    const dvec3 across = acrossAxis(feet.outward(own), mantle.axis());
    const double sine = length(across);
    if (sine < flat || !mantle.isAround(feet.at[own])) return true;
    const std::vector<int> corners = feet.feature(1 - own);
    if (corners.size() == 3)
        touchFace(feet, own, corners, across / sine);
    else if (!pointAt(feet, own, corners))
        return false;
    pair.distance = glm::dot(feet.outward(own), feet.at[1 - own] - feet.at[own]);
    pair.place = feet.at[0] - pair.firstShare * pair.distance * pair.normal;
    return true;
}

// Whether an edge of the prism, at its foot, is one of the round solid: a line of the side where it touches with that,
// or a chord of a rim where it touches with that.
bool isOfRound(const Feet& feet, int side) {
    const Mantle& mantle = *feet.mantles[side];
    if (feet.pair.isPoint || !mantle.isAround(feet.at[side])) return true;
    const dvec3 way = feet.corner(feet.first(side) + 1) - feet.corner(feet.first(side));
    const double lean = std::abs(glm::dot(way, mantle.axis())) / length(way);
    return mantle.isOfSide(feet.outward(side)) ? mantle.isLine(lean) : lean < rounding;
}

// Whether an edge or a corner of a solid or a collider is closest to a round side, and not a face beside it: over that
// the round side would be held up by each edge that it rolls over.
bool isNearest(const Feet& feet, int side, const Elements& elements) {
    const std::vector<int> corners = feet.feature(side);
    const auto point = [&](int k) { return feet.pair.points[static_cast<std::size_t>(k)]; };
    const ContactSurface& surface = elements.surface(elements.surfaceOf(point(corners[0])));
    if (corners.size() == 3 || (surface.solid < 0 && !surface.isOfCollider())) return true;
    const dvec3 outward = feet.outward(side);
    const auto rises = [&](int i) {
        const dvec3 way = feet.x[static_cast<std::size_t>(i)] - feet.at[side];
        return glm::dot(way, outward) > level * length(way);
    };
    const auto around = elements.neighbours(point(corners[0]));
    if (corners.size() == 1) return std::none_of(around.begin(), around.end(), rises);
    // Corners of the faces beside an edge are next to both of its ends.
    const auto next = elements.neighbours(point(corners[1]));
    return std::none_of(around.begin(), around.end(),
                        [&](int i) { return std::find(next.begin(), next.end(), i) != next.end() && rises(i); });
}

void takeSag(ContactConstraint& pair, int side, double sag) {
    const double first = pair.firstShare * pair.thickness - (side == 0 ? sag : 0.0);
    pair.thickness -= sag;
    pair.firstShare = first / pair.thickness;
}

}  // namespace

dvec3 ridgeAt(const Elements& elements, int corner, const dvec3& normal, std::span<const dvec3> x) {
    const dvec3& place = x[static_cast<std::size_t>(corner)];
    const std::optional<Mantle> mantle = mantleOf(elements, elements.surfaceOf(corner), x);
    if (!mantle) return place;
    const dvec3 across = acrossAxis(-normal, mantle->axis());
    const double sine = length(across);
    return sine < flat || !mantle->isAround(place) ? place : mantle->ridgeAt(place, across / sine);
}

void roundOff(const Elements& elements, std::span<const dvec3> x, std::vector<ContactConstraint>& pairs) {
    std::erase_if(
        pairs,
        [&](ContactConstraint& pair) {
            const int surfaces[] = {elements.surfaceOf(pair.points[0]), elements.surfaceOf(pair.points[3])};
            Feet feet{pair, x, {mantleOf(elements, surfaces[0], x), mantleOf(elements, surfaces[1], x)}, {}};
            if (!feet.mantles[0] && !feet.mantles[1]) return false;
            for (const int side : {0, 1}) {
                if (feet.mantles[side]) takeSag(pair, side, elements.surface(surfaces[side]).revolution.sag);
                feet.at[side] = dvec3(0.0);
                for (int k = feet.first(side); k < feet.last(side); ++k)
                    feet.at[side] += feet.weight(k) * feet.corner(k);
            }
            for (const int side : {0, 1})
                if (feet.mantles[side] && !isOfRound(feet, side)) return true;
            for (const int side : {1, 0})  // of a pair of two, a face takes its normal from the other's axis first
                if (feet.mantles[side] && !roundOff(feet, side)) return true;
            for (const int side : {0, 1})
                if (pair.place && !feet.mantles[side] && !isNearest(feet, side, elements)) return true;
            return false;
        });
}

}  // namespace taut::contact
