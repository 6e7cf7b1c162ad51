// Draws the shadow map and what makes reading it cheap. It does not know how shadows are shaded.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "taut/render/light_box.h"
#include "taut/render/map_target.h"
#include "taut/render/mesh_cache.h"
#include "taut/render/program.h"

namespace taut::render {

inline constexpr int boundsEdge = 128;  // [texels] edge of the map of bounds: as many blocks as it divides the map into

class ShadowPass {
  public:
    ShadowPass(const Gl& gl, const ShaderFolder& shaders, int texels);

    // The depth of what is still in the same box is drawn once and kept, unless `anew`.
    void draw(std::span<const DrawItem> items, const MeshCache& meshes, const LightBox& box, bool anew);

    // Binds the maps to their texture units.
    void bindMaps() const;

  private:
    void drawDepth(std::span<const DrawItem* const> items, const MeshCache& meshes, const LightBox& box);
    bool keep(std::span<const DrawItem* const> still, const MeshCache& meshes, const LightBox& box);
    void drawBounds();

    const Gl* gl_;
    Program depth_, reduce_, spread_;
    MapTarget map_;                   // depth seen from the light
    MapTarget blocks_;                // least and largest depth of each block of texels
    MapTarget neighbourhood_;         // the same over each block and those around it
    std::optional<MapTarget> still_;  // depth of what is still, as soon as there is some
    std::vector<Shape> stillShapes_;  // in it, or to be in it next time
    glm::mat4 stillBox_{0.0F};        // its toMap
    bool isKept_ = false;
    GlObject comparing_;  // a sampler that compares
    GlObject empty_;      // vertex array of passes without vertices
};

}  // namespace taut::render
