#include <algorithm>
#include <cmath>
#include <utility>

#include "taut/core/error.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/builder_support.h"

namespace taut::mechanics {
namespace {

using glm::dvec2;
using glm::dvec3;
using Edge = std::pair<int, int>;  // the lower index first

struct EdgeUse {
    int uses = 0;       // triangles at the edge
    int forward = 0;    // how many of them run from the lower to the higher index
    int opposite[2]{};  // the third corners
    double area = 0.0;  // [m²] sum of the two triangles
};

[[noreturn]] void reject(const std::string& what, std::size_t triangle) {
    throw MeshFault(what, static_cast<int>(triangle));
}
[[noreturn]] void reject(const std::string& what) {
    throw MeshFault(what, -1);
}

std::string numberOf(const MeshClothShape& shape, int vertex) {
    return std::to_string(shape.numbers.empty() ? vertex + 1 : shape.numbers[vertex]);
}

std::string nameOf(const MeshClothShape& shape, const Edge& edge) {
    return "the edge between vertices " + numberOf(shape, edge.first) + " and " + numberOf(shape, edge.second);
}

const dvec3& position(const MeshClothShape& shape, int i) {
    return shape.positions[i];
}

void checkIndices(const MeshClothShape& shape) {
    if (shape.triangles.empty()) reject("there are no faces");
    const int count = static_cast<int>(shape.positions.size());
    if (!shape.uv.empty() && shape.uv.size() != shape.positions.size())
        reject("some of the vertices only have texture coordinates");
    for (int v = 0; v < count; ++v)
        for (int axis = 0; axis < 3; ++axis)
            if (!std::isfinite(position(shape, v)[axis])) reject("vertex " + numberOf(shape, v) + " is not finite");
    std::vector<bool> isUsed(shape.positions.size(), false);
    for (std::size_t t = 0; t < shape.triangles.size(); ++t)
        for (int i : shape.triangles[t]) {
            if (i < 0 || i >= count)
                reject("there is no vertex " + std::to_string(i + 1) + " of " + std::to_string(count), t);
            isUsed[i] = true;
        }
    const auto unused = std::find(isUsed.begin(), isUsed.end(), false);
    if (unused != isUsed.end())
        reject("vertex " + numberOf(shape, static_cast<int>(unused - isUsed.begin())) + " belongs to no face");
}

// Areas [m²]. An area counts as zero if the triangle's height is below a millionth of its longest side.
std::vector<double> areasOf(const MeshClothShape& shape) {
    std::vector<double> areas;
    for (const auto& [a, b, c] : shape.triangles) {
        const dvec3 e1 = position(shape, b) - position(shape, a), e2 = position(shape, c) - position(shape, a);
        const double longest = std::max({glm::dot(e1, e1), glm::dot(e2, e2), glm::dot(e2 - e1, e2 - e1)});
        const double area = 0.5 * glm::length(glm::cross(e1, e2));
        if (!(area > 0.5e-6 * longest))
            reject("vertices " + numberOf(shape, a) + ", " + numberOf(shape, b) + " and " + numberOf(shape, c) +
                       " of this face lie on a line: merge by distance, or triangulate it",
                   areas.size());
        areas.push_back(area);
    }
    return areas;
}

std::map<Edge, EdgeUse> edgesOf(const MeshClothShape& shape, const std::vector<double>& areas) {
    std::map<Edge, EdgeUse> edges;
    for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
        const auto& corners = shape.triangles[t];
        for (std::size_t side = 0; side < 3; ++side) {
            const int from = corners[side], to = corners[(side + 1) % 3];
            const Edge edge = std::minmax(from, to);
            EdgeUse& use = edges[edge];
            if (use.uses == 2)
                reject("this face is the third at " + nameOf(shape, edge) +
                           ", which takes two: delete faces that lie double or inside",
                       t);
            use.opposite[use.uses++] = corners[(side + 2) % 3];
            use.area += areas[t];
            if (from < to) ++use.forward;
            if (use.uses < 2 || use.forward == 1) continue;
            if (use.opposite[0] == use.opposite[1]) reject("this face is there twice: delete one", t);
            reject("this face and the other at " + nameOf(shape, edge) + " face opposite ways: recalculate normals", t);
        }
    }
    return edges;
}

// [m] Flat coordinates along the two longest extents. Of equal extents it takes the earlier axis.
std::vector<dvec2> projectedUv(const MeshClothShape& shape, const dvec3& low, const dvec3& high) {
    const dvec3 size = high - low;
    int order[3] = {0, 1, 2};
    std::stable_sort(order, order + 3, [&](int a, int b) { return size[a] > size[b]; });
    std::vector<dvec2> uv;
    for (const dvec3& p : shape.positions) uv.emplace_back(p[order[0]] - low[order[0]], p[order[1]] - low[order[1]]);
    return uv;
}

void addGroups(Model& model, const std::map<Edge, EdgeUse>& edges, const dvec3& low, const dvec3& high) {
    std::vector<int> boundary;
    for (const auto& [edge, use] : edges)
        if (use.uses == 1) boundary.insert(boundary.end(), {edge.first, edge.second});
    std::sort(boundary.begin(), boundary.end());
    boundary.erase(std::unique(boundary.begin(), boundary.end()), boundary.end());
    model.groups["boundary"] = boundary;
    // Sides: points within a hundredth of the extent.
    const dvec3 near = 0.01 * (high - low);
    for (int i = 0; i < model.pointCount(); ++i) {
        const dvec3& p = model.positions[i];
        if (p.x <= low.x + near.x) model.groups["left"].push_back(i);
        if (p.x >= high.x - near.x) model.groups["right"].push_back(i);
        if (p.y <= low.y + near.y) model.groups["bottom"].push_back(i);
        if (p.y >= high.y - near.y) model.groups["top"].push_back(i);
    }
    // Corners: the furthest point in each diagonal direction.
    const auto corner = [&](const char* name, double x, double y) {
        const auto reach = [&](int i) {
            const dvec3& p = model.positions[i];
            return x * (p.x - low.x) * (high.y - low.y) + y * (p.y - low.y) * (high.x - low.x);
        };
        int furthest = 0;
        for (int i = 1; i < model.pointCount(); ++i)
            if (reach(i) > reach(furthest)) furthest = i;
        model.groups[name] = {furthest};
    };
    corner("top-left", -1.0, 1.0);
    corner("top-right", 1.0, 1.0);
    corner("bottom-left", -1.0, -1.0);
    corner("bottom-right", 1.0, -1.0);
}

void addSprings(Model& model, const std::map<Edge, EdgeUse>& edges, const ClothMaterial& material) {
    auto distance = [&](int a, int b) { return glm::length(model.positions[b] - model.positions[a]); };
    // Van Gelder (1998): k = E₂D (A1 + A2)/c². A square cloth has k_s = ¾ E₂D. An edge at φ to the warp takes the
    // stiffness of an orthotropic sheet along it, without the share of its cross contraction; half the stretch as shear
    // gives the same for every φ.
    const double weft = material.weftStretch.value_or(material.stretch);
    const auto youngAlong = [&](const Edge& edge) {
        const dvec2 e = model.uv[edge.second] - model.uv[edge.first];
        const double length2 = glm::dot(e, e);
        if (!(length2 > 0.0)) return material.stretch * 4.0 / 3.0;
        const double cc = e.x * e.x / length2, ss = e.y * e.y / length2;
        return (material.stretch * cc * cc + weft * ss * ss + 4.0 * material.shear * cc * ss) * 4.0 / 3.0;
    };
    for (const auto& [edge, use] : edges) {
        const double c = distance(edge.first, edge.second);
        const double young = youngAlong(edge);
        model.springs.push_back(
            {edge.first, edge.second, young * use.area / (c * c), c, material.dampingTime, SpringKind::structural});
    }
    if (material.bend == 0.0) return;
    // A bend spring across each inner edge, unless the mesh is so tight that both corners are one or share an edge.
    for (const auto& [edge, use] : edges) {
        if (use.uses != 2 || use.opposite[0] == use.opposite[1]) continue;
        const Edge across = std::minmax(use.opposite[0], use.opposite[1]);
        const double restLength = distance(across.first, across.second);
        if (edges.contains(across) || restLength == 0.0) continue;
        model.springs.push_back(
            {across.first, across.second, material.bend, restLength, material.dampingTime, SpringKind::bend});
    }
}

// The direction in which u grows and v stays; of a sheet that is alike all ways that of the first side.
dvec3 warpOf(const MeshClothShape& shape, std::size_t t, bool isIsotropic) {
    const auto& [a, b, c] = shape.triangles[t];
    const dvec3 e1 = position(shape, b) - position(shape, a), e2 = position(shape, c) - position(shape, a);
    if (isIsotropic) return glm::normalize(e1);
    const auto& uv = shape.cornerUv[t];
    const dvec2 d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
    const double area = d1.x * d2.y - d1.y * d2.x;
    if (!(std::abs(area) > 1e-6 * std::max(glm::dot(d1, d1), glm::dot(d2, d2))))
        reject("the texture coordinates of this face lie on a line, so that its warp has no direction: unwrap it", t);
    return glm::normalize((d2.y * e1 - d1.y * e2) / area);
}

void addBending(Model& model, const MeshClothShape& shape) {
    const BendingRigidity& of = shape.material.rigidity;
    if (!(of.along > 0.0) && !(of.across > 0.0)) return;
    const double mean = std::sqrt(of.along * of.across);
    const bool isIsotropic =
        shape.cornerUv.empty() || (of.along == of.across && of.both == 0.0 && of.twist == 2.0 * of.along);
    model.freeform.rigidity = isIsotropic ? BendingRigidity{mean, mean, 0.0, 2.0 * mean} : of;
    model.freeform.rest = model.positions;
    for (std::size_t t = 0; t < shape.triangles.size(); ++t)
        model.freeform.warp.push_back(warpOf(shape, t, isIsotropic));
    model.freeform.dampingTime = shape.material.dampingTime;
}

}  // namespace

