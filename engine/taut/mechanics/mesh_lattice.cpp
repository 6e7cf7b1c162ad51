#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "taut/core/error.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/closed_mesh.h"
#include "taut/mechanics/lattice.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;
using glm::ivec3;
using Triangle = std::array<int, 3>;
using Polygon = std::vector<dvec3>;

constexpr double leastFilled = 1e-9;      // of a cell: less is nothing
constexpr double fullEnough = 1e-9;       // as near to 1 it is rounding
constexpr double mostDrawnOut = 0.05;     // of a cube, where it then fits the mesh's box
constexpr double smallShare = 0.25;       // less is left out where a neighbour can carry it,
constexpr double muchFuller = 4;          // one that is not small, or has so many times as much
constexpr double leastCorner = 1.0 / 16;  // of a cell: least share of a corner, for the step; an even share is 1/8

ivec3 bitsOf(std::size_t corner) {
    const int c = static_cast<int>(corner);
    return {c & 1, (c >> 1) & 1, (c >> 2) & 1};
}

const dvec3& at(std::span<const dvec3> positions, int i) {
    return positions[i];
}

double sixfoldVolume(std::span<const dvec3> x, const Triangle& t) {
    const dvec3& origin = x.front();
    return glm::dot(at(x, t[0]) - origin, glm::cross(at(x, t[1]) - origin, at(x, t[2]) - origin));
}

// The parts of a mesh: of each triangle the lowest vertex that hangs together with it.
std::vector<int> partsOf(std::span<const Triangle> triangles, std::size_t vertices) {
    std::vector<int> root(vertices);
    std::iota(root.begin(), root.end(), 0);
    const auto rootOf = [&](int v) {
        while (root[v] != v) {
            int& up = root[v];
            up = root[up];
            v = up;
        }
        return v;
    };
    for (const Triangle& t : triangles)
        for (const int other : {t[1], t[2]}) {
            const int a = rootOf(t[0]), b = rootOf(other);
            root[std::max(a, b)] = std::min(a, b);
        }
    std::vector<int> parts;
    for (const Triangle& t : triangles) parts.push_back(rootOf(t[0]));
    return parts;
}

// Cuts a polygon along x, y and z at whole numbers, and visits the pieces.
template <class Visit>
void cutIntoCells(Polygon polygon, int axis, const Visit& visit) {
    if (axis == 3) return visit(polygon);
    const auto below = [&](const dvec3& a, const dvec3& b) { return a[axis] < b[axis]; };
    const auto [least, most] = std::minmax_element(polygon.begin(), polygon.end(), below);
    const double high = (*most)[axis];
    for (double plane = std::floor((*least)[axis]) + 1.0; plane < high; plane += 1.0) {
        Polygon under, over;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            (a[axis] <= plane ? under : over).push_back(a);
            if ((a[axis] <= plane) == (b[axis] <= plane)) continue;
            const dvec3 &low = a[axis] < b[axis] ? a : b, &top = a[axis] < b[axis] ? b : a;
            dvec3 between = low + (plane - low[axis]) / (top[axis] - low[axis]) * (top - low);
            between[axis] = plane;
            under.push_back(between);
            over.push_back(between);
        }
        cutIntoCells(std::move(under), axis + 1, visit);
        polygon = std::move(over);
    }
    cutIntoCells(std::move(polygon), axis + 1, visit);
}

// Seven places in a triangle, by the weights of its corners, that integrate polynomials of degree 5 (Radon 1948).
struct GaussPoint {
    dvec3 corners;
    double weight;
};
std::array<GaussPoint, 7> gaussPoints() {
    const double root = std::sqrt(15.0);
    std::array<GaussPoint, 7> all;
    all[0] = {dvec3(1.0 / 3.0), 9.0 / 40.0};
    for (const int side : {0, 1}) {
        const double sign = side == 0 ? -1.0 : 1.0, beta = (6.0 + sign * root) / 21.0;
        for (int k = 0; k < 3; ++k) {
            dvec3 corners(beta);
            corners[k] = 1.0 - 2.0 * beta;
            all[1 + 3 * side + k] = {corners, (155.0 + sign * root) / 1200.0};
        }
    }
    return all;
}

