#include "taut/drawing/drawing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>

#include "taut/core/private/srgb.h"
#include "taut/damage/private/cut_mesh.h"
#include "taut/damage/private/skin_pieces.h"
#include "taut/drawing/private/bound_mesh.h"
#include "taut/view/private/subdivision.h"
#include "taut/view/private/tube.h"

namespace taut::world {
namespace {

constexpr int rodSides = 10;

// The axes of a block. A pattern lies along its edges, however the block starts.
struct BlockAxes {
    BlockAxes() = default;
    explicit BlockAxes(const mechanics::Model& model) {
        const auto centre = [&](const char* group) {
            glm::dvec3 sum(0.0);
            for (int i : model.groups.at(group)) sum += model.positions[static_cast<std::size_t>(i)];
            return sum / static_cast<double>(model.groups.at(group).size());
        };
        static constexpr const char* ends[3][2] = {{"left", "right"}, {"bottom", "top"}, {"back", "front"}};
        for (int a = 0; a < 3; ++a) axes[a] = glm::normalize(centre(ends[a][1]) - centre(ends[a][0]));
    }
    // The two coordinates [m] along a side, of a place before anything moves.
    glm::vec2 across(const glm::dvec3& rest, int side) const {
        const glm::dvec3 x = transpose(axes) * rest;
        if (side < 2) return {x.z, x.y};
        if (side < 4) return {x.x, x.z};
        return {x.x, x.y};
    }
    // The side whose normal is closest to this one.
    int sideLike(const glm::dvec3& normal) const {
        const glm::dvec3 n = glm::abs(transpose(axes) * normal);
        return n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 2 : 4;
    }
    glm::dmat3 axes{1.0};  // columns
};

Skin wholeSkin(const mechanics::Model& model) {
    Skin skin;
    for (int i = 0; i < model.pointCount(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        skin.vertices.push_back({{{i, 1.0F}}, model.positions[k], model.uv[k]});
    }
    for (std::size_t t = 0; t < model.triangles.size(); ++t)
        skin.triangles.push_back({model.triangles[t], static_cast<int>(t)});
    return skin;
}

// The vertices of a mesh file in file order, for users who know them by number; empty if the body is not from a mesh.
std::vector<int> orderInFile(const BodySpec& spec) {
    const MeshSource* source = spec.meshSource();
    if (source == nullptr || source->meshData == nullptr) return {};
    const std::vector<int>& numbers = source->meshData->numbers;
    std::vector<int> order(numbers.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
        return numbers[static_cast<std::size_t>(a)] < numbers[static_cast<std::size_t>(b)];
    });
    return order;
}

// Draws cloth, and the skin of a block. A block's faces have vertices of their own, so that its edges stay sharp.
class SkinDrawing final : public BodyDrawing {
  public:
    // frame: of a block in place of which a mesh is drawn; null: it is none. place: of the mesh.
    SkinDrawing(const Body& body, bool twoSided, const BlockFrame* frame, const MeshPlace& place)
        : body_(body),
          place_(place),
          name_(body.fullName()),
          twoSided_(twoSided),
          hem_(twoSided ? static_cast<float>(body.spec->finish.hem) : 0.0F),
          room_(body.spec->facesMeet() ? shareOfThickness * static_cast<float>(body.spec->thickness)
                                       : std::numeric_limits<float>::infinity()),
          finish_(finishOf(body.spec->finish)) {
        auto topology = std::make_shared<view::Topology>();
        const mechanics::Model& model = body.model;
        const bool isCutMesh = frame != nullptr && !body.damage.isEmpty() && !model.cells.empty();
        const Skin skin = isCutMesh               ? cutMesh(model, body.damage, *frame, placedMesh(body, place, *frame))
                          : body.damage.isEmpty() ? wholeSkin(model)
                                                  : skinOf(model, body.damage);
        const BlockAxes axes = twoSided_ ? BlockAxes{} : BlockAxes(model);
        VertexNumbers vertexOf;
        const auto vertexAt = [&](int v, int side) {
            const SkinVertex& vertex = skin.vertices[static_cast<std::size_t>(v)];
            const auto [entry, isNew] = vertexOf.try_emplace({v, side}, static_cast<std::uint32_t>(points_.size()));
            if (isNew) {
                if (vertex.terms.size() > 1) beyond_.push_back({points_.size(), vertex});
                points_.push_back(vertex.terms.front().point);
                const bool hasOwn = twoSided_ || (isCutMesh && side < sidesOfBlock);
                topology->uv.push_back(hasOwn ? along(model, vertex.uv)
                                              : axes.across(vertex.rest, side % sidesOfBlock));
            }
            return entry->second;
        };
        if (body.damage.isEmpty() && twoSided_)
            for (int v : orderInFile(*body.spec)) vertexAt(v, 0);
        for (const SkinTriangle& triangle : skin.triangles) {
            // The faces of cuts are separate sides.
            const bool isCut = triangle.source < 0;
            const int side = twoSided_   ? 0
                             : isCut     ? sidesOfBlock + axes.sideLike(normalOf(skin, triangle))
                             : isCutMesh ? 0
                                         : sideOf(model, model.triangles[static_cast<std::size_t>(triangle.source)]);
            for (int v : triangle.vertices) topology->triangles.push_back(vertexAt(v, side));
        }
        topology_ = topology;
        addInner(skin, body.spec->finish);
        if (const int levels = body.spec->finish.smooth; twoSided_ && levels > 0)
            refinement_ = refinement(model, skin, vertexOf, topology->triangles, levels);
        // A cut or torn body shows its own surface.
        if (!body.damage.isEmpty()) return;
        if (frame != nullptr) {
            bound_ = std::make_unique<BoundMesh>(body, place_, *frame);
        } else if (twoSided_ && body.spec->finish.skinData != nullptr) {
            bindToSheet();
            isBoundFine_ = refinement_.levels > 0;
        }
    }

