#include "taut/collision/private/triangle_mesh.h"

namespace taut::collision {

bool TriangleMesh::findWayOut(const Path& path, const Foot& end, HalfSpace& touch) const {
    const Nearest near = finder_.nearestFrom(path.to, end);
    if (near.distance >= path.thickness + path.skin) return false;
    touch = {near.normal, glm::dot(near.normal, path.to) - near.distance + path.thickness};
    return true;
}

// Whether the path comes from the triangle's front. A start in the plane itself counts as front.
bool TriangleMesh::isInFront(const Path& path, const Facet& t) {
    return glm::dot(path.from - t.corner, t.normal) > -path.skin;
}

// The triangle that the path crosses first; -1: none.
int TriangleMesh::firstCrossing(const Path& path) const {
    const dvec3 whole = path.to - path.from;
    core::Aabb box;
    box.add(path.from);
    box.add(path.to);
    box.grow(path.thickness + path.skin);
    double first = 2.0;      // fraction of the path
    double steepest = -1.0;  // [m] how much of the path runs along the crossed triangle's normal
    int crossing = -1;
    finder_.tree().visit(box, [&](int index) {
        const Facet& t = finder_.triangle(index);
        const double fromHeight = glm::dot(path.from - t.corner, t.normal);
        const double toHeight = glm::dot(path.to - t.corner, t.normal);
        const bool front = isInFront(path, t);
        if (front ? !(toHeight < 0.0 && toHeight < fromHeight) : !(toHeight > 0.0)) return;
        const double height = front == (fromHeight > 0.0) ? fromHeight : 0.0;
        const double at = height / (height - toHeight);
        const double steep = std::abs(fromHeight - toHeight);
        if (at > first + 1e-12 || (at >= first - 1e-12 && steep <= steepest)) return;
        // Barycentric coordinates, with edges that overlap a little so that none lets a path through.
        const dvec3 q = path.from + at * whole - t.corner;
        const double scale = 1.0 / glm::dot(glm::cross(t.ab, t.ac), t.normal);
        const double b = glm::dot(glm::cross(q, t.ac), t.normal) * scale;
        const double c = glm::dot(glm::cross(t.ab, q), t.normal) * scale;
        constexpr double slack = 1e-9;
        if (b < -slack || c < -slack || b + c > 1.0 + slack) return;
        first = at;
        steepest = steep;
        crossing = index;
    });
    return crossing;
}

// The touch at the end of a path that crosses nothing. False if the end is far enough.
bool TriangleMesh::touchNear(const Path& path, const Foot& end, HalfSpace& touch) const {
    const double reach = path.thickness + path.skin;
    if (!(end.square < reach * reach)) return false;
    // Over the middle of a triangle the direction is its normal, which is exact no matter how near the point is.
    const double distance = std::sqrt(end.square);
    const Facet& t = finder_.triangle(end.triangle);
    const dvec3 apart = path.to - end.point;
    dvec3 normal = apart * (1.0 / distance);
    if (!(distance > path.skin))
        normal = isInFront(path, t) ? t.normal : -t.normal;
    else if (end.square - end.facing * end.facing <= path.skin * path.skin)
        normal = glm::dot(apart, t.normal) > 0.0 ? t.normal : -t.normal;
    touch = {normal, glm::dot(normal, end.point) + path.thickness};
    return true;
}

bool TriangleMesh::sweep(const Path& path, HalfSpace& touch, bool& crossed) const {
    crossed = false;
    const bool closed = finder_.isClosed();
    const dvec3 whole = path.to - path.from;
    const double length = std::sqrt(glm::dot(whole, whole));

    const FootFinder::Place near = finder_.place(path.to);
    if (near.least > path.thickness + path.skin + length && !(closed && near.inside))
        return false;  // no triangle near the whole path

    const Foot end = finder_.foot(path.to, near);
    if (end.triangle < 0) return false;
    // A path shorter than the way to the surface crosses nothing, and starts on the side where it ends.
    const double clear = 1.0000001 * (length + path.skin);
    if (end.square > clear * clear)
        return finder_.isInside(path.to, end) ? findWayOut(path, end, touch) : touchNear(path, end, touch);

    if (closed && finder_.nearest(path.from).distance < 0.0) return findWayOut(path, end, touch);
    const int crossing = firstCrossing(path);
    if (crossing < 0) return touchNear(path, end, touch);
    const Facet& t = finder_.triangle(crossing);
    const dvec3 normal = isInFront(path, t) ? t.normal : -t.normal;
    touch = {normal, glm::dot(normal, t.corner) + path.thickness};
    crossed = true;
    return true;
}

}  // namespace taut::collision
