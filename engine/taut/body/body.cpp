#include "taut/body/body.h"

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/core/private/hash.h"
#include "taut/spec/spec.h"
#include "taut/spec/targets.h"

namespace taut::world {

TAUT_VALUE_MEMBERS(Body);
namespace {

using core::Error;
using core::ErrorKind;

// A number in [-1, 1) from a seed and two indices.
double randomNumber(std::int64_t seed, int point, int axis) {
    const std::uint64_t z = static_cast<std::uint64_t>(seed) * 0x9e3779b97f4a7c15ULL +
                            static_cast<std::uint64_t>(3 * static_cast<std::int64_t>(point) + axis + 1);
    return static_cast<double>(core::mixed(core::mixed(z)) >> 11) * 0x1p-52 - 1.0;
}

void holdPoints(Body& body) {
    const auto hold = [&](const char* key, const std::string& selector) {
        const std::vector<int> points = selectPoints(body.model, selector);
        if (points.empty())
            throw Error(ErrorKind::badContent,
                        at(body.spec->source) + key + " = \"" + selector + "\" names no point of " + body.fullName());
        if (body.spec->holdOn.empty())
            for (int i : points) body.model.held[i] = true;
        else
            body.carried.insert(body.carried.end(), points.begin(), points.end());
        return points;
    };
    for (const std::string& selector : body.spec->hold) hold("hold", selector);
    for (const std::string& selector : body.spec->clamp) {
        body.clamped.resize(body.model.positions.size(), false);
        for (int i : hold("clamp", selector)) body.clamped[i] = true;
    }
    std::sort(body.carried.begin(), body.carried.end());
    body.carried.erase(std::unique(body.carried.begin(), body.carried.end()), body.carried.end());
}

bool starts(const Body& body, int point) {
    return !body.model.held[point] && !std::binary_search(body.carried.begin(), body.carried.end(), point);
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
        if (!starts(body, static_cast<int>(i))) {
            model.velocities[i] = dvec3(0.0);
            continue;
        }
        model.velocities[i] += body.spec->velocity + glm::cross(body.spec->spin, model.positions[i] - centre);
        if (body.spec->jitter > 0) model.positions[i] += jitterOf(body, static_cast<int>(i));
    }
}

// Each copy of an array has the model of the first, moved.
void addCopies(std::vector<Body>& bodies, const BodySpec& spec, const SceneSpec& scene) {
    const ArraySpec& array = spec.array;
    const Body first = buildBody(spec, scene);
    const bool single = array.count == ivec3(1);
    int number = 0;
    for (int z = 0; z < array.count.z; ++z)
        for (int y = 0; y < array.count.y; ++y)
            for (int x = 0; x < array.count.x; ++x, ++number) {
                Body body = first;
                const dvec3 shift = static_cast<double>(x) * array.stepX + static_cast<double>(y) * array.stepY +
                                    static_cast<double>(z) * array.stepZ;
                for (dvec3& position : body.model.positions) position += shift;
                for (RigidPiece& piece : body.pieces) piece.at.position += shift;
                body.axes.position += shift;
                if (!single) {
                    body.name = spec.name + "." + std::to_string(number);
                    body.seed = spec.seed + number;
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
            throw Error(ErrorKind::badContent, at(extra.source) + "target = \"" + extra.target + "\" names no point");
        for (auto& [body, i] : points) body->model.masses[i] += extra.mass / static_cast<double>(points.size());
    }
}

// The air that goes along with bodies in a wind is a part of their mass; with others none goes along.
void addAir(std::vector<Body>& bodies, const SceneSpec& spec) {
    std::vector<const Body*> surrounded;
    const std::vector<Body*> all = pointersTo(bodies);
    for (const ForceSpec& force : spec.forces)
        for (const std::string& target : force.surroundedBodies())
            for (Body* body : matchBodies(all, target)) surrounded.push_back(body);
    for (Body& body : bodies) {
        mechanics::Model& model = body.model;
        if (std::find(surrounded.begin(), surrounded.end(), &body) == surrounded.end()) model.airMasses.clear();
        for (std::size_t i = 0; i < model.airMasses.size(); ++i) model.masses[i] += model.airMasses[i];
    }
}

// Calls visit(length [m]) of the edges of triangles, or of structural springs if there are none.
template <class Visit>
void eachTouchedEdge(const mechanics::Model& model, const Visit& visit) {
    const auto look = [&](int a, int b) {
        const dvec3 d = model.positions[a] - model.positions[b];
        visit(std::sqrt(glm::dot(d, d)));
    };
    for (const std::array<int, 3>& t : model.triangles)
        for (std::size_t k = 0; k < 3; ++k) look(t[k], t[(k + 1) % 3]);
    if (!model.triangles.empty()) return;
    for (const mechanics::Spring& s : model.springs)
        if (s.kind == mechanics::SpringKind::structural) look(s.a, s.b);
}

}  // namespace

dvec3 jitterOf(const Body& body, int point) {
    if (!(body.spec->jitter > 0) || !starts(body, point)) return dvec3(0.0);
    dvec3 jitter;
    for (int axis = 0; axis < 3; ++axis) jitter[axis] = body.spec->jitter * randomNumber(body.seed, point, axis);
    return jitter;
}

bool sortsBefore(const Body& a, const Body& b) {
    if (a.kind() != b.kind()) return a.kind() < b.kind();
    if (a.base() != b.base()) return a.base() < b.base();
    return a.name.size() != b.name.size() ? a.name.size() < b.name.size() : a.name < b.name;
}

std::string Body::fullName() const {
    return std::string(kind()) + "." + name;
}

Body buildBody(const BodySpec& spec, const SceneSpec& scene) {
    Body body;
    body.spec = spec.copy();
    body.name = spec.name;
    body.seed = spec.seed;
    body.model = spec.build(scene);
    body.pieces = spec.pieces(scene);
    body.axes = spec.axes();
    body.plasticity = spec.plasticityIn(scene);
    for (dvec3& x : body.model.positions) x += dvec3(0.0);  // no negative zero: pinned points keep their bits
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
    return target.kind == body.kind() && (matches(target.name, body.name) || matches(target.name, body.base()));
}

std::vector<Body*> matchBodies(std::span<Body* const> bodies, const std::string& text) {
    std::vector<Body*> found;
    for (Body* body : bodies)
        if (names(text, *body)) found.push_back(body);
    return found;
}

std::vector<Body> buildBodies(const SceneSpec& spec) {
    std::vector<Body> bodies;
    for (const BodySpec& body : spec.bodies) addCopies(bodies, body, spec);
    std::sort(bodies.begin(), bodies.end(), sortsBefore);
    addMasses(bodies, spec);
    addAir(bodies, spec);
    for (Body& body : bodies) startBody(body);
    return bodies;
}

std::vector<mechanics::RigidPart> surfacesOf(const Body& body) {
    if (!body.model.parts.empty()) return body.model.parts;
    mechanics::RigidPart whole;
    whole.first = body.model.innerPoints;
    whole.last = body.model.pointCount();
    whole.thickness = body.spec->thickness;
    return {whole};
}

double shortestEdge(const Body& body) {
    double least = HUGE_VAL;
    eachTouchedEdge(body.model, [&](double length) { least = std::min(least, length); });
    return least;
}

double longestEdge(const Body& body) {
    double most = 0;
    eachTouchedEdge(body.model, [&](double length) { most = std::max(most, length); });
    return most;
}

}  // namespace taut::world
