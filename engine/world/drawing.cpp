#include "world/drawing.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "view/tube.h"

namespace taut::world {
namespace {

constexpr int tubeSides = 10;
constexpr int tubeSubdivisions = 2;

float linear(double c) { return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4)); }

class RopeDrawing final : public BodyDrawing {
  public:
    explicit RopeDrawing(const Body& body)
        : name_(body.fullName()), radius_(static_cast<float>(body.radius)), finish_(finishOf(body.common.finish)) {
        double length = 0;
        for (const mechanics::Spring& s : body.model.springs)
            if (s.kind == mechanics::SpringKind::structural) length += s.restLength;
        topology_ = std::make_shared<view::Topology>(view::tubeTopology(
            body.model.pointCount(), tubeSubdivisions, tubeSides, static_cast<float>(length), radius_));
    }
    void addSurfaces(std::span<const glm::vec3> positions, std::vector<view::Surface>& surfaces) const override {
        view::Surface surface;
        surface.name = name_;
        surface.topology = topology_;
        surface.geometry = std::make_shared<view::Geometry>(
            view::tubeGeometry(positions, tubeSubdivisions, tubeSides, radius_));
        surface.finish = finish_;
        surfaces.push_back(std::move(surface));
    }

  private:
    std::string name_;
    float radius_;
    std::shared_ptr<const view::Finish> finish_;
    std::shared_ptr<const view::Topology> topology_;
};

// The block's own axes, so that a pattern lies along its edges however it starts.
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
    // The two coordinates along a side, from the positions before anything moves [m].
    glm::vec2 across(const mechanics::Model& model, int point, int side) const {
        const glm::dvec3 x = transpose(axes) * model.positions[static_cast<std::size_t>(point)];
        if (side < 2) return {x.z, x.y};
        if (side < 4) return {x.x, x.z};
        return {x.x, x.y};
    }
    glm::dmat3 axes{1.0};  // columns
};

// Cloth, and the skin of a block. A block's faces get vertices of their own, so that its edges stay edges.
class SkinDrawing final : public BodyDrawing {
  public:
    explicit SkinDrawing(const Body& body)
        : name_(body.fullName()), twoSided_(body.kind == Body::Kind::cloth), finish_(finishOf(body.common.finish)) {
        auto topology = std::make_shared<view::Topology>();
        const BlockAxes axes = twoSided_ ? BlockAxes{} : BlockAxes(body.model);
        std::map<std::pair<int, int>, std::uint32_t> vertexOf;  // (point, side of the block)
        for (const std::array<int, 3>& triangle : body.model.triangles) {
            const int side = twoSided_ ? 0 : sideOf(body.model, triangle);
            for (int point : triangle) {
                const auto [entry, isNew] =
                    vertexOf.try_emplace({point, side}, static_cast<std::uint32_t>(points_.size()));
                if (isNew) {
                    points_.push_back(point);
                    topology->uv.push_back(twoSided_ ? along(body.model, point) : axes.across(body.model, point, side));
                }
                topology->triangles.push_back(entry->second);
            }
        }
        topology_ = topology;
    }

    void addSurfaces(std::span<const glm::vec3> positions, std::vector<view::Surface>& surfaces) const override {
        auto geometry = std::make_shared<view::Geometry>();
        for (int point : points_) geometry->positions.push_back(positions[static_cast<std::size_t>(point)]);
        geometry->normals.resize(points_.size());
        view::smoothNormals(geometry->positions, topology_->triangles, geometry->normals);
        view::Surface surface;
        surface.name = name_;
        surface.topology = topology_;
        surface.geometry = geometry;
        surface.finish = finish_;
        surface.twoSided = twoSided_;
        surfaces.push_back(std::move(surface));
    }

