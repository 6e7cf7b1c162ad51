#include "taut/render/private/mesh_cache.h"

#include <algorithm>

#include "taut/core/error.h"

namespace taut::render {

namespace {

const void* offset(std::size_t bytes) {
    return reinterpret_cast<const void*>(bytes);
}

template <class T>
GLsizeiptr byteCount(const std::vector<T>& values) {
    return static_cast<GLsizeiptr>(values.size() * sizeof(T));
}

// Boxes around so many triangles each: neighbours in the list are mostly neighbours in space.
std::vector<Bounds> piecesOf(const view::Geometry& geometry, const view::Topology& topology) {
    constexpr std::size_t cornersAPiece = 3 * 32;
    std::vector<Bounds> pieces;
    const std::vector<std::uint32_t>& corners = topology.triangles;
    for (std::size_t first = 0; first < corners.size(); first += cornersAPiece) {
        glm::vec3 low = geometry.positions[corners[first]], high = low;
        for (std::size_t i = first; i < std::min(first + cornersAPiece, corners.size()); ++i) {
            low = glm::min(low, geometry.positions[corners[i]]);
            high = glm::max(high, geometry.positions[corners[i]]);
        }
        pieces.push_back({low, high, false});
    }
    return pieces;
}

}  // namespace

MeshCache::MeshCache(const Gl& gl) : gl_(&gl), layout_(gl, GlKind::vertexArray) {}

GlObject MeshCache::takeBuffer() {
    if (spare_.empty()) return {*gl_, GlKind::buffer};
    GlObject buffer = std::move(spare_.back());
    spare_.pop_back();
    return buffer;
}

void MeshCache::forgetExpired() {
    for (auto entry = geometries_.begin(); entry != geometries_.end();) {
        if (entry->second.owner.expired()) {
            spare_.push_back(std::move(entry->second.vertices));
            entry = geometries_.erase(entry);
        } else {
            ++entry;
        }
    }
    std::erase_if(topologies_, [](const auto& entry) { return entry.second.owner.expired(); });
}

MeshCache::GeometryEntry& MeshCache::upload(const std::shared_ptr<const view::Geometry>& geometry) {
    const auto known = geometries_.find(geometry.get());
    if (known != geometries_.end()) return known->second;
    GeometryEntry entry{geometry, takeBuffer(), {}, ++uploads_, {}, {}};
    const GLsizeiptr half = byteCount(geometry->positions);
    gl_->BindBuffer(GL_ARRAY_BUFFER, entry.vertices.id());
    gl_->BufferData(GL_ARRAY_BUFFER, 2 * half, nullptr, GL_DYNAMIC_DRAW);
    gl_->BufferSubData(GL_ARRAY_BUFFER, 0, half, geometry->positions.data());
    gl_->BufferSubData(GL_ARRAY_BUFFER, half, half, geometry->normals.data());
    for (const glm::vec3& position : geometry->positions) entry.bounds.include(position);
    return geometries_.emplace(geometry.get(), std::move(entry)).first->second;
}

const MeshCache::TopologyEntry& MeshCache::upload(const std::shared_ptr<const view::Topology>& topology) {
    const auto known = topologies_.find(topology.get());
    if (known != topologies_.end()) return known->second;
    for (const std::uint32_t corner : topology->triangles) TAUT_EXPECTS(corner < topology->uv.size());
    TopologyEntry entry{topology, {*gl_, GlKind::buffer}, {*gl_, GlKind::buffer}, ++uploads_};
    gl_->BindBuffer(GL_ARRAY_BUFFER, entry.corners.id());
    gl_->BufferData(GL_ARRAY_BUFFER, byteCount(topology->uv), topology->uv.data(), GL_STATIC_DRAW);
    gl_->BindBuffer(GL_ARRAY_BUFFER, entry.indices.id());
    gl_->BufferData(GL_ARRAY_BUFFER, byteCount(topology->triangles), topology->triangles.data(), GL_STATIC_DRAW);
    return topologies_.emplace(topology.get(), std::move(entry)).first->second;
}

std::vector<DrawItem> MeshCache::items(const std::vector<view::Surface>& surfaces) {
    forgetExpired();
    std::vector<DrawItem> result;
    result.reserve(surfaces.size());
    std::vector<ShadowShape> shapes;
    shapes.reserve(surfaces.size());
    for (const view::Surface& surface : surfaces) {
        TAUT_EXPECTS(surface.topology != nullptr && surface.geometry != nullptr && surface.finish != nullptr);
        TAUT_EXPECTS(surface.geometry->positions.size() == surface.topology->uv.size());
        TAUT_EXPECTS(surface.geometry->positions.size() == surface.geometry->normals.size());
        if (surface.topology->triangles.empty()) continue;
        const TopologyEntry& topology = upload(surface.topology);
        GeometryEntry& geometry = upload(surface.geometry);
        if (geometry.topology.lock() != surface.topology) {
            geometry.topology = surface.topology;
            geometry.pieces = piecesOf(*surface.geometry, *surface.topology);
        }
        std::vector<Bounds> pieces;
        for (const Bounds& piece : geometry.pieces) pieces.push_back(piece.transformed(surface.transform));
        result.push_back({&surface,
                          geometry.vertices.id(),
                          topology.corners.id(),
                          topology.indices.id(),
                          static_cast<GLsizei>(surface.topology->triangles.size()),
                          surface.geometry->positions.size(),
                          geometry.bounds.transformed(surface.transform),
                          std::move(pieces),
                          {geometry.number, topology.number, surface.transform, surface.twoSided}});
        const std::size_t number = shapes.size();
        shapes.push_back(result.back().shape);
        result.back().isStill = number < before_.size() && before_[number] == shapes.back();
    }
    before_ = std::move(shapes);
    return result;
}

void MeshCache::draw(const DrawItem& item, GLuint otherVertices) const {
    gl_->BindVertexArray(layout_.id());
    gl_->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, item.indices);
    gl_->BindBuffer(GL_ARRAY_BUFFER, item.vertices);
    gl_->EnableVertexAttribArray(0);
    gl_->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl_->EnableVertexAttribArray(1);
    gl_->VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 0, offset(item.vertexCount * sizeof(glm::vec3)));
    gl_->BindBuffer(GL_ARRAY_BUFFER, item.corners);
    gl_->EnableVertexAttribArray(2);
    gl_->VertexAttribPointer(2, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
    if (otherVertices != 0) {
        gl_->BindBuffer(GL_ARRAY_BUFFER, otherVertices);
        gl_->EnableVertexAttribArray(3);
        gl_->VertexAttribPointer(3, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    }
    gl_->DrawElements(GL_TRIANGLES, item.indexCount, GL_UNSIGNED_INT, nullptr);
}

}  // namespace taut::render