// The filled part, from the surface alone (Gauss): the space behind a piece of it, towards low x, is filled if it faces
// high x, and subtracted again if it faces low x. So each piece adds ∫ N dx up to where it is to its own cell, and all
// of N to the cells behind.
class Filler {
  public:
    explicit Filler(ivec3 counts)
        : counts_(counts),
          shares_(static_cast<std::size_t>(counts.x) * static_cast<std::size_t>(counts.y) *
                  static_cast<std::size_t>(counts.z)),
          behind_(shares_.size()) {}

    void add(const Polygon& piece) {
        dvec3 middle(0.0);
        for (const dvec3& x : piece) middle += x / static_cast<double>(piece.size());
        const ivec3 cell = glm::clamp(ivec3(glm::floor(middle)), ivec3(0), counts_ - 1);
        const std::size_t index = indexOf(cell);
        for (std::size_t i = 2; i < piece.size(); ++i) {
            const dvec3 a = piece[0] - dvec3(cell), b = piece[i - 1] - dvec3(cell), c = piece[i] - dvec3(cell);
            const double area = 0.5 * ((b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y));
            if (area == 0.0) continue;
            for (const GaussPoint& node : nodes_) {
                const dvec3 x = node.corners.x * a + node.corners.y * b + node.corners.z * c;
                const double along[2] = {x.x - 0.5 * x.x * x.x, 0.5 * x.x * x.x};
                for (std::size_t corner = 0; corner < 4; ++corner) {
                    const double across =
                        area * node.weight * (corner & 1 ? x.y : 1.0 - x.y) * (corner & 2 ? x.z : 1.0 - x.z);
                    shares_[index][2 * corner] += across * along[0];
                    shares_[index][2 * corner + 1] += across * along[1];
                    behind_[index][corner] += across;
                }
            }
        }
    }

    std::vector<std::array<double, 8>> take() {
        for (int z = 0; z < counts_.z; ++z)
            for (int y = 0; y < counts_.y; ++y) {
                std::array<double, 4> sum{};
                for (int x = counts_.x - 1; x >= 0; --x) {
                    const std::size_t index = indexOf({x, y, z});
                    for (std::size_t corner = 0; corner < 4; ++corner) {
                        shares_[index][2 * corner] += 0.5 * sum[corner];
                        shares_[index][2 * corner + 1] += 0.5 * sum[corner];
                        sum[corner] += behind_[index][corner];
                    }
                }
            }
        return std::move(shares_);
    }

  private:
    std::size_t indexOf(ivec3 p) const { return indexIn(counts_, p); }

    ivec3 counts_;
    std::array<GaussPoint, 7> nodes_ = gaussPoints();
    std::vector<std::array<double, 8>> shares_;
    std::vector<std::array<double, 4>> behind_;
};

double sumOf(const std::array<double, 8>& shares) {
    return std::accumulate(shares.begin(), shares.end(), 0.0);
}

// Which cells stay, and which carry the contents of the others.
class Choice {
  public:
    Choice(const Lattice& lattice, std::vector<std::array<double, 8>>& shares)
        : lattice_(lattice), shares_(shares), stays_(shares.size()), carrier_(shares.size(), -1) {
        for (std::size_t i = 0; i < shares.size(); ++i) stays_[i] = sumOf(shares[i]) >= leastFilled;
    }

