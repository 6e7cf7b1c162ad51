#include "taut/collision/form.h"

namespace taut::collision {

namespace {

// A walk along a path. No step is longer than the distance to the surface, so none leads through it. Only parts thinner
// than a 64th of the path may be missed.
class Walk {
  public:
    Walk(const Form& form, const Path& path, double length, const Nearest& start)
        : near(start), at(path.from), form_(form), path_(path), length_(length) {}

    // False at the end of the path.
    bool go(double step) {
        const double least = length_ / 64.0;
        gone_ += step > least ? step : least;
        if (!(gone_ < length_)) return false;
        at = path_.from + (gone_ / length_) * (path_.to - path_.from);
        near = form_.nearest(at);
        return true;
    }

    Nearest near;
    dvec3 at;

  private:
    const Form& form_;
    const Path& path_;
    const double length_;
    double gone_ = 0.0;  // [m]
};

// Where the path first comes as near as `gap` [m]. While it leads away from the surface it may be nearer than that.
bool reach(Walk walk, const Path& path, double gap, HalfSpace& touch) {
    constexpr int mostSteps = 256;
    const double close = nearEnough(path);
    for (int i = 0; i < mostSteps; ++i) {
        const Nearest& near = walk.near;
        const bool approaches = glm::dot(near.normal, path.to - path.from) < 0.0;
        if (approaches && near.distance - gap <= close) break;
        if (!walk.go(near.distance - (approaches ? gap : 0.0))) return false;
    }
    touch = {walk.near.normal, glm::dot(walk.near.normal, walk.at) - walk.near.distance + path.thickness};
    return true;
}

// Whether the path goes into the shape and comes out again.
bool goesThrough(Walk walk, double close) {
    bool isIn = false;
    do {
        if (walk.near.distance < -close) isIn = true;
        if (isIn && walk.near.distance > close) return true;
    } while (walk.go(std::abs(walk.near.distance)));
    return false;
}

}  // namespace

bool Form::sweep(const Path& path, HalfSpace& touch, bool&) const {
    const Nearest end = nearest(path.to);
    const Nearest start = nearest(path.from);
    const dvec3 way = path.to - path.from;
    const double length = std::sqrt(glm::dot(way, way));
    const bool startsOutside = start.distance > -path.skin;
    const double gap = sweepGap(start.distance, path.thickness);
    // A distance changes by no more than the length of the way. So this is the least distance on the path.
    const double least = 0.5 * (start.distance + end.distance - length);
    if (end.distance >= path.thickness + path.skin)
        return startsOutside && least < path.thickness && reach({*this, path, length, start}, path, gap, touch);

    // The path ends too near. If it came through the shape, the touch is where it went in.
    touch = {end.normal, glm::dot(end.normal, path.to) - end.distance + path.thickness};
    if (!startsOutside || least > 0.0) return true;
    if (glm::dot(start.normal, end.normal) <= 0.0 || goesThrough({*this, path, length, start}, nearEnough(path)))
        reach({*this, path, length, start}, path, gap, touch);
    return true;
}

}  // namespace taut::collision