  private:
    // Which of the six sides of a block a triangle lies on, by the groups of its corners.
    static int sideOf(const mechanics::Model& model, const std::array<int, 3>& triangle) {
        static constexpr const char* sides[] = {"left", "right", "bottom", "top", "back", "front"};
        for (int side = 0; side < 6; ++side) {
            const std::vector<int>& group = model.groups.at(sides[side]);
            if (std::all_of(triangle.begin(), triangle.end(),
                            [&](int p) { return std::binary_search(group.begin(), group.end(), p); }))
                return side;
        }
        return 0;
    }
    // Pictures are laid with v upwards; a grid counts it downwards from its top.
    static glm::vec2 along(const mechanics::Model& model, int point) {
        const glm::vec2 uv(model.uv[static_cast<std::size_t>(point)]);
        return model.grid[0] > 0 ? glm::vec2(uv.x, -uv.y) : uv;
    }

    std::string name_;
    bool twoSided_;
    std::shared_ptr<const view::Finish> finish_;
    std::vector<int> points_;  // (vertices) point of the model
    std::shared_ptr<const view::Topology> topology_;
};

// Springs as rods, points as balls.
class NetDrawing final : public BodyDrawing {
  public:
    explicit NetDrawing(const Body& body)
        : name_(body.fullName()), radius_(static_cast<float>(body.radius)), finish_(finishOf(body.common.finish)) {
        for (const mechanics::Spring& s : body.model.springs) {
            rods_.push_back({s.a, s.b});
            rodTopology_.push_back(std::make_shared<view::Topology>(
                view::tubeTopology(2, 1, tubeSides, static_cast<float>(std::max(s.restLength, 1e-3)), radius_)));
        }
        FinishSpec ballFinish = body.common.finish;
        ballFinish.colour = body.common.finish.accent;
        ballFinish.pattern = "plain";
        ballFinish_ = finishOf(ballFinish);
        for (int i = 0; i < body.model.pointCount(); ++i) {
            // Balls grow with the cube root of their mass, so that a heavier one looks it.
            const double size = body.ball * std::cbrt(body.model.masses[static_cast<std::size_t>(i)]);
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
            rod.geometry = std::make_shared<view::Geometry>(view::tubeGeometry(line, 1, tubeSides, radius_));
            rod.finish = finish_;
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

glm::vec3 linearColour(const dvec3& srgb) { return {linear(srgb.x), linear(srgb.y), linear(srgb.z)}; }

std::shared_ptr<const view::Finish> finishOf(const FinishSpec& spec) {
    static constexpr std::pair<const char*, view::Pattern> patterns[] = {{"plain", view::Pattern::plain},
                                                                         {"checker", view::Pattern::checker},
                                                                         {"stripes", view::Pattern::stripes},
                                                                         {"tartan", view::Pattern::tartan},
                                                                         {"image", view::Pattern::image}};
    auto finish = std::make_shared<view::Finish>();
    finish->front = linearColour(spec.colour);
    finish->back = spec.backColour ? linearColour(*spec.backColour) : glm::mix(finish->front, glm::vec3(0.5F), 0.5F);
    finish->accent = linearColour(spec.accent);
    for (const auto& [name, pattern] : patterns)
        if (spec.pattern == name) finish->pattern = pattern;
    finish->repeat = static_cast<float>(spec.repeat);
    finish->weave = static_cast<float>(spec.weave);
    finish->thread = static_cast<float>(spec.thread);
    finish->roughness = static_cast<float>(spec.roughness);
    finish->sheen = static_cast<float>(spec.sheen);
    finish->texture = spec.texture;
    return finish;
}

std::unique_ptr<BodyDrawing> makeDrawing(const Body& body) {
    switch (body.kind) {
        case Body::Kind::rope: return std::make_unique<RopeDrawing>(body);
        case Body::Kind::net: return std::make_unique<NetDrawing>(body);
        case Body::Kind::cloth:
        case Body::Kind::block: break;
    }
    return std::make_unique<SkinDrawing>(body);
}

}  // namespace taut::world