    // The smallest go first.
    void leaveOutSmall() {
        std::vector<std::pair<double, std::size_t>> small;
        for (std::size_t i = 0; i < shares_.size(); ++i)
            if (const double share = sumOf(shares_[i]); stays_[i] && share < smallShare) small.emplace_back(share, i);
        std::sort(small.begin(), small.end());
        for (const auto& [share, index] : small) {
            const std::optional<ivec3> way = wayToCarrier(placeOf(index));
            if (!way || !isSimple(placeOf(index))) continue;
            stays_[index] = false;
            carrier_[index] = static_cast<int>(lattice_.indexOf(placeOf(index) + *way));
        }
        // Carried contents go along where their carrier is left out too.
        for (const auto& [share, index] : small)
            if (carrier_[index] >= 0) carry(index, static_cast<std::size_t>(carrier_[index]));
        for (std::size_t k = small.size(); k-- > 0;)
            if (int& carrier = carrier_[small[k].second]; carrier >= 0 && !stays_[carrier]) carrier = carrier_[carrier];
    }

    bool stays(std::size_t index) const { return stays_[index]; }
    int carrier(std::size_t index) const { return carrier_[index]; }

    ivec3 placeOf(std::size_t index) const {
        const int i = static_cast<int>(index), row = i / lattice_.counts.x;
        return {i % lattice_.counts.x, row % lattice_.counts.y, row / lattice_.counts.y};
    }

  private:
    static constexpr ivec3 ways[6] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};

    bool isIn(ivec3 p) const {
        return glm::all(glm::greaterThanEqual(p, ivec3(0))) && glm::all(glm::lessThan(p, lattice_.counts));
    }
    bool isThere(ivec3 p) const { return isIn(p) && stays_[lattice_.indexOf(p)]; }

    // To the fullest neighbour.
    std::optional<ivec3> wayToCarrier(ivec3 place) const {
        std::optional<ivec3> best;
        double most = std::min(smallShare, muchFuller * sumOf(shares_[lattice_.indexOf(place)]));
        for (const ivec3& way : ways) {
            if (!isThere(place + way)) continue;
            const double share = sumOf(shares_[lattice_.indexOf(place + way)]);
            if (share < most || (best && share == most)) continue;
            most = share;
            best = way;
        }
        return best;
    }

    // Whether its neighbours hang together without it, within the 26 around it.
    bool isSimple(ivec3 place) const {
        std::array<bool, 27> isReached{};
        std::vector<ivec3> found;
        int parts = 0;
        const auto reach = [&](ivec3 p) {
            const ivec3 d = p - place;
            bool& reached = isReached[(d.z + 1) * 9 + (d.y + 1) * 3 + d.x + 1];
            if (reached || d == ivec3(0) || !isThere(p)) return;
            reached = true;
            found.push_back(p);
        };
        for (const ivec3& way : ways) {
            found.clear();
            reach(place + way);
            if (!found.empty()) ++parts;
            while (!found.empty()) {
                const ivec3 p = found.back();
                found.pop_back();
                for (const ivec3& on : ways)
                    if (glm::all(glm::lessThanEqual(glm::abs(p + on - place), ivec3(1)))) reach(p + on);
            }
        }
        return parts == 1;
    }

    // Over to the neighbour, whose N go on beyond it.
    void carry(std::size_t from, std::size_t to) {
        const ivec3 way = placeOf(to) - placeOf(from);
        const std::size_t axis = way.x != 0 ? 0 : way.y != 0 ? 1 : 2, bit = std::size_t{1} << axis;
        const bool isLower = way[static_cast<int>(axis)] < 0;
        for (std::size_t low = 0; low < 8; ++low) {
            if (low & bit) continue;
            const double near = shares_[from][isLower ? low : low | bit],
                         far = shares_[from][isLower ? low | bit : low];
            shares_[to][isLower ? low | bit : low] += 2.0 * far + near;
            shares_[to][isLower ? low : low | bit] -= far;
        }
        shares_[from] = {};
    }

    const Lattice& lattice_;
    std::vector<std::array<double, 8>>& shares_;
    std::vector<bool> stays_;
    std::vector<int> carrier_;
};

// Eighths for full cells, no more than that where parts overlap, and enough for each corner.
void tidy(std::array<double, 8>& shares) {
    const double share = sumOf(shares);
    if (std::abs(share - 1.0) < fullEnough) {
        shares.fill(0.125);
        return;
    }
    for (double& s : shares) s = std::max(s, leastCorner * share);
    const double now = sumOf(shares);
    for (double& s : shares) s *= share / now;
}

