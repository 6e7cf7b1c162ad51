#include "taut/advice/mesh_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "taut/bodies/block.h"
#include "taut/contact/bvh.h"
#include "taut/contact/crossings.h"
#include "taut/core/aabb.h"
#include "taut/spec/spec.h"

namespace taut::world {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

// How thick a mesh is under its faces, as far as that is less than a length.
class Thickness {
  public:
    Thickness(const std::vector<dvec3>& x, const Triangles& triangles, double most)
        : x_(x), triangles_(triangles), most_(most) {
        dvec3 high = x.front();
        low_ = high;
        for (const dvec3& p : x) {
            low_ = glm::min(low_, p);
            high = glm::max(high, p);
        }
        counts_ = ivec3(glm::floor((high - low_) / most)) + 1;
        bins_.resize(static_cast<std::size_t>(counts_.x) * static_cast<std::size_t>(counts_.y) *
                     static_cast<std::size_t>(counts_.z));
        for (std::size_t t = 0; t < triangles.size(); ++t)
            eachBin(glm::min(glm::min(at(t, 0), at(t, 1)), at(t, 2)), glm::max(glm::max(at(t, 0), at(t, 1)), at(t, 2)),
                    [&](std::size_t bin) { bins_[bin].push_back(t); });
    }

    // ½ of this is the area, along the normal.
    dvec3 doubleArea(std::size_t t) const { return glm::cross(at(t, 1) - at(t, 0), at(t, 2) - at(t, 0)); }

    // [m] From the middle of a face inwards to the next face that looks away; no less than `most` if there is none
    // nearer.
    double under(std::size_t face) const {
        const dvec3 from = (at(face, 0) + at(face, 1) + at(face, 2)) / 3.0, way = -glm::normalize(doubleArea(face));
        double least = most_;
        eachBin(glm::min(from, from + most_ * way), glm::max(from, from + most_ * way), [&](std::size_t bin) {
            for (const std::size_t t : bins_[bin])
                if (t != face) least = std::min(least, alongTo(t, from, way));
        });
        return least;
    }

  private:
    const dvec3& at(std::size_t t, std::size_t k) const { return x_[triangles_[t][k]]; }

    template <class Visit>
    void eachBin(const dvec3& from, const dvec3& to, const Visit& visit) const {
        const ivec3 a = glm::clamp(ivec3(glm::floor((from - low_) / most_)), ivec3(0), counts_ - 1),
                    b = glm::clamp(ivec3(glm::floor((to - low_) / most_)), ivec3(0), counts_ - 1);
        for (int z = a.z; z <= b.z; ++z)
            for (int y = a.y; y <= b.y; ++y)
                for (int i = a.x; i <= b.x; ++i) visit(mechanics::indexIn(counts_, {i, y, z}));
    }

    double alongTo(std::size_t t, const dvec3& from, const dvec3& way) const {
        const dvec3 normal = doubleArea(t);
        const double steep = glm::dot(normal, way);
        if (!(steep > 0.0)) return most_;
        const double along = glm::dot(normal, at(t, 0) - from) / steep;
        if (!(along > 0.0)) return most_;
        const dvec3 foot = from + along * way;
        for (std::size_t k = 0; k < 3; ++k)
            if (glm::dot(normal, glm::cross(at(t, (k + 1) % 3) - at(t, k), foot - at(t, k))) < 0.0) return most_;
        return along;
    }

