#include "taut/world/body.h"

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/core/hash.h"
#include "taut/mechanics/builders.h"
#include "taut/world/rotation.h"
#include "taut/world/targets.h"

namespace taut::world {
namespace {

using core::Error;
using core::ExitCode;

mechanics::Lumping lumpingOf(const std::string& name) {
    return name == "uniform" ? mechanics::Lumping::uniform : mechanics::Lumping::weighted;
}

dvec3 unit(const dvec3& v) { return v / std::sqrt(glm::dot(v, v)); }

// A number in [-1, 1) from a seed and two indices.
double randomNumber(std::int64_t seed, int point, int axis) {
    const std::uint64_t z = static_cast<std::uint64_t>(seed) * 0x9e3779b97f4a7c15ULL +
                            static_cast<std::uint64_t>(3 * static_cast<std::int64_t>(point) + axis + 1);
    return static_cast<double>(core::mixed(core::mixed(z)) >> 11) * 0x1p-52 - 1.0;
}

void holdPoints(Body& body) {
    for (const std::string& selector : body.common.hold) {
        const std::vector<int> points = selectPoints(body.model, selector);
        if (points.empty())
            throw Error(ExitCode::badContent, at(body.common.source) + "hold = \"" + selector + "\" names no point of " +
                                                  body.fullName());
        for (int i : points) body.model.held[static_cast<std::size_t>(i)] = true;
    }
}

void setInMotion(Body& body) {
    mechanics::Model& model = body.model;
    dvec3 centre(0.0);
    double mass = 0;
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
        centre += model.masses[i] * model.positions[i];
        mass += model.masses[i];
    }
    centre /= mass;
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
        if (model.held[i]) {
            model.velocities[i] = dvec3(0.0);
            continue;
        }
        model.velocities[i] += body.common.velocity + glm::cross(body.common.spin, model.positions[i] - centre);
        if (body.common.jitter > 0)
            for (int axis = 0; axis < 3; ++axis)
                model.positions[i][axis] +=
                    body.common.jitter * randomNumber(body.common.seed, static_cast<int>(i), axis);
    }
}

Body finishBody(Body::Kind kind, const BodySpec& spec, mechanics::Model model) {
    Body body;
    body.kind = kind;
    body.name = body.base = spec.name;
    body.common = spec;
    body.model = std::move(model);
    for (dvec3& x : body.model.positions) x += dvec3(0.0);  // no negative zero, so that held points keep their bits
    return body;
}

mechanics::ClothMaterial materialOf(const ClothSpec& spec, const std::map<std::string, MaterialSpec>& materials) {
    const auto found = materials.find(spec.material);
    if (found == materials.end() && !spec.material.empty())
        throw Error(ExitCode::badContent, at(spec.source) + "no [material." + spec.material + "]");
    const MaterialSpec m = found == materials.end() ? MaterialSpec{} : found->second;
    return {m.density, m.stretch, m.shear.value_or(0.5 * m.stretch), m.bend, m.dampingTime, m.drag,
            lumpingOf(m.lumping)};
}

Body finishCloth(const ClothSpec& spec, mechanics::Model model, const std::map<std::string, MaterialSpec>& materials) {
    Body body = finishBody(Body::Kind::cloth, spec, std::move(model));
    if (const auto found = materials.find(spec.material); found != materials.end())
        body.plasticity = found->second.plasticity;
    return body;
}

template <class Spec, class Build>
void addArray(std::vector<Body>& bodies, const Spec& spec, Build&& build) {
    const ArraySpec& array = spec.array;
    const bool single = array.count == ivec3(1);
    int number = 0;
    for (int z = 0; z < array.count.z; ++z)
        for (int y = 0; y < array.count.y; ++y)
            for (int x = 0; x < array.count.x; ++x, ++number) {
                Body body = build(spec);
                const dvec3 shift =
                    static_cast<double>(x) * array.stepX + static_cast<double>(y) * array.stepY + static_cast<double>(z) * array.stepZ;
                for (dvec3& position : body.model.positions) position += shift;
                if (!single) {
                    body.name = spec.name + "." + std::to_string(number);
                    body.common.seed = spec.seed + number;
                }
                bodies.push_back(std::move(body));
            }
}

void addMasses(std::vector<Body>& bodies, const SceneSpec& spec) {
    const std::vector<Body*> all = pointersTo(bodies);
    for (const MassSpec& extra : spec.masses) {
        std::vector<std::pair<Body*, int>> points;
        for (Body* body : matchBodies(all, extra.target))
            for (int i : selectPoints(body->model, parseTarget(extra.target).selector)) points.emplace_back(body, i);
        if (points.empty())
            throw Error(ExitCode::badContent, at(extra.source) + "target = \"" + extra.target + "\" names no point");
        for (auto& [body, i] : points)
            body->model.masses[static_cast<std::size_t>(i)] += extra.mass / static_cast<double>(points.size());
    }
}

}  // namespace

std::string_view kindName(Body::Kind kind) {
    switch (kind) {
        case Body::Kind::block: return "block";
        case Body::Kind::cloth: return "cloth";
        case Body::Kind::net: return "net";
        case Body::Kind::rope: return "rope";
    }
    return "?";
}

