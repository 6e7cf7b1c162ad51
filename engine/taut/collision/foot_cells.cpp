// The cells of a foot finder: how far the surface is from their middles, and which triangles can be nearest if the
// cell is near the surface.
#include <algorithm>

#include "taut/collision/private/foot_finder.h"
#include "taut/core/private/parallel.h"

namespace taut::collision {

namespace {

constexpr int deepest = 5;                // how often a cell may be halved
constexpr std::size_t fewTriangles = 12;  // a list that is no longer is not divided

// The distance from the middle, rounded to the safe side.
float roundedDown(double a) {
    return static_cast<float>(a * (1.0 - 1e-6));
}

}  // namespace

// The cells of the layer come first, row by row, then parts.
struct FootFinder::Slab {
    std::vector<Cell> cells;
    std::vector<int> lists;
};

FootFinder::FootFinder(Facets facets) : facets_(std::move(facets)) {
    std::vector<dvec3> corners;
    corners.reserve(3 * facets_.triangles.size());
    for (const Facet& t : facets_.triangles)
        corners.insert(corners.end(), {t.corner, t.corner + t.ab, t.corner + t.ac});
    for (const dvec3& corner : corners) bounds_.add(corner);
    tree_ = MeshTree(corners);
    makePrisms();
    widenPrisms();
    measureCells();
}

void FootFinder::makePrisms() {
    const dvec3 centre = bounds_.centre();
    prisms_.reserve(facets_.triangles.size());
    for (const Facet& t : facets_.triangles) {
        Prism& prism = prisms_.emplace_back();
        const auto set = [&](int lane, const dvec3& normal, const dvec3& on) {
            prism.x[lane] = static_cast<float>(normal.x);
            prism.y[lane] = static_cast<float>(normal.y);
            prism.z[lane] = static_cast<float>(normal.z);
            prism.offset[lane] = static_cast<float>(glm::dot(normal, on - centre));
        };
        const dvec3 bc = t.ac - t.ab;
        const auto outward = [&](const dvec3& along) {
            return glm::cross(along, t.normal) / std::sqrt(glm::dot(along, along));
        };
        set(0, t.normal, t.corner);
        set(1, outward(t.ab), t.corner);
        set(2, outward(bc), t.corner + t.ab);
        set(3, outward(-t.ac), t.corner);
    }
}

// If the foot of a place lies within a triangle, the place is in the prism over it. If the foot lies on an edge or at a
// corner, the direction from the foot to the place lies between the normals of the triangles that meet there. (Take the
// surface near the foot as a function over one of these triangles, and a plane through the foot that touches it. The
// plane's slope is a mean of the facets' slopes.) So at height h the place is beyond the prism's sides by no more than
// h times the tangent of the largest angle between those normals and the triangle's own. At a border there is none.
void FootFinder::widenPrisms() {
    const std::vector<Facet>& triangles = facets_.triangles;
    const std::vector<std::uint32_t>& corners = facets_.corners;
    std::vector<std::size_t> firstAt(facets_.isBorder.size() + 1, 0);  // (vertices + 1)
    for (const std::uint32_t corner : corners) ++firstAt[corner + 1];
    for (std::size_t i = 1; i < firstAt.size(); ++i) firstAt[i] += firstAt[i - 1];
    std::vector<std::size_t> around(corners.size());
    std::vector<std::size_t> next(firstAt.begin(), firstAt.end() - 1);
    for (std::size_t i = 0; i < corners.size(); ++i) around[next[corners[i]]++] = i / 3;

    flares_.resize(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        double least = 1.0;  // cosine of the angle
        for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
            if (facets_.isBorder[corners[k]]) least = 0.0;
            for (std::size_t at = firstAt[corners[k]]; at < firstAt[corners[k] + 1]; ++at)
                least = std::min(least, glm::dot(triangles[i].normal, triangles[around[at]].normal));
        }
        const double tangent = least > 0.1 ? std::sqrt(std::max(0.0, 1.0 - least * least)) / least + 1e-5 : 0.0;
        flares_[i] = least > 0.1 ? static_cast<float>(tangent) : std::numeric_limits<float>::infinity();
    }
}

// Whether the widened prism reaches into the cell.
bool FootFinder::mayBeNearest(const dvec3& middle, double half, int triangle) const {
    const auto i = static_cast<std::size_t>(triangle);
    if (!(flares_[i] < std::numeric_limits<float>::infinity())) return true;
    const Prism& prism = prisms_[i];
    const dvec3 fromCentre = middle - bounds_.centre();
    const Four heights = prism.x * static_cast<float>(fromCentre.x) + prism.y * static_cast<float>(fromCentre.y) +
                         prism.z * static_cast<float>(fromCentre.z) - prism.offset;
    const auto size = [](const Four& a) { return a < 0.0F ? -a : a; };
    const Four change = static_cast<float>(half) * (size(prism.x) + size(prism.y) + size(prism.z));
    const float height = std::abs(heights[0]) + change[0];
    const float beyond = flares_[i] * height + static_cast<float>(rounding_) * (1.0F + flares_[i]);
    return heights[1] - change[1] <= beyond && heights[2] - change[2] <= beyond && heights[3] - change[3] <= beyond;
}

