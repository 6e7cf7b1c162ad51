// Draws the surfaces: first their visible parts, then the light on them, so that each pixel is lit once. Programs are
// made for each kind of finish at its first use.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "taut/render/private/lights.h"
#include "taut/render/private/mesh_cache.h"
#include "taut/render/private/program.h"
#include "taut/render/private/targets.h"
#include "taut/render/private/texture_cache.h"
#include "taut/view/camera_axes.h"

namespace taut::render {

// A pixel's ray: from the eye `first`, 1 m ahead, `right` and `up` from pixel to pixel, in a picture that shows
// everything `shift` [pixels] to the right and up.
struct Rays {
    glm::vec3 first, right, up;
};
Rays raysOf(const view::Camera& camera, glm::ivec2 size, glm::vec2 shift);

// As `firstWay`, `rightWay` and `upWay`. Expects that the program is in use.
void setRays(Program& program, const view::Camera& camera, glm::ivec2 size, glm::vec2 shift);

class SurfacePass {
  public:
    SurfacePass(const Gl& gl, const ShaderFolder& shaders, TextureBudget& budget);

    // Draws the visible parts into the target of surfaces.
    void draw(std::span<const DrawItem> items, const MeshCache& meshes);

    // The light on it, in a part of the shaded picture, which shows everything `shift` [pixels] to the right and up;
    // the frame block and the shadow maps must be in place. `occlusion`: surfaces take light from each other.
    void light(const LightKind& kind, const view::Camera& camera, const PixelBox& part, const Targets& targets,
               glm::vec2 shift, bool occlusion);

    // The table of the drawn surfaces, for shaders that read `materials`.
    void bindMaterials();

  private:
    // The data of a surface for light.frag: a row of its table.
    struct Material {
        glm::vec4 backRoughness;
        glm::vec4 kind;    // sheen, dulled less greyed, translucency, woven
        glm::vec4 fibres;  // anisotropy, fuzz; rest 0
        bool operator==(const Material&) const = default;
    };

    Program& programFor(const view::Surface& surface);
    Program& programUnder(const LightKind& kind);
    int rowOf(const view::Surface& surface);

    const Gl* gl_;
    const ShaderFolder* shaders_;
    TextureCache textures_;
    std::map<std::vector<std::string>, Program> programs_;  // by their definitions
    std::map<LightKind, Program> lights_;
    Program occlusion_;
    std::vector<Material> materials_;
    GlObject materialTexture_, empty_;
};

}  // namespace taut::render
