// A figure as a collider: where its vertices and joints are at a time, and what is drawn of it.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/spec/collider_spec.h"
#include "taut/view/frame_view.h"

namespace taut::world {

class ColliderFigure {
  public:
    // Expects meshData with a figure. Throws core::Error(badContent) for an animation that the file has not.
    explicit ColliderFigure(const ColliderSpec& spec);

    std::span<const std::array<int, 3>> triangles() const { return mesh_->triangles; }
    std::span<const dvec3> atRest() const { return atRest_; }  // (vertices) [m] with the collider at the origin
    // (vertices) [m] at a time [s], with the collider at `pose`.
    std::vector<dvec3> placesAt(double seconds, const collision::Pose& pose) const;
    // The frame of a joint, or of any other node; none: it has no node of that name.
    std::optional<collision::Pose> jointAt(std::string_view node, double seconds, const collision::Pose& pose) const;
    // Adds what is drawn.
    void addSurfaces(double seconds, const collision::Pose& pose, std::vector<view::Surface>& surfaces) const;

  private:
    figure::Posture postureAt(double seconds) const;

    std::string name_;
    std::shared_ptr<const MeshData> mesh_;
    const figure::Animation* animation_ = nullptr;
    double scale_, start_, speed_;
    bool loops_;
    std::vector<dvec3> atRest_;
    std::vector<std::shared_ptr<const view::Topology>> topologies_;  // (pieces)
    std::vector<std::shared_ptr<const view::Finish>> finishes_;      // (pieces)
};

}  // namespace taut::world