    void addSurfaces(std::span<const glm::vec3> positions, std::vector<view::Surface>& surfaces) const override {
        std::call_once(isRefined_, [&] { refine(); });
        view::Geometry geometry;
        if (bound_ && !twoSided_) {
            geometry = bound_->geometry(positions, {});
        } else {
            geometry = sheet(positions);
            if (bound_) geometry = bound_->geometry(geometry.positions, geometry.normals);
        }
        view::Surface surface;
        surface.name = name_;
        surface.topology = bound_ ? bound_->topology() : topology_;
        surface.geometry = std::make_shared<view::Geometry>(std::move(geometry));
        surface.finish = finish_;
        surface.twoSided = twoSided_;
        surface.hem = hem_;
        surfaces.push_back(surface);
        if (inner_ == nullptr) return;
        surfaces.back().topology = outer_;
        surface.topology = inner_;
        surface.finish = innerFinish_;
        surfaces.push_back(std::move(surface));
    }

  private:
    static constexpr int sidesOfBlock = 6;
    // Contact keeps triangles a thickness clear of colliders and two of each other, but for sides of a tight fold,
    // which come nearer: so less than that is room for drawing.
    static constexpr float shareOfThickness = 0.4F;
    using VertexNumbers = std::map<std::pair<int, int>, std::uint32_t>;  // by vertex of the skin, and side of the block

