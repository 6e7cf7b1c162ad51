#include "taut/drawing/collider_figure.h"

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/drawing/drawing.h"

namespace taut::world {
namespace {

// [m] in the world, of places in the file's unit.
struct Placing {
    glm::dmat3 turn;
    dvec3 position;
    Placing(const collision::Pose& pose, double scale)
        : turn(scale * glm::mat3_cast(glm::normalize(pose.rotation))), position(pose.position) {}
    dvec3 operator()(const dvec3& x) const { return turn * x + position; }
};

dvec3 unitOf(const dvec3& v) {
    const double size = std::sqrt(glm::dot(v, v));
    return size > 0 ? v / size : dvec3(0.0);
}

// Of axes at right angles; a part without them, such as a face without area, is not turned.
glm::dquat turnOf(const glm::dmat3& axes) {
    return glm::dot(axes[0], axes[0]) > 0 && glm::dot(axes[2], axes[2]) > 0 ? glm::normalize(glm::quat_cast(axes))
                                                                            : glm::dquat(1, 0, 0, 0);
}

// The node with the largest weight.
int mainNodeOf(const figure::Figure& figure, const figure::Part& part, std::size_t vertex) {
    if (part.skin < 0) return part.node;
    const auto first = part.influences.begin() + static_cast<std::ptrdiff_t>(part.firstInfluence[vertex]);
    const auto last = part.influences.begin() + static_cast<std::ptrdiff_t>(part.firstInfluence[vertex + 1]);
    const auto most = std::max_element(first, last, [](const auto& a, const auto& b) { return a.weight < b.weight; });
    return figure.skins[static_cast<std::size_t>(part.skin)].joints[static_cast<std::size_t>(most->joint)];
}

// The colours of the file, where the scene gives none.
std::shared_ptr<const view::Finish> finishOf(const figure::Piece& piece, const ColliderSpec& spec) {
    if (spec.ownFinish) return finishOf(*spec.ownFinish);
    view::Finish finish = *finishOf(spec.finish);
    finish.front = glm::vec3(piece.colour);
    finish.back = glm::mix(finish.front, glm::vec3(0.5F), 0.5F);
    finish.roughness = static_cast<float>(piece.roughness);
    if (!piece.texture.empty()) {
        finish.pattern = view::Pattern::image;
        finish.texture = piece.texture;
        finish.repeat = 1.0F;
    }
    return std::make_shared<const view::Finish>(finish);
}

}  // namespace

ColliderFigure::ColliderFigure(const ColliderSpec& spec)
    : name_(spec.name),
      mesh_(spec.meshData),
      scale_(spec.scale),
      start_(spec.start),
      speed_(spec.speed),
      loops_(spec.loops) {
    const figure::Figure& figure = *mesh_->figure;
    if (!spec.animation.empty()) {
        animation_ = figure.find(spec.animation);
        if (animation_ == nullptr) {
            std::string names;
            for (const figure::Animation& other : figure.animations)
                names += (names.empty() ? "" : ", ") + ("\"" + other.name + "\"");
            throw core::Error(core::ErrorKind::badContent, spec.mesh + " has no animation \"" + spec.animation +
                                                               "\"; " +
                                                               (names.empty() ? "it has none" : "it has " + names));
        }
    }
    for (const dvec3& x : mesh_->positions) atRest_.push_back(scale_ * x);
    for (const figure::Part& part : figure.parts)
        for (std::size_t i = 0; i < part.positions.size(); ++i) ranks_.push_back(mainNodeOf(figure, part, i));
    for (const figure::Piece& piece : figure.pieces) {
        topologies_.push_back(std::make_shared<const view::Topology>(view::Topology{piece.triangles, piece.uv}));
        finishes_.push_back(finishOf(piece, spec));
    }
}

ColliderFigure::Moment ColliderFigure::at(double seconds, const collision::Pose& pose) const {
    double t = start_ + speed_ * seconds;
    const bool waits = t < 0 && speed_ > 0;
    if (animation_ != nullptr && loops_ && !waits && animation_->seconds > 0)
        t -= animation_->seconds * std::floor(t / animation_->seconds);
    Moment moment;
    moment.mesh_ = mesh_.get();
    moment.posture_ = figure::postureAt(*mesh_->figure, animation_, t);
    moment.pose_ = pose;
    moment.scale_ = scale_;
    moment.places_.resize(mesh_->positions.size());
    figure::placeVertices(*mesh_->figure, moment.posture_, moment.places_);
    const Placing place(pose, scale_);
    for (dvec3& x : moment.places_) x = place(x);
    return moment;
}

std::optional<collision::Pose> ColliderFigure::Moment::frameOf(const ColliderTarget& target) const {
    if (target.face >= 0) {
        if (target.face >= std::ssize(mesh_->triangles)) return std::nullopt;
        const std::array<int, 3>& t = mesh_->triangles[static_cast<std::size_t>(target.face)];
        const auto corner = [&](std::size_t k) { return places_[static_cast<std::size_t>(t[k])]; };
        const dvec3 along = unitOf(corner(1) - corner(0));
        const dvec3 normal = unitOf(glm::cross(along, corner(2) - corner(0)));
        return collision::Pose{corner(0), turnOf({along, glm::cross(normal, along), normal})};
    }
    const int number = mesh_->figure->nodeNamed(target.joint);
    if (number < 0) return std::nullopt;
    const glm::dmat4& world = posture_.world[static_cast<std::size_t>(number)];
    return collision::Pose{Placing(pose_, scale_)(dvec3(world[3])),
                           glm::normalize(pose_.rotation) *
                               turnOf({unitOf(dvec3(world[0])), unitOf(dvec3(world[1])), unitOf(dvec3(world[2]))})};
}

int ColliderFigure::Moment::nearestFace(const dvec3& x) const {
    int nearest = 0;
    double least = HUGE_VAL;
    for (std::size_t f = 0; f < mesh_->triangles.size(); ++f) {
        dvec3 way = -x;
        for (const int i : mesh_->triangles[f]) way += places_[static_cast<std::size_t>(i)] / 3.0;
        if (glm::dot(way, way) < least) nearest = static_cast<int>(f);
        least = std::min(least, glm::dot(way, way));
    }
    return nearest;
}

void ColliderFigure::addSurfaces(double seconds, const collision::Pose& pose,
                                 std::vector<view::Surface>& surfaces) const {
    const std::vector<dvec3> places = at(seconds, pose).places();
    const figure::Figure& figure = *mesh_->figure;
    // Area-weighted normals of vertices that share one.
    std::vector<glm::vec3> normals(static_cast<std::size_t>(figure.smoothCount), glm::vec3(0.0F));
    for (const figure::Piece& piece : figure.pieces)
        for (std::size_t i = 0; i < piece.triangles.size(); i += 3) {
            std::array<dvec3, 3> x;
            for (std::size_t k = 0; k < 3; ++k)
                x[k] = places[static_cast<std::size_t>(piece.vertices[piece.triangles[i + k]])];
            const glm::vec3 area(glm::cross(x[1] - x[0], x[2] - x[0]));
            for (std::size_t k = 0; k < 3; ++k)
                normals[static_cast<std::size_t>(piece.smooth[piece.triangles[i + k]])] += area;
        }
    for (glm::vec3& n : normals) {
        const float size = glm::length(n);
        n = size > 0.0F ? n / size : glm::vec3(0.0F, 1.0F, 0.0F);
    }
    for (std::size_t p = 0; p < figure.pieces.size(); ++p) {
        const figure::Piece& piece = figure.pieces[p];
        auto geometry = std::make_shared<view::Geometry>();
        for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
            geometry->positions.emplace_back(places[static_cast<std::size_t>(piece.vertices[i])]);
            geometry->normals.push_back(normals[static_cast<std::size_t>(piece.smooth[i])]);
        }
        surfaces.push_back({name_, topologies_[p], std::move(geometry), finishes_[p]});
    }
}

}  // namespace taut::world