bool sortsBefore(const Body& a, const Body& b) {
    if (a.kind != b.kind) return a.kind < b.kind;
    if (a.base != b.base) return a.base < b.base;
    return a.name.size() != b.name.size() ? a.name.size() < b.name.size() : a.name < b.name;
}

std::string Body::fullName() const { return std::string(kindName(kind)) + "." + name; }

std::string at(const Source& source) {
    if (source.file.empty()) return "error: ";
    return source.file + ":" + std::to_string(source.line) + ":" + std::to_string(source.column) + ": error: ";
}

Body buildBody(const ClothSpec& spec, const std::map<std::string, MaterialSpec>& materials) {
    const mechanics::ClothMaterial material = materialOf(spec, materials);
    if (!spec.meshData) {
        const dvec3 across = unit(spec.across);
        const dvec3 down = unit(spec.down - glm::dot(spec.down, across) * across);
        mechanics::Model model =
            mechanics::buildCloth({spec.origin, across, down, spec.size, spec.cells, material});
        return finishCloth(spec, std::move(model), materials);
    }
    mechanics::MeshClothShape shape;
    const glm::dquat turn = rotationOf(spec.rotation);
    for (const dvec3& x : spec.meshData->positions) shape.positions.push_back(spec.position + rotated(turn, spec.scale * x));
    shape.uv = spec.meshData->uv;
    shape.triangles = spec.meshData->triangles;
    shape.material = material;
    try {
        return finishCloth(spec, mechanics::buildMeshCloth(shape), materials);
    } catch (const Error& error) {
        throw Error(error.code(), at(spec.source) + spec.mesh + ": " + error.what());
    }
}

Body buildBody(const RopeSpec& spec) {
    mechanics::RopeShape shape;
    shape.start = spec.start;
    shape.end = spec.end;
    shape.segments = spec.segments;
    shape.length = spec.length;
    shape.mass = spec.mass;
    shape.stretch = spec.stretch;
    shape.bend = spec.bend;
    shape.dampingTime = spec.dampingTime;
    shape.dragRate = spec.drag;
    shape.lumping = lumpingOf(spec.lumping);
    Body body = finishBody(Body::Kind::rope, spec, mechanics::buildRope(shape));
    body.radius = spec.radius;
    body.plasticity = spec.plasticity;
    return body;
}

Body buildBody(const BlockSpec& spec) {
    mechanics::BlockShape shape;
    shape.centre = spec.position;
    const glm::dquat turn = rotationOf(spec.rotation);
    shape.axes = glm::dmat3(rotated(turn, {1, 0, 0}), rotated(turn, {0, 1, 0}), rotated(turn, {0, 0, 1}));
    shape.size = spec.size;
    shape.cells = spec.cells;
    shape.density = spec.density;
    shape.young = spec.young;
    shape.bulk = spec.bulk;
    shape.dampingTime = spec.dampingTime;
    shape.dragRate = spec.drag;
    shape.lumping = lumpingOf(spec.lumping);
    Body body = finishBody(Body::Kind::block, spec, mechanics::buildBlock(shape));
    body.workingStretch = spec.workingStretch;
    body.plasticity = spec.plasticity;
    return body;
}

Body buildBody(const NetSpec& spec) {
    std::vector<mechanics::NetPoint> points;
    for (const NetPointSpec& p : spec.points)
        points.push_back({p.name, p.position, dvec3(0.0), p.mass, spec.drag, p.hold});
    std::vector<mechanics::NetSpring> springs;
    for (const NetSpringSpec& s : spec.springs)
        springs.push_back({s.a, s.b, s.stiffness, s.restLength, s.dampingTime.value_or(spec.dampingTime)});
    Body body = finishBody(Body::Kind::net, spec, mechanics::buildNet(points, springs));
    body.radius = spec.radius;
    body.ball = spec.ball;
    body.plasticity = spec.plasticity;
    return body;
}

void startBody(Body& body) {
    holdPoints(body);
    setInMotion(body);
}

std::vector<Body*> pointersTo(std::vector<Body>& bodies) {
    std::vector<Body*> pointers;
    for (Body& body : bodies) pointers.push_back(&body);
    return pointers;
}

bool names(const std::string& text, const Body& body) {
    const Target target = parseTarget(text);
    return target.kind == kindName(body.kind) && (matches(target.name, body.name) || matches(target.name, body.base));
}

std::vector<Body*> matchBodies(std::span<Body* const> bodies, const std::string& text) {
    std::vector<Body*> found;
    for (Body* body : bodies)
        if (names(text, *body)) found.push_back(body);
    return found;
}

std::vector<Body> buildBodies(const SceneSpec& spec) {
    std::vector<Body> bodies;
    for (const ClothSpec& s : spec.cloths) addArray(bodies, s, [&](const ClothSpec& c) { return buildBody(c, spec.materials); });
    for (const RopeSpec& s : spec.ropes) addArray(bodies, s, [](const RopeSpec& r) { return buildBody(r); });
    for (const BlockSpec& s : spec.blocks) addArray(bodies, s, [](const BlockSpec& b) { return buildBody(b); });
    for (const NetSpec& s : spec.nets) addArray(bodies, s, [](const NetSpec& n) { return buildBody(n); });
    std::sort(bodies.begin(), bodies.end(), sortsBefore);
    addMasses(bodies, spec);
    for (Body& body : bodies) startBody(body);
    return bodies;
}

}  // namespace taut::world
