#include "taut/geometry/private/parts.h"

#include <algorithm>

#include "taut/view/primitives.h"

namespace taut::geometry {
namespace {

constexpr float groundHalfSize = 8.0F;  // [m]

bool isTheSame(const view::Geometry& a, const view::Geometry& b) {
    return a.positions == b.positions && a.normals == b.normals;
}

bool isTheSame(const std::vector<std::shared_ptr<const view::Topology>>& a,
               const std::vector<std::shared_ptr<const view::Topology>>& b) {
    return std::equal(
        a.begin(), a.end(), b.begin(), b.end(),
        [](const auto& one, const auto& other) {
            return one == other || (one->triangles == other->triangles && one->uv == other->uv);
        });
}

bool goOnAsOne(const view::Surface& a, const view::Surface& b) {
    const glm::mat4 nowhere(1.0F);
    return a.name == b.name && a.finish == b.finish && a.transform == nowhere && b.transform == nowhere;
}

std::shared_ptr<const view::Topology> joined(const std::vector<std::shared_ptr<const view::Topology>>& all) {
    if (all.size() == 1) return all.front();
    auto topology = std::make_shared<view::Topology>();
    for (const auto& one : all) {
        const auto first = static_cast<std::uint32_t>(topology->uv.size());
        for (const std::uint32_t vertex : one->triangles) topology->triangles.push_back(first + vertex);
        topology->uv.insert(topology->uv.end(), one->uv.begin(), one->uv.end());
    }
    return topology;
}

std::shared_ptr<const view::Geometry> joined(const std::vector<const view::Surface*>& all) {
    if (all.size() == 1) return all.front()->geometry;
    auto geometry = std::make_shared<view::Geometry>();
    for (const view::Surface* one : all) {
        const view::Geometry& more = *one->geometry;
        geometry->positions.insert(geometry->positions.end(), more.positions.begin(), more.positions.end());
        geometry->normals.insert(geometry->normals.end(), more.normals.begin(), more.normals.end());
    }
    return geometry;
}

}  // namespace

std::string identifierOf(const std::string& name) {
    std::string identifier;
    for (const char c : name) {
        const bool isFit = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        identifier += isFit ? c : '_';
    }
    return identifier;
}

std::string PartFinder::fullName(const view::Surface& surface) {
    return surface.name.find('.') == std::string::npos ? "collider." + surface.name : surface.name;
}

PartFinder::Known& PartFinder::known(const std::string& name, std::size_t ordinal) {
    const auto [entry, isNew] = known_.try_emplace({name, ordinal});
    if (isNew) {
        const std::string stem = identifierOf(name);
        std::string identifier = stem;
        for (std::size_t n = ordinal; !identifiers_.insert(identifier).second; ++n)
            identifier = stem + "_" + std::to_string(n + 1);
        entry->second.part.identifier = identifier;
        entry->second.part.name = name;
    }
    return entry->second;
}

Part PartFinder::partOf(const Group& group, const std::string& name, std::size_t ordinal) {
    Known& that = known(name, ordinal);
    Part& part = that.part;
    std::vector<std::shared_ptr<const view::Topology>> topologies;
    for (const view::Surface* surface : group) topologies.push_back(surface->topology);
    if (!part.topology || !isTheSame(topologies, that.topologies)) part.topology = joined(topologies);
    that.topologies = std::move(topologies);
    auto geometry = joined(group);
    if (!part.geometry || (part.geometry != geometry && !isTheSame(*part.geometry, *geometry)))
        part.geometry = std::move(geometry);
    part.finish = group.front()->finish;
    part.isTwoSided = group.front()->twoSided;
    part.transform = group.front()->transform;
    return part;
}

void PartFinder::addGround(const view::FrameView& view, std::vector<Part>& parts) {
    if (!view.ground || (isWanted_ && !isWanted_("ground"))) return;
    Part& part = known("ground", 0).part;
    if (!part.geometry) {
        const view::Mesh mesh = view::quadMesh(glm::vec3(0.0F, 1.0F, 0.0F), groundHalfSize);
        part.topology = mesh.topology;
        part.geometry = mesh.geometry;
        auto finish = std::make_shared<view::Finish>();
        finish->front = view.ground->colour;
        finish->roughness = 0.9F;
        part.finish = finish;
        part.transform[3] = glm::vec4(view.camera.target.x, view.ground->height, view.camera.target.z, 1.0F);
    }
    parts.push_back(part);
}

std::vector<Part> PartFinder::partsOf(const view::FrameView& view) {
    std::vector<Part> parts;
    std::map<std::string, std::size_t> ordinals;
    for (auto first = view.surfaces.begin(); first != view.surfaces.end();) {
        auto end = std::next(first);
        while (end != view.surfaces.end() && goOnAsOne(*first, *end)) ++end;
        const std::string name = fullName(*first);
        Group group;
        for (; first != end; ++first) group.push_back(&*first);
        if (!isWanted_ || isWanted_(name)) parts.push_back(partOf(group, name, ordinals[name]++));
    }
    addGround(view, parts);
    return parts;
}

}  // namespace taut::geometry