void FootFinder::measureCells() {
    const dvec3 size = bounds_.high - bounds_.low;
    const double longest = std::max({size.x, size.y, size.z});
    const int along =
        std::clamp(static_cast<int>(std::sqrt(static_cast<double>(facets_.triangles.size())) / 12.0), 16, 96);
    cellSize_ = longest / along;
    cellsPerMetre_ = 1.0 / cellSize_;
    for (int k = 0; k < 3; ++k)  // one more on each side
        cellCount_[k] = std::clamp(static_cast<int>(size[k] / cellSize_) + 1, 1, along) + 2;
    cellsFrom_ = bounds_.centre() - 0.5 * cellSize_ * dvec3(cellCount_);
    rounding_ = 2e-6 * (0.5 * std::sqrt(glm::dot(size, size)) + 2.0 * cellSize_);

    // Measure the layers in parallel.
    std::vector<Slab> slabs(cellCount_.z);
    core::parallelFor(cellCount_.z, [&](int z) { measureSlab(z, slabs[z]); });

    // Join them in order: all layers first, then all parts. The starts of lists and parts move accordingly.
    const auto layer = static_cast<std::size_t>(cellCount_.x * cellCount_.y);
    cells_.resize(layer * slabs.size());
    for (std::size_t z = 0; z < slabs.size(); ++z) {
        Slab& slab = slabs[z];
        for (Cell& cell : slab.cells)
            if (cell.count >= 0)
                cell.first += static_cast<std::uint32_t>(lists_.size());
            else
                cell.first += static_cast<std::uint32_t>(cells_.size() - layer);
        const auto parts = slab.cells.begin() + static_cast<std::ptrdiff_t>(layer);
        std::copy(slab.cells.begin(), parts, cells_.begin() + static_cast<std::ptrdiff_t>(z * layer));
        cells_.insert(cells_.end(), parts, slab.cells.end());
        lists_.insert(lists_.end(), slab.lists.begin(), slab.lists.end());
        slab = {};
    }
}

void FootFinder::measureSlab(int z, Slab& slab) const {
    // Far away, a triangle that is up to a tenth further than the nearest is good enough.
    constexpr double loose = 1.1;
    const double halfDiagonal = 0.5 * std::sqrt(3.0) * cellSize_;

    struct Known {
        dvec3 middle;
        int triangle;
        bool inside;
    };
    std::vector<Known> known;  // of this row up to here, then of the row before
    std::vector<int> among;
    slab.cells.resize(cellCount_.x * cellCount_.y);
    for (int y = 0; y < cellCount_.y; ++y) {
        for (int x = 0; x < cellCount_.x; ++x) {
            const dvec3 middle = cellsFrom_ + (dvec3(x, y, z) + 0.5) * cellSize_;
            const auto index = static_cast<std::size_t>(y * cellCount_.x + x);
            Cell& cell = slab.cells[index];
            // Start the search from the nearest triangle of a neighbour.
            const Known* const neighbour = x > 0 ? &known[x - 1] : (y > 0 ? &known[0] : nullptr);
            Foot foot;
            if (neighbour != nullptr) {
                update(middle, neighbour->triangle, foot);
                footInTree(middle, loose * loose, foot);
            }
            double least = neighbour != nullptr ? std::sqrt(foot.square) / loose : 0.0;
            bool inside = neighbour != nullptr && neighbour->inside;
            if (!(least > 2.0 * cellSize_)) {
                footInTree(middle, 1.0, foot);
                least = std::sqrt(foot.square);
                inside = isInside(middle, foot);
            }
            cell.least = roundedDown(least);
            cell.isInside = inside;
            const Known here{middle, foot.triangle, inside};
            if (y == 0)
                known.push_back(here);
            else
                known[x] = here;

            // Near the surface: list the triangles that can be nearest.
            if (least > 2.0 * halfDiagonal) continue;
            const double reach = least + 2.0 * halfDiagonal + rounding_;
            core::Aabb box{middle, middle};
            box.grow(reach);
            among.clear();
            tree_.visit(box, [&](int triangle) { among.push_back(triangle); });
            fillCell(index, middle, 0.5 * cellSize_, 0, among, slab);
        }
    }
}

// `among` has every triangle that is nearest to some place of the cell.
void FootFinder::fillCell(std::size_t index, const dvec3& middle, double half, int depth, std::span<const int> among,
                          Slab& slab) const {
    std::vector<float> lowest(among.size() + 3);
    const Foot foot = footAmong(middle, among, lowest.data());
    const double distance = std::sqrt(foot.square);
    Cell cell;
    cell.least = roundedDown(distance);
    cell.isInside = isInside(middle, foot);

    // From the middle to any other place of the cell, the distance to a triangle changes by half the diagonal at most.
    // This holds for the nearest triangle and for all others.
    const double halfDiagonal = std::sqrt(3.0) * half;
    const double reach = (distance + 2.0 * halfDiagonal) * (1.0 + 1e-6) + rounding_;
    const auto limit = static_cast<float>(reach * reach);
    std::vector<int> list;
    for (std::size_t i = 0; i < among.size(); ++i)
        if (lowest[i] <= limit && mayBeNearest(middle, half, among[i])) list.push_back(among[i]);

    if (list.size() > fewTriangles && depth < deepest && distance <= halfDiagonal) {
        cell.first = static_cast<std::uint32_t>(slab.cells.size());
        cell.count = -1;
        slab.cells[index] = cell;
        slab.cells.resize(slab.cells.size() + 8);
        for (std::size_t part = 0; part < 8; ++part) {
            const dvec3 way((part & 1) != 0 ? 0.5 : -0.5, (part & 2) != 0 ? 0.5 : -0.5, (part & 4) != 0 ? 0.5 : -0.5);
            fillCell(cell.first + part, middle + half * way, 0.5 * half, depth + 1, list, slab);
        }
        return;
    }
    if (list.size() <= longestList) {
        cell.first = static_cast<std::uint32_t>(slab.lists.size());
        cell.count = static_cast<std::int32_t>(list.size());
        slab.lists.insert(slab.lists.end(), list.begin(), list.end());
    }
    slab.cells[index] = cell;
}

}  // namespace taut::collision
