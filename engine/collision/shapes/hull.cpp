// The convex hull of a set of points. Bullet finds the hull and, near edges and corners, the distance by GJK.
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <LinearMath/btConvexHullComputer.h>

#include <span>
#include <string>
#include <vector>

#include "taut/collision/convex_form.h"
#include "taut/collision/shape_table.h"
#include "taut/collision/shapes/shape_parts.h"

namespace taut::collision {

namespace {

constexpr float hullCrease = 0.7F;  // [rad] edges sharper than this look sharp

class Hull final : public Form {
  public:
    // Throws core::Error(badContent) for fewer than four vertices or a hull without volume.
    explicit Hull(std::span<const dvec3> vertices);
    // Exact inside and above a face as far as the faces are: each is moved out until no vertex lies before it, and
    // Bullet rounds the vertices to about 1/10000 of the size to decide what is a face.
    Nearest nearest(const dvec3& p) const override;
    bool sweep(const Path& path, Touch& touch, bool& crossed) const override;
    std::optional<Box> bounds() const override { return bounds_; }
    bool isConvex() const override { return true; }

    // The highest of the faces' planes over p: never more than the distance. Costs a fraction of `nearest`.
    Nearest highestFace(const dvec3& p) const;

  private:
    bool isUnderEveryFace(const dvec3& p, double by) const;
    void addFace(const dvec3& normal, std::span<const dvec3> vertices);

    btConvexHullShape shape_;
    std::vector<double> normalX_, normalY_, normalZ_, offset_;  // (faces) normal · p - offset is the height [-, m]
    Box bounds_;
};

Hull::Hull(std::span<const dvec3> vertices) {
    if (vertices.size() < 4) failShape("hull: needs at least four vertices, has " + std::to_string(vertices.size()));
    for (const dvec3& v : vertices) {
        if (!isFinite(v)) failShape("hull: a vertex is not finite");
        bounds_.add(v);
    }
    const dvec3 size = bounds_.high - bounds_.low;
    const double longest = glm::max(size.x, glm::max(size.y, size.z));

    btConvexHullComputer computer;
    computer.compute(&vertices[0].x, static_cast<int>(sizeof(dvec3)), static_cast<int>(vertices.size()), 0.0, 0.0);
    for (int f = 0; f < computer.faces.size(); ++f) {
        // Newell's normal of the polygon: half the sum of the cross products, whatever its number of corners.
        const btConvexHullComputer::Edge* const first = &computer.edges[computer.faces[f]];
        const auto corner = [&](const btConvexHullComputer::Edge* edge) {
            const int vertex = computer.original_vertex_index[edge->getSourceVertex()];
            return vertices[static_cast<std::size_t>(vertex)];
        };
        const dvec3 origin = corner(first);
        dvec3 sum(0.0);
        for (const auto* edge = first->getNextEdgeOfFace(); edge != first; edge = edge->getNextEdgeOfFace())
            sum += glm::cross(corner(edge) - origin, corner(edge->getNextEdgeOfFace()) - origin);
        const double length = std::sqrt(glm::dot(sum, sum));
        if (length > 1e-14 * longest * longest) addFace(sum / length, vertices);
    }
    dvec3 mean(0.0);
    for (const dvec3& v : vertices) mean += v;
    mean /= static_cast<double>(vertices.size());
    const double depth = offset_.size() < 4 ? 0.0 : -highestFace(mean).distance;
    if (!(depth > 1e-9 * longest)) failShape("hull: its vertices lie in one plane, so it has no volume");

    for (int i = 0; i < computer.vertices.size(); ++i) {
        const dvec3& v = vertices[static_cast<std::size_t>(computer.original_vertex_index[i])];
        shape_.addPoint(btVector3(v.x, v.y, v.z), false);
    }
    shape_.recalcLocalAabb();
    shape_.setMargin(0.0);  // the surface is where the vertices say
}

void Hull::addFace(const dvec3& normal, std::span<const dvec3> vertices) {
    double offset = glm::dot(normal, vertices[0]);
    for (const dvec3& v : vertices) {
        const double height = glm::dot(normal, v);
        if (height > offset) offset = height;
    }
    const double tolerance = 1e-12 * (glm::length(bounds_.low) + glm::length(bounds_.high));
    for (std::size_t i = 0; i < offset_.size(); ++i) {  // a face that was cut into several counts once
        const dvec3 other(normalX_[i], normalY_[i], normalZ_[i]);
        const dvec3 difference = normal - other;
        if (glm::dot(difference, difference) < 1e-24 && std::abs(offset - offset_[i]) <= tolerance) return;
    }
    normalX_.push_back(normal.x);
    normalY_.push_back(normal.y);
    normalZ_.push_back(normal.z);
    offset_.push_back(offset);
}

Nearest Hull::highestFace(const dvec3& p) const {
    double highest = normalX_[0] * p.x + normalY_[0] * p.y + normalZ_[0] * p.z - offset_[0];
    std::size_t face = 0;
    for (std::size_t i = 1; i < offset_.size(); ++i) {
        const double height = normalX_[i] * p.x + normalY_[i] * p.y + normalZ_[i] * p.z - offset_[i];
        if (height > highest) {
            highest = height;
            face = i;
        }
    }
    return {highest, {normalX_[face], normalY_[face], normalZ_[face]}};
}

bool Hull::isUnderEveryFace(const dvec3& p, double by) const {
    for (std::size_t i = 0; i < offset_.size(); ++i)
        if (normalX_[i] * p.x + normalY_[i] * p.y + normalZ_[i] * p.z - offset_[i] > by) return false;
    return true;
}

Nearest Hull::nearest(const dvec3& p) const {
    const Nearest face = highestFace(p);
    if (!(face.distance > 0.0)) return face;
    if (isUnderEveryFace(p - face.distance * face.normal, 1e-12)) return face;  // its foot lies in the face

    btGjkEpaSolver2::sResults found;
    const btTransform here(btMatrix3x3::getIdentity(), btVector3(0.0, 0.0, 0.0));
    const double gap = btGjkEpaSolver2::SignedDistance(btVector3(p.x, p.y, p.z), 0.0, &shape_, here, found);
    if (!(gap > 0.0 && gap < SIMD_INFINITY)) return face;  // so near that it fails or finds none
    const btVector3& q = found.witnesses[0];
    const dvec3 apart = p - dvec3(q.x(), q.y(), q.z());
    const double distance = std::sqrt(glm::dot(apart, apart));
    if (!(distance >= face.distance)) return face;  // it failed: the face's plane is a lower bound
    return {distance, apart * (1.0 / distance)};
}

bool Hull::sweep(const Path& path, Touch& touch, bool&) const {
    const Nearest over = highestFace(path.to);
    if (over.distance >= path.thickness + path.skin) {
        const double startHeight = over.distance - glm::dot(over.normal, path.to - path.from);
        if (startHeight >= path.thickness) return false;
    }
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
