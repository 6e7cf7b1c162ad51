#include "taut/world/forces.h"

#include "taut/world/targets.h"

namespace taut::world {
namespace {

mechanics::LinearPath still(const dvec3& value) {
    return {value, value};
}

dvec3 rateOf(const mechanics::LinearPath& path) {
    return path.isLine ? path.to - path.from : dvec3(0.0);
}

}  // namespace

IslandForces resolveForces(const WorldSpec& world, std::span<const WindSpec> winds, std::span<const AnchorSpec> anchors,
                           std::span<Body* const> bodies) {
    IslandForces forces;
    forces.gravity = still(world.gravity);
    for (const WindSpec& wind : winds) {
        if (wind.drag == 0.0 && wind.lift == 0.0) continue;  // without force
        WindOn on;
        on.velocity = still(wind.velocity);
        on.settings.airDensity = world.airDensity;
        on.settings.drag = wind.drag;
        on.settings.lift = wind.lift;
        on.settings.gust = {wind.gustAmplitude, wind.gustPeriod, wind.gustLength, wind.gustSeed};
        const std::vector<std::string> targets = wind.on.empty() ? std::vector<std::string>{"cloth.*"} : wind.on;
        for (const std::string& target : targets)
            for (const Body* body : matchBodies(bodies, target)) on.bodies.push_back(body);
        forces.winds.push_back(std::move(on));
    }
    for (const AnchorSpec& anchor : anchors)
        for (const Body* body : matchBodies(bodies, anchor.target)) {
            AnchorOn on{still(anchor.at), anchor.stiffness, anchor.damping, body,
                        selectPoints(body->model, parseTarget(anchor.target).selector)};
            if (!on.points.empty()) forces.anchors.push_back(std::move(on));
        }
    return forces;
}

IslandForces between(const IslandForces& from, const IslandForces& middle, const IslandForces& to, double t0,
                     double t1) {
    IslandForces forces = middle;
    const auto path = [&](const mechanics::LinearPath& a, const mechanics::LinearPath& b) {
        return a.to == b.to ? still(a.to) : mechanics::LinearPath{a.to, b.to, t0, t1};
    };
    forces.gravity = path(from.gravity, to.gravity);
    if (from.winds.size() == to.winds.size() && middle.winds.size() == to.winds.size())
        for (std::size_t i = 0; i < to.winds.size(); ++i)
            forces.winds[i].velocity = path(from.winds[i].velocity, to.winds[i].velocity);
    for (std::size_t i = 0; i < to.anchors.size(); ++i) {
        const dvec3 a = from.anchors[i].place.to, b = to.anchors[i].place.to;
        forces.anchors[i].place = a == b ? still(a) : mechanics::LinearPath::line(a, (b - a) / (t1 - t0), t0);
    }
    return forces;
}

bool goesOn(const IslandForces& before, const IslandForces& now) {
    if (before.winds.size() != now.winds.size() || before.anchors.size() != now.anchors.size()) return false;
    if (before.gravity.to != now.gravity.from) return false;
    for (std::size_t i = 0; i < now.winds.size(); ++i) {
        const WindOn &a = before.winds[i], &b = now.winds[i];
        if (!(a.settings == b.settings) || a.bodies != b.bodies || a.velocity.to != b.velocity.from) return false;
    }
    for (std::size_t i = 0; i < now.anchors.size(); ++i) {
        const AnchorOn &a = before.anchors[i], &b = now.anchors[i];
        if (a.stiffness != b.stiffness || a.damping != b.damping || a.body != b.body || a.points != b.points ||
            rateOf(a.place) != rateOf(b.place))
            return false;
        if (!a.place.isLine && a.place.to != b.place.from) return false;
    }
    return true;
}

}  // namespace taut::world
