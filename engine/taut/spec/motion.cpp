#include "taut/spec/private/motion.h"

#include "taut/core/trig.h"
#include "taut/spec/private/rotation.h"

namespace taut::world {
namespace {

// The keys around t and the eased share of the way between them.
template <class Key>
struct Span {
    const Key* from;
    const Key* to;
    double share;
};

template <class Key>
Span<Key> spanAt(const std::vector<Key>& keys, double t) {
    if (t <= keys.front().t) return {&keys.front(), &keys.front(), 0.0};
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (t < keys[i].t)
            return {&keys[i - 1], &keys[i], eased(keys[i].ease, (t - keys[i - 1].t) / (keys[i].t - keys[i - 1].t))};
    return {&keys.back(), &keys.back(), 0.0};
}

dvec3 mix(const dvec3& a, const dvec3& b, double share) {
    return a + share * (b - a);
}

}  // namespace

double eased(Ease ease, double u) {
    switch (ease) {
        case Ease::linear: return u;
        case Ease::smooth: return u * u * (3.0 - 2.0 * u);
        case Ease::in: return u * u;
        case Ease::out: return u * (2.0 - u);
        case Ease::hold: return 0.0;
    }
    return u;
}

collision::Pose poseAt(const ColliderSpec& spec, double t) {
    if (spec.keys.empty()) return {spec.position, rotationOf(spec.rotation)};
    const Span<PoseKey> span = spanAt(spec.keys, t);
    return {mix(span.from->position, span.to->position, span.share),
            rotationOf(mix(span.from->rotation, span.to->rotation, span.share))};
}

view::Camera cameraAt(const CameraSpec& spec, double t) {
    dvec3 eye = spec.eye, target = spec.target;
    double field = spec.fieldOfView;
    if (!spec.keys.empty()) {
        const Span<CameraKey> span = spanAt(spec.keys, t);
        eye = mix(span.from->eye, span.to->eye, span.share);
        target = mix(span.from->target, span.to->target, span.share);
        const double a = span.from->fieldOfView.value_or(field), b = span.to->fieldOfView.value_or(field);
        field = a + span.share * (b - a);
    }
    if (spec.orbitPeriod) {
        const double angle = 2.0 * core::pi * t / *spec.orbitPeriod;
        const dvec3 d = eye - target;
        const double c = core::cosine(angle), s = core::sine(angle);
        eye = target + dvec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x);
    }
    view::Camera camera;
    camera.eye = glm::vec3(eye);
    camera.target = glm::vec3(target);
    camera.fieldOfView = static_cast<float>(field);
    return camera;
}

collision::Pose between(const collision::Pose& from, const collision::Pose& to, double part) {
    if (part <= 0) return from;
    if (part >= 1) return to;
    // Without a turn the rotation keeps its bits, so that a thing at rest is still.
    if (from.rotation == to.rotation) return {from.position + part * (to.position - from.position), from.rotation};
    const double sign = glm::dot(from.rotation, to.rotation) < 0 ? -1.0 : 1.0;
    return {from.position + part * (to.position - from.position),
            glm::normalize(from.rotation * (1.0 - part) + to.rotation * (sign * part))};
}

}  // namespace taut::world
