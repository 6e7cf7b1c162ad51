// The convex hull of a set of points; the work is in convex_hull.h and foot_finder.h.
#include <string>

#include "taut/collision/private/convex_form.h"
#include "taut/collision/private/convex_hull.h"
#include "taut/collision/private/foot_finder.h"
#include "taut/collision/private/shapes/shape_parts.h"
#include "taut/collision/shape_table.h"

namespace taut::collision {

namespace {

constexpr float hullCrease = 0.7F;  // [rad] edges sharper than this look sharp

class Hull final : public Form {
  public:
    // Throws core::Error(badContent) for fewer than four vertices or a hull without volume.
    explicit Hull(std::span<const dvec3> vertices);
    Nearest nearest(const dvec3& p) const override;
    bool sweep(const Path& path, HalfSpace& touch, bool& crossed) const override;
    std::optional<core::Aabb> bounds() const override { return finder_.bounds(); }
    bool isConvex() const override { return true; }
    Outline outline() const override { return outlineOf(finder_.facets()); }

  private:
    FootFinder finder_;
    double tiny_ = 0.0;  // [m²] square of the rounding of a distance
};

Hull::Hull(std::span<const dvec3> vertices) {
    if (vertices.size() < 4) failShape("hull: needs at least four vertices, has " + std::to_string(vertices.size()));
    dvec3 mean(0.0);
    for (const dvec3& v : vertices) {
        if (!isFinite(v)) failShape("hull: a vertex is not finite");
        mean += v / static_cast<double>(vertices.size());
    }
    const auto failFlat = [] { failShape("hull: its vertices lie in one plane, so it has no volume"); };
    const std::vector<std::uint32_t> triangles = convexHull(vertices);
    if (triangles.empty()) failFlat();
    Facets facets = makeFacets(vertices, triangles);
    facets.isClosed = true;  // even if a triangle is too narrow to have a direction
    double depth = std::numeric_limits<double>::infinity();
    for (const Facet& t : facets.triangles) depth = std::min(depth, glm::dot(t.corner - mean, t.normal));
    finder_ = FootFinder(std::move(facets));
    const dvec3 size = finder_.bounds().high - finder_.bounds().low;
    const double longest = glm::max(size.x, glm::max(size.y, size.z));
    if (!(depth > 1e-9 * longest)) failFlat();
    tiny_ = 1e-24 * glm::dot(size, size);
}

Nearest Hull::nearest(const dvec3& p) const {
    const Foot foot = finder_.foot(p, finder_.place(p));
    if (foot.triangle < 0) return {std::numeric_limits<double>::infinity(), {0.0, 1.0, 0.0}};
    // Over a face the direction is the face's normal, which is exact no matter how near the point is. Inside, the
    // direction is always a face's normal.
    const Facet& t = finder_.triangle(foot.triangle);
    if (foot.square - foot.facing * foot.facing <= 1e-12 * foot.square + tiny_)
        return {glm::dot(p - t.corner, t.normal), t.normal};
    const double distance = std::sqrt(foot.square);
    return {distance, (p - foot.point) * (1.0 / distance)};
}

bool Hull::sweep(const Path& path, HalfSpace& touch, bool&) const {
    const FootFinder::Place end = finder_.place(path.to);
    const dvec3 way = path.to - path.from;
    const double least = end.least - path.thickness - path.skin;
    if (!end.inside && least > 0.0 && least * least > glm::dot(way, way)) return false;
    return sweepConvex(*this, path, touch);
}

view::Mesh meshOfHull(const ShapeSizes& sizes) {
    const std::vector<glm::vec3> positions(sizes.vertices.begin(), sizes.vertices.end());
    return view::creasedMesh(positions, sizes.triangles, hullCrease);
}

}  // namespace

ShapeKind hullKind() {
    return {.name = "hull",
            .fields = {"mesh", "scale"},
            .own = {},
            .isBounded = true,
            .form = [](const ShapeSizes& sizes) { return std::make_shared<const Hull>(sizes.vertices); },
            .mesh = meshOfHull};
}

}  // namespace taut::collision
