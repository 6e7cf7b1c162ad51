// A figure as a collider: where its vertices and joints are at a time, and its surfaces in a picture.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/spec/collider_spec.h"
#include "taut/spec/targets.h"
#include "taut/view/frame_view.h"

namespace taut::world {

class ColliderFigure {
  public:
    // Expects meshData with a figure. Throws core::Error(badContent) for an animation that the file has not.
    explicit ColliderFigure(const ColliderSpec& spec);

    std::span<const std::array<int, 3>> triangles() const { return mesh_->triangles; }
    std::span<const dvec3> atRest() const { return atRest_; }  // (vertices) [m] with the collider at the origin
    // (vertices) The node that moves a vertex most. Limbs have higher numbers than the trunk, children than their
    // parents.
    std::span<const int> ranks() const { return ranks_; }

    // All of it at one time.
    class Moment {
      public:
        const std::vector<dvec3>& places() const { return places_; }  // (vertices) [m]
        // The frame of a joint, or any other node, or of a face; none: there is none.
        std::optional<collision::Pose> frameOf(const ColliderTarget& target) const;
        int nearestFace(const dvec3& x) const;  // the one with the nearest centre

      private:
        friend class ColliderFigure;
        const MeshData* mesh_;
        figure::Posture posture_;
        collision::Pose pose_;
        double scale_;
        std::vector<dvec3> places_;
    };
    // seconds: of the scene; pose: of the collider.
    Moment at(double seconds, const collision::Pose& pose) const;
    // Adds its surfaces.
    void addSurfaces(double seconds, const collision::Pose& pose, std::vector<view::Surface>& surfaces) const;

  private:
    std::string name_;
    std::shared_ptr<const MeshData> mesh_;
    const figure::Animation* animation_ = nullptr;
    double scale_, start_, speed_;
    bool loops_;
    std::vector<dvec3> atRest_;
    std::vector<int> ranks_;
    std::vector<std::shared_ptr<const view::Topology>> topologies_;  // (pieces)
    std::vector<std::shared_ptr<const view::Finish>> finishes_;      // (pieces)
};

}  // namespace taut::world
