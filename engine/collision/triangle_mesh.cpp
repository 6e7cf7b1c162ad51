#include "taut/collision/triangle_mesh.h"

namespace taut::collision {

namespace {

// The nearest point of a triangle: by the sign of the barycentric coordinates the regions of its corners and edges
// are told apart (Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
dvec3 nearestOnTriangle(const dvec3& p, const dvec3& a, const dvec3& ab, const dvec3& ac) {
    const dvec3 ap = p - a;
    const double d1 = glm::dot(ab, ap);
    const double d2 = glm::dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0) return a;
    const dvec3 bp = ap - ab;
    const double d3 = glm::dot(ab, bp);
    const double d4 = glm::dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3) return a + ab;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + ab * (d1 / (d1 - d3));
    const dvec3 cp = ap - ac;
    const double d5 = glm::dot(ab, cp);
    const double d6 = glm::dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6) return a + ac;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + ac * (d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
        return a + ab + (ac - ab) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double whole = 1.0 / (va + vb + vc);
    return a + ab * (vb * whole) + ac * (vc * whole);
}

}  // namespace

void TriangleMesh::updateFoot(const dvec3& p, int triangle, Foot& foot) const {
    const Triangle& t = triangles_[static_cast<std::size_t>(triangle)];
    const dvec3 q = nearestOnTriangle(p, t.corner, t.ab, t.ac);
    const dvec3 apart = p - q;
    const double square = glm::dot(apart, apart);
    const double tie = 1e-11 * foot.square;
    if (square > foot.square + tie) return;
    const double facing = std::abs(glm::dot(apart, t.normal));
    if (square < foot.square - tie || facing > foot.facing * (1.0 + 1e-9) ||
        (facing >= foot.facing * (1.0 - 1e-9) && triangle < foot.triangle))
        foot = {square, facing, q, triangle};
}

TriangleMesh::Foot TriangleMesh::footWithin(const dvec3& p, double radius) const {
    Foot foot;
    Box box{p, p};
    box.grow(radius);
    tree_.visit(box, [&](int triangle) { updateFoot(p, triangle, foot); });
    return foot;
}

Nearest TriangleMesh::nearestFrom(const dvec3& p, const Foot& foot) const {
    const dvec3& normal = triangles_[static_cast<std::size_t>(foot.triangle)].normal;
    const dvec3 apart = p - foot.point;
    const double distance = std::sqrt(foot.square);
    const bool inside = closed_ && glm::dot(apart, normal) < 0.0;
    if (!(distance > 0.0)) return {0.0, normal};
    return {inside ? -distance : distance, apart * ((inside ? -1.0 : 1.0) / distance)};
}

Nearest TriangleMesh::nearest(const dvec3& p) const {
    // The radius grows by a little so that rounding cannot leave out the one triangle that is that far.
    const Foot foot = footWithin(p, guess(p).most * (1.0 + 1e-6) + 1e-9 * cellSize_);
    if (foot.triangle < 0) return {std::numeric_limits<double>::infinity(), {0.0, 1.0, 0.0}};
    return nearestFrom(p, foot);
}

TriangleMesh::Guess TriangleMesh::guess(const dvec3& p) const {
    glm::ivec3 cell;
    for (int k = 0; k < 3; ++k) {
        const double place = (p[k] - bounds_.low[k]) / cellSize_;
        const int last = cellCount_[k] - 1;
        cell[k] = place >= last ? last : (place > 0.0 ? static_cast<int>(place) : 0);
    }
    const double atMiddle = cells_[static_cast<std::size_t>((cell.z * cellCount_.y + cell.y) * cellCount_.x + cell.x)];
    const dvec3 off = p - (bounds_.low + (dvec3(cell) + 0.5) * cellSize_);
    const double away = std::sqrt(glm::dot(off, off));
    // A distance changes by no more than the way that is walked.
    return {std::abs(atMiddle) - away, std::abs(atMiddle) + away, atMiddle < 0.0};
}

bool TriangleMesh::findWayOut(const Path& path, Touch& touch) const {
    const Nearest end = nearest(path.to);
    if (end.distance >= path.thickness + path.skin) return false;
    touch = {end.normal, glm::dot(end.normal, path.to) - end.distance + path.thickness};
    return true;
}

// The side from which a path comes. In the plane itself it is the front.
bool TriangleMesh::isInFront(const Path& path, const Triangle& t) {
    return glm::dot(path.from - t.corner, t.normal) > -path.skin;
}

bool TriangleMesh::sweep(const Path& path, Touch& touch, bool& crossed) const {
    crossed = false;
    const double reach = path.thickness + path.skin;
    const dvec3 whole = path.to - path.from;

    const Guess end = guess(path.to);
    if (end.least > reach + std::sqrt(glm::dot(whole, whole)))  // no triangle near the whole path
        return closed_ && end.inside && findWayOut(path, touch);

    // One walk through the tree: the first crossing, the nearest place to the end and, where the mesh is closed and
    // the cells leave it open, the nearest place to the start, which tells whether the point starts inside.
    const Guess start = guess(path.from);
    const bool asksStart = closed_ && start.least <= 0.0;
    Box box;
    box.add(path.from);
    box.add(path.to);
    box.grow(reach);
    if (asksStart) {
        Box around{path.from, path.from};
        around.grow(start.most * (1.0 + 1e-6) + 1e-9 * cellSize_);
        box.add(around.low);
        box.add(around.high);
    }
    Foot startFoot;
    Foot endFoot;
    double first = 2.0;      // fraction of the path
    double steepest = -1.0;  // [m] how much of the path runs along the crossed triangle's normal
    int crossing = -1;
    tree_.visit(box, [&](int index) {
        updateFoot(path.to, index, endFoot);
        if (asksStart) updateFoot(path.from, index, startFoot);
        const Triangle& t = triangles_[static_cast<std::size_t>(index)];
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

    const bool startsInside = asksStart ? startFoot.triangle >= 0 && nearestFrom(path.from, startFoot).distance < 0.0
                                        : closed_ && start.inside;
    if (startsInside) return findWayOut(path, touch);
    if (crossing >= 0) {
        const Triangle& t = triangles_[static_cast<std::size_t>(crossing)];
        const dvec3 normal = isInFront(path, t) ? t.normal : -t.normal;
        touch = {normal, glm::dot(normal, t.corner) + path.thickness};
        crossed = true;
        return true;
    }
    if (endFoot.triangle < 0 || !(endFoot.square < reach * reach)) return false;
    // Off the middle of a triangle the direction is its normal, which is exact however near the point is.
    const double distance = std::sqrt(endFoot.square);
    const Triangle& t = triangles_[static_cast<std::size_t>(endFoot.triangle)];
    const dvec3 apart = path.to - endFoot.point;
    dvec3 normal = apart * (1.0 / distance);
    if (!(distance > path.skin))
        normal = isInFront(path, t) ? t.normal : -t.normal;
    else if (endFoot.square - endFoot.facing * endFoot.facing <= path.skin * path.skin)
        normal = glm::dot(apart, t.normal) > 0.0 ? t.normal : -t.normal;
    touch = {normal, glm::dot(normal, endFoot.point) + path.thickness};
    return true;
}

}  // namespace taut::collision