// Fills in the numbers of the cells' corners.
void numberPoints(Lattice& lattice) {
    const ivec3 n = lattice.counts + 1;
    std::vector<int> numbers(
        static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) * static_cast<std::size_t>(n.z), -1);
    for (const LatticeCell& cell : lattice.cells)
        for (std::size_t c = 0; c < 8; ++c) numbers[indexIn(n, cell.at + bitsOf(c))] = 0;
    for (int z = 0; z < n.z; ++z)
        for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x)
                if (int& number = numbers[indexIn(n, {x, y, z})]; number == 0) {
                    number = static_cast<int>(lattice.points.size());
                    lattice.points.emplace_back(x, y, z);
                }
    for (LatticeCell& cell : lattice.cells)
        for (std::size_t c = 0; c < 8; ++c) cell.points[c] = numbers[indexIn(n, cell.at + bitsOf(c))];
}

struct Box {
    dvec3 low{std::numeric_limits<double>::infinity()}, high{-low};
    void add(const dvec3& x) {
        low = glm::min(low, x);
        high = glm::max(high, x);
    }
};

Box boxOf(std::span<const dvec3> positions) {
    Box box;
    for (const dvec3& x : positions) box.add(x);
    return box;
}

struct Grid {
    dvec3 counts{1.0}, cell{0.0};
};

Grid gridOf(const Box& box, double side) {
    Grid grid;
    for (int axis = 0; axis < 3; ++axis) {
        const double size = box.high[axis] - box.low[axis], count = size / side, nearest = std::floor(count + 0.5);
        const bool fits = nearest >= 1.0 && std::abs(count - nearest) <= mostDrawnOut * nearest;
        grid.counts[axis] = fits ? nearest : std::max(std::ceil(count), 1.0);
        grid.cell[axis] = fits ? size / nearest : side;
    }
    return grid;
}

// Near x less than nothing is filled: a whole part looks inwards, or one goes through itself.
[[noreturn]] void failInsideOut(std::span<const dvec3> positions, std::span<const Triangle> triangles, const dvec3& x,
                                double side) {
    const std::vector<int> parts = partsOf(triangles, positions.size());
    std::vector<double> volumes(positions.size(), 0.0);
    std::vector<Box> boxes(positions.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        volumes[parts[t]] += sixfoldVolume(positions, triangles[t]);
        for (const int v : triangles[t]) boxes[parts[t]].add(at(positions, v));
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Box& box = boxes[parts[t]];
        if (volumes[parts[t]] < 0 && glm::all(glm::greaterThan(x + 0.5 * side, box.low)) &&
            glm::all(glm::lessThan(x - 0.5 * side, box.high)))
            throw MeshFault("the part of the mesh to which this face belongs is inside out; turn its faces over",
                            static_cast<int>(t));
    }
    throw MeshFault(fmt::format("the mesh crosses itself, so that a part of it near [{:.3g}, {:.3g}, {:.3g}] is inside "
                                "out; separate the crossing parts",
                                x.x, x.y, x.z),
                    -1);
}

}  // namespace

double LatticeCell::share() const {
    return sumOf(shares);
}

int Lattice::cellAt(ivec3 place) const {
    if (glm::any(glm::lessThan(place, ivec3(0))) || glm::any(glm::greaterThanEqual(place, counts))) return -1;
    const int carrier = carriers[indexOf(place)];
    return carrier >= 0 && cells[carrier].at == place ? carrier : -1;
}