    const std::vector<dvec3>& x_;
    const Triangles& triangles_;
    double most_;
    dvec3 low_;
    ivec3 counts_;
    std::vector<std::vector<std::size_t>> bins_;  // triangles that may reach into a cube of that side
};

// Two digits, no more than the value.
double roundedDown(double value) {
    const double digit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
    return digit * std::floor(value / digit);
}

void addThin(const BlockSpec& block, const std::vector<dvec3>& x, double volume, std::vector<core::Finding>& doubts) {
    // Parts thinner than a twentieth of a cell are two faces that lie on each other.
    constexpr double worthSaying = 0.02, leastThick = 0.05, mostFaces = 1e4;
    const Triangles& triangles = block.meshData->triangles;
    core::Aabb box;
    for (const dvec3& p : x) box.add(p);
    const dvec3 size = box.high - box.low;
    const double longest = glm::max(size.x, glm::max(size.y, size.z)), reach = std::min(block.cell, 1.01 * longest);
    const Thickness thickness(x, triangles, reach);
    const auto step = static_cast<std::size_t>(std::ceil(static_cast<double>(triangles.size()) / mostFaces));
    std::vector<std::pair<double, double>> thin;  // [m] and [m²]
    double area = 0.0, thinArea = 0.0;
    for (std::size_t t = 0; t < triangles.size(); t += step) {
        const double own = 0.5 * glm::length(thickness.doubleArea(t));
        if (!(own > 0.0)) continue;
        area += own;
        if (const double under = thickness.under(t); leastThick * reach < under && under < 0.999 * reach) {
            thin.emplace_back(under, own);
            thinArea += own;
        }
    }
    if (thinArea < worthSaying * area) return;
    std::sort(thin.begin(), thin.end());
    // No larger than a third of the whole, for which one cell is too coarse however thick it is.
    double thinner = 0.0, enough = block.cell;
    for (const auto& [under, own] : thin)
        if ((thinner += own) >= worthSaying * area) {
            enough = roundedDown(std::min(under, longest / 3));
            break;
        }
    doubts.push_back(warningAt({}) + fmt::format("{}: {:.0f} % of the surface of {} is of parts thinner than a cell, "
                                                 "which bend far too stiffly: cells_m = {:g} would do, about "
                                                 "{:.0f} cells",
                                                 block.fullName(), 100.0 * thinArea / area, block.mesh, enough,
                                                 roundedDown(volume / (enough * enough * enough))));
}

void addCrossings(const BlockSpec& block, const std::vector<dvec3>& x, bool isFilledTwice,
                  std::vector<core::Finding>& doubts) {
    contact::ContactSurface surface;
    surface.points.resize(x.size());
    std::iota(surface.points.begin(), surface.points.end(), 0);
    surface.triangles = block.meshData->triangles;
    const contact::Elements elements({surface}, x);
    contact::Bvh leaves(elements);
    const std::vector<contact::Crossing> crossings = contact::findCrossings(elements, leaves, x);
    if (crossings.empty() && !isFilledTwice) return;
    const std::vector<int>& lines = block.meshData->lines;
    const auto face = crossings.empty() ? lines.size() : static_cast<std::size_t>(crossings.front().triangle);
    doubts.push_back(warningAt({}) +
                     fmt::format("{}: {}{} {}; parts that are filled twice count once", block.fullName(), block.mesh,
                                 face < lines.size() ? fmt::format(":{}", lines[face]) : "",
                                 crossings.empty() ? "has parts that lie in each other"
                                                   : fmt::format("crosses itself: {} edges go through faces, the first "
                                                                 "through this one",
                                                                 crossings.size())));
}

}  // namespace

std::vector<core::Finding> meshCellDoubts(const SceneSpec& scene) {
    std::vector<core::Finding> doubts;
    for (const BlockSpec& block : scene.bodies.of<BlockSpec>()) {
        if (block.meshData == nullptr) continue;
        const std::shared_ptr<const mechanics::Lattice> lattice = block.lattice();
        std::vector<dvec3> x;
        for (const dvec3& place : block.meshData->positions) x.push_back(block.scale * place);
        double volume = 0.0;
        for (const mechanics::LatticeCell& cell : lattice->cells)
            volume += cell.share() * lattice->cell.x * lattice->cell.y * lattice->cell.z;
        addThin(block, x, volume, doubts);
        addCrossings(block, x, lattice->isFilledTwice, doubts);
    }
    return doubts;
}

}  // namespace taut::world