    // A picture is of the outside: faces of cuts have the colour of the back.
    void addInner(const Skin& skin, const FinishSpec& finish) {
        if (finish.pattern != view::Pattern::image) return;
        view::Topology outer{{}, topology_->uv}, inner{{}, topology_->uv};
        for (std::size_t t = 0; t < skin.triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                (skin.triangles[t].source < 0 ? inner : outer).triangles.push_back(topology_->triangles[3 * t + k]);
        if (inner.triangles.empty()) return;
        outer_ = std::make_shared<view::Topology>(std::move(outer));
        inner_ = std::make_shared<view::Topology>(std::move(inner));
        auto plain = std::make_shared<view::Finish>(*finish_);
        plain->pattern = view::Pattern::plain;
        plain->front = plain->back;
        innerFinish_ = std::move(plain);
    }

    // The input of a fine mesh. It is made for the first picture: a run may have none.
    struct Refinement {
        std::vector<view::Face> faces;
        std::vector<glm::dvec3> rest;  // (vertices) [m]
        bool keepsCorners = true;
        int levels = 0;
    };

    // The cells of a grid are smoothed as such: their diagonals would show.
    static Refinement refinement(const mechanics::Model& model, const Skin& skin, const VertexNumbers& vertexOf,
                                 std::span<const std::uint32_t> triangles, int levels) {
        std::vector<glm::dvec3> rest(vertexOf.size());
        for (const auto& [key, number] : vertexOf)
            rest[number] = skin.vertices[static_cast<std::size_t>(key.first)].rest;
        std::vector<view::Face> faces;
        for (std::size_t t = 0; t < triangles.size(); t += 3) {
            const std::uint32_t a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
            if (model.grid[0] > 0 && !faces.empty() && faces.back()[3] == view::noVertex && faces.back()[0] == a &&
                faces.back()[2] == b)
                faces.back()[3] = c;
            else
                faces.push_back({a, b, c, view::noVertex});
        }
        // A round grid, which leaves points out, has steps on its border.
        const bool hasSteps = model.grid[0] > 0 && static_cast<int>(model.groups.at("all").size()) < model.pointCount();
        return {std::move(faces), std::move(rest), !hasSteps, levels};
    }
    void refine() const {
        if (refinement_.levels == 0) return;
        std::vector<std::uint32_t> kept;
        for (std::size_t v = 0; v < points_.size(); ++v)
            if (std::binary_search(body_.seamCorners.begin(), body_.seamCorners.end(), points_[v]))
                kept.push_back(static_cast<std::uint32_t>(v));
        fine_ =
            view::subdivided(refinement_.faces, refinement_.rest, refinement_.keepsCorners, refinement_.levels, kept);
        topology_ = std::make_shared<view::Topology>(view::Topology{fine_->triangles, fine_->spread(topology_->uv)});
        if (isBoundFine_) bindToSheet();
    }
    void bindToSheet() const {
        bound_ = std::make_unique<BoundMesh>(body_, place_, topology_->triangles, sheet(startOf(body_)), topology_->uv);
    }

    // The surface that points make of the triangles, or finer.
    view::Geometry sheet(std::span<const glm::vec3> positions) const {
        view::Geometry geometry;
        for (int point : points_) geometry.positions.push_back(positions[static_cast<std::size_t>(point)]);
        for (const auto& [vertex, terms] : beyond_) geometry.positions[vertex] = terms.at(positions);
        if (fine_) return fine_->geometry(geometry.positions, room_);
        geometry.normals.resize(points_.size());
        view::smoothNormals(geometry.positions, topology_->triangles, geometry.normals);
        return geometry;
    }

    static glm::dvec3 normalOf(const Skin& skin, const SkinTriangle& triangle) {
        const auto at = [&](std::size_t i) {
            return skin.vertices[static_cast<std::size_t>(triangle.vertices[i])].rest;
        };
        return glm::cross(at(1) - at(0), at(2) - at(0));
    }
    // The side of a block that a triangle lies on, found from the groups of its corners.
    static int sideOf(const mechanics::Model& model, const std::array<int, 3>& triangle) {
        static constexpr const char* sides[] = {"left", "right", "bottom", "top", "back", "front"};
        for (int side = 0; side < sidesOfBlock; ++side) {
            const std::vector<int>& group = model.groups.at(sides[side]);
            if (std::all_of(triangle.begin(), triangle.end(),
                            [&](int p) { return std::binary_search(group.begin(), group.end(), p); }))
                return side;
        }
        return 0;
    }
    // Pictures count v upwards; a grid counts it downwards from its top.
    static glm::vec2 along(const mechanics::Model& model, const glm::dvec2& material) {
        const glm::vec2 uv(material);
        return model.grid[0] > 0 ? glm::vec2(uv.x, -uv.y) : uv;
    }

    const Body& body_;
    MeshPlace place_;
    std::string name_;
    bool twoSided_;
    float hem_;   // [m]
    float room_;  // [m] how far a smooth sheet may go from its triangles
    std::shared_ptr<const view::Finish> finish_, innerFinish_;
    std::shared_ptr<const view::Topology> outer_, inner_;     // null: all has one finish
    std::vector<int> points_;                                 // (vertices) their points of the model
    std::vector<std::pair<std::size_t, SkinVertex>> beyond_;  // vertices at a cut, beyond all points
    Refinement refinement_;                                   // of a sheet that is smoothed
    mutable std::once_flag isRefined_;
    mutable std::optional<view::FineMesh> fine_;
    mutable std::shared_ptr<const view::Topology> topology_;
    mutable std::unique_ptr<BoundMesh> bound_;  // drawn in its place; null: nothing
    bool isBoundFine_ = false;                  // once the sheet is refined
};

// Draws springs as rods and points as balls.
class RodDrawing final : public BodyDrawing {
  public:
    RodDrawing(const Body& body, double radius, double ball)
        : name_(body.fullName()), radius_(static_cast<float>(radius)), finish_(finishOf(body.spec->finish)) {
        for (const mechanics::Spring& s : body.model.springs) {
            if (body.damage.isSevered(s.a, s.b)) continue;
            rods_.push_back({s.a, s.b});
            rodTopology_.push_back(std::make_shared<view::Topology>(
                view::tubeTopology(2, 1, rodSides, static_cast<float>(std::max(s.restLength, 1e-3)), radius_)));
        }
        FinishSpec ballFinish = body.spec->finish;
        ballFinish.colour = body.spec->finish.accent;
        ballFinish.pattern = view::Pattern::plain;
        ballFinish_ = finishOf(ballFinish);
        for (int i = 0; ball > 0 && i < body.model.pointCount(); ++i) {
            // Balls grow with the cube root of their mass, so that a heavier point looks heavier.
            const double size = ball * std::cbrt(body.model.masses[static_cast<std::size_t>(i)]);
            balls_.push_back(view::sphereMesh(static_cast<float>(size)));
        }
    }
    void addSurfaces(std::span<const glm::vec3> positions, std::vector<view::Surface>& surfaces) const override {
        for (std::size_t i = 0; i < rods_.size(); ++i) {
            const std::array<glm::vec3, 2> line{positions[static_cast<std::size_t>(rods_[i].first)],
                                                positions[static_cast<std::size_t>(rods_[i].second)]};
            view::Surface rod;
            rod.name = name_;
            rod.topology = rodTopology_[i];
            rod.geometry = std::make_shared<view::Geometry>(view::tubeGeometry(line, 1, rodSides, radius_));
            rod.finish = finish_;
            rod.tubeRadius = radius_;
            surfaces.push_back(std::move(rod));
        }
        for (std::size_t i = 0; i < balls_.size(); ++i) {
            view::Surface ball;
            ball.name = name_;
            ball.topology = balls_[i].topology;
            ball.geometry = balls_[i].geometry;
            ball.finish = ballFinish_;
            ball.transform[3] = glm::vec4(positions[i], 1.0F);
            surfaces.push_back(std::move(ball));
        }
    }

