// A cloth: a grid, a panel with an outline, or a mesh from a file.
#pragma once

#include <string>
#include <vector>

#include "taut/core/value.h"
#include "taut/spec/body_spec.h"
#include "taut/spec/specs.h"

namespace taut::world {

struct ClothHoleSpec {
    std::vector<dvec2> corners;  // [m]
};

// A run of sides of a panel's outline, from one corner on to another.
struct ClothEdgeSpec {
    std::string name;
    ivec2 corners{0, 1};
};

struct ClothSpec final : SpecOf<ClothSpec, BodySpec>, MeshSource {
    TAUT_VALUE(ClothSpec);
    static constexpr const char* kindName = "cloth";
    // A grid …
    dvec2 size{1.0, 1.0};  // [m]
    ivec2 cells{20, 20};
    dvec3 origin{0.0};            // top left corner [m]
    dvec3 across{1.0, 0.0, 0.0};  // direction from left to right
    dvec3 down{0.0, -1.0, 0.0};   // direction from top to bottom
    double grain = 0.0;           // [rad] from across to the warp, towards down
    bool isRound = false;
    // … or a panel, which has origin, across, down and grain of these: the outline lies at
    // origin + x across - y down …
    std::vector<dvec2> corners;  // [m]; empty: it is none
    std::vector<ClothHoleSpec> holes;
    std::vector<ClothEdgeSpec> edges;
    double cell = 0.02;                       // [m] length of its edges, nearly
    std::vector<std::vector<int>> sideEdges;  // of the outline and each hole, see PanelShape; evenSeams() gives them
    // … or a mesh, which has nothing of this.
    dvec3 position{0.0};  // [m]
    dvec3 rotation{0.0};  // [rad] about x, then y, then z
    double scale = 1.0;
    std::string material;  // name of a [material.NAME]

    static fields::Section section();
    mechanics::Model build(const SceneSpec& scene) const override;
    PlasticitySpec plasticityIn(const SceneSpec& scene) const override;
    std::string_view materialName() const override { return material; }
    BodyOutline outline(const SceneSpec& scene) const override;
    std::unique_ptr<BodyDrawing> drawing(const Body& body) const override;
    using BodySpec::meshSource;
    const MeshSource* meshSource() const override { return this; }
    bool isPanel() const { return !corners.empty(); }
    // The edges of a panel that selectors know: the sides of the outline (side0, from corner 0 to corner 1, …), the
    // holes (hole0, …) and the edges with names.
    struct PanelEdge {
        std::string name;
        std::size_t ring;  // 0: the outline
        int from, to;      // corners of the ring; from one to itself: around
    };
    std::vector<PanelEdge> panelEdges() const;
    // Sets meshData to that of a panel, in the coordinates of its outline. Its groups are its edges, each in the order
    // of its corners. The loader calls it; building does it where it was not called. Throws mechanics::PanelFault.
    void meshPanel();

  private:
    mechanics::Model buildSheet(const SceneSpec& scene) const;  // without air
};

}  // namespace taut::world