const LatticeCell& Lattice::carrierOf(const dvec3& x) const {
    const ivec3 inside = glm::clamp(ivec3(glm::floor(x)), ivec3(0), counts - 1);
    if (const int carrier = carriers[indexOf(inside)]; carrier >= 0) return cells[carrier];
    // From cube to cube around it, of which the cells of each new one are no nearer than `radius` - 1. Of equally near
    // cells the first.
    std::pair nearest(std::numeric_limits<double>::infinity(), 0);
    for (int radius = 1; radius <= glm::max(counts.x, glm::max(counts.y, counts.z)); ++radius) {
        if (nearest.first < static_cast<double>(radius - 1) * static_cast<double>(radius - 1)) break;
        const ivec3 low = glm::max(inside - radius, ivec3(0)), high = glm::min(inside + radius, counts - 1);
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int i = low.x; i <= high.x; ++i) {
                    const ivec3 place(i, y, z), off = glm::abs(place - inside);
                    const int own = std::max({off.x, off.y, off.z}) == radius ? cellAt(place) : -1;
                    const dvec3 way = x - glm::clamp(x, dvec3(place), dvec3(place + 1));
                    if (own >= 0) nearest = std::min(nearest, {glm::dot(way, way), own});
                }
    }
    return cells[nearest.second];
}

CarriedPoint carriedBy(const LatticeCell& cell, const dvec3& x) {
    CarriedPoint carried{cell.points, {}};
    const dvec3 share = x - dvec3(cell.at);
    for (std::size_t c = 0; c < 8; ++c) {
        const dvec3 weights = glm::mix(1.0 - share, share, dvec3(bitsOf(c)));
        carried.weights[c] = weights.x * weights.y * weights.z;
    }
    return carried;
}

Lattice fullLattice(ivec3 counts, const dvec3& size) {
    Lattice lattice;
    lattice.counts = counts;
    lattice.cell = size / dvec3(counts);
    for (int z = 0; z < counts.z; ++z)
        for (int y = 0; y < counts.y; ++y)
            for (int x = 0; x < counts.x; ++x) {
                lattice.carriers.push_back(static_cast<int>(lattice.cells.size()));
                lattice.cells.push_back({{x, y, z}, {}, {}});
                lattice.cells.back().shares.fill(0.125);
            }
    numberPoints(lattice);
    return lattice;
}

dvec3 boxCells(std::span<const dvec3> positions, double side) {
    return gridOf(boxOf(positions), side).counts;
}

Lattice meshLattice(std::span<const dvec3> positions, std::span<const Triangle> triangles, double side) {
    expectClosed(positions, triangles);
    const Box box = boxOf(positions);
    Lattice lattice;
    const Grid grid = gridOf(box, side);
    lattice.counts = ivec3(grid.counts);
    lattice.cell = grid.cell;
    lattice.centre = 0.5 * (box.low + box.high);
    Filler filler(lattice.counts);
    for (const Triangle& t : triangles) {
        Polygon corners;
        for (const int v : t)
            corners.push_back((at(positions, v) - lattice.centre) / lattice.cell + 0.5 * dvec3(lattice.counts));
        cutIntoCells(std::move(corners), 0, [&](const Polygon& piece) { filler.add(piece); });
    }
    std::vector<std::array<double, 8>> shares = filler.take();
    Choice choice(lattice, shares);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const double share = sumOf(shares[i]);
        if (share < -leastFilled)
            failInsideOut(
                positions, triangles,
                lattice.centre + lattice.cell * (dvec3(choice.placeOf(i)) + 0.5 - 0.5 * dvec3(lattice.counts)), side);
        if (share <= 1.0 + fullEnough) continue;
        lattice.isFilledTwice = true;
        for (double& s : shares[i]) s /= share;
    }
    choice.leaveOutSmall();
    lattice.carriers.assign(shares.size(), -1);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        if (!choice.stays(i)) continue;
        tidy(shares[i]);
        lattice.carriers[i] = static_cast<int>(lattice.cells.size());
        lattice.cells.push_back({choice.placeOf(i), shares[i], {}});
    }
    for (std::size_t i = 0; i < shares.size(); ++i)
        if (const int carrier = choice.carrier(i); carrier >= 0) lattice.carriers[i] = lattice.carriers[carrier];
    if (lattice.cells.empty()) throw MeshFault("the mesh fills next to nothing of its cells", -1);
    numberPoints(lattice);
    return lattice;
}

}  // namespace taut::mechanics