  private:
    std::string name_;
    float radius_;
    std::shared_ptr<const view::Finish> finish_, ballFinish_;
    std::vector<std::pair<int, int>> rods_;
    std::vector<std::shared_ptr<const view::Topology>> rodTopology_;
    std::vector<view::Mesh> balls_;
};

}  // namespace

glm::vec3 linearColour(const dvec3& srgb) {
    return glm::vec3(dvec3(core::lightOf(srgb.x), core::lightOf(srgb.y), core::lightOf(srgb.z)));
}

std::shared_ptr<const view::Finish> finishOf(const FinishSpec& spec) {
    auto finish = std::make_shared<view::Finish>();
    finish->front = linearColour(spec.colour);
    finish->back = spec.backColour ? linearColour(*spec.backColour) : glm::mix(finish->front, glm::vec3(0.5F), 0.5F);
    finish->accent = linearColour(spec.accent);
    finish->pattern = spec.pattern;
    finish->repeat = static_cast<float>(spec.repeat);
    finish->weave = static_cast<float>(spec.weave);
    finish->binding = spec.binding;
    finish->thread = static_cast<float>(spec.thread);
    finish->slub = static_cast<float>(spec.slub);
    finish->fuzz = static_cast<float>(spec.fuzz);
    finish->roughness = static_cast<float>(spec.roughness);
    finish->sheen = static_cast<float>(spec.sheen);
    finish->translucency = static_cast<float>(spec.translucency);
    finish->anisotropy = static_cast<float>(spec.anisotropy);
    finish->texture = spec.texture;
    return finish;
}

std::unique_ptr<BodyDrawing> sheetDrawing(const Body& body, const MeshPlace& skin) {
    return std::make_unique<SkinDrawing>(body, true, nullptr, skin);
}

std::unique_ptr<BodyDrawing> rodDrawing(const Body& body, double radius, double ball) {
    return std::make_unique<RodDrawing>(body, radius, ball);
}

std::unique_ptr<BodyDrawing> sidedDrawing(const Body& body) {
    return std::make_unique<SkinDrawing>(body, false, nullptr, MeshPlace());
}

std::unique_ptr<BodyDrawing> sidedDrawing(const Body& body, const BlockFrame& frame, const MeshPlace& mesh) {
    return std::make_unique<SkinDrawing>(body, false, &frame, mesh);
}

}  // namespace taut::world
