// A cloth: a grid, or a mesh from a file.
#pragma once

#include "taut/spec/body_spec.h"
#include "taut/spec/specs.h"

namespace taut::world {

struct ClothSpec final : SpecOf<ClothSpec, BodySpec>, MeshSource {
    static constexpr const char* kindName = "cloth";
    // A grid …
    dvec2 size{1.0, 1.0};  // [m]
    ivec2 cells{20, 20};
    dvec3 origin{0.0};            // top left corner [m]
    dvec3 across{1.0, 0.0, 0.0};  // direction from left to right
    dvec3 down{0.0, -1.0, 0.0};   // direction from top to bottom
    double grain = 0.0;           // [rad] from across to the warp, towards down
    bool isRound = false;
    // … or a mesh, which excludes the six fields above.
    dvec3 position{0.0};  // [m]
    dvec3 rotation{0.0};  // [rad] about x, then y, then z
    double scale = 1.0;
    std::string material;  // name of a [material.NAME]

    static fields::Section section();
    mechanics::Model build(const SceneSpec& scene) const override;
    PlasticitySpec plasticityIn(const SceneSpec& scene) const override;
    std::string_view materialName() const override { return material; }
    BodyOutline outline(const SceneSpec& scene) const override;
    using BodySpec::meshSource;
    const MeshSource* meshSource() const override { return this; }

  private:
    mechanics::Model buildSheet(const SceneSpec& scene) const;  // without air
};

}  // namespace taut::world