Model buildMeshCloth(const MeshClothShape& shape) {
    checkIndices(shape);
    const std::vector<double> areas = areasOf(shape);
    const std::map<Edge, EdgeUse> edges = edgesOf(shape, areas);

    Model model;
    detail::addRestingPoints(model, static_cast<int>(shape.positions.size()), shape.material.dragRate);
    model.triangles = shape.triangles;
    dvec3 low = shape.positions.front(), high = low;
    for (std::size_t i = 0; i < shape.positions.size(); ++i) {
        model.positions[i] = detail::withoutNegativeZero(shape.positions[i]);
        low = glm::min(low, shape.positions[i]);
        high = glm::max(high, shape.positions[i]);
    }
    model.uv = shape.uv.empty() ? projectedUv(shape, low, high) : shape.uv;

    // Each corner carries a third of the mass of its triangles.
    double total = 0.0;
    for (std::size_t t = 0; t < areas.size(); ++t) {
        total += areas[t];
        for (int i : shape.triangles[t]) model.masses[i] += shape.material.density * areas[t] / 3.0;
    }
    if (shape.material.lumping == Lumping::uniform)
        model.masses.assign(model.masses.size(), shape.material.density * total / model.pointCount());

    addSprings(model, edges, shape.material);
    addBending(model, shape);
    addGroups(model, edges, low, high);
    for (const auto& group : shape.groups) model.groups.insert(group);
    return model;
}

std::vector<std::string> meshClothGroups() {
    return {"boundary", "top", "bottom", "left", "right", "top-left", "top-right", "bottom-left", "bottom-right"};
}

}  // namespace taut::mechanics
