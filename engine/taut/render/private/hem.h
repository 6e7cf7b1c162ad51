// Cloth that is seen so close that its thickness shows: towards its free edges, and those of tears, its two sides part,
// and a round rim joins them; not where edges of two cloths are in one place, for there they are sewn. Pure geometry,
// it knows no GL.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "taut/render/private/light_box.h"
#include "taut/render/private/mesh_cache.h"
#include "taut/render/private/thin_tubes.h"
#include "taut/view/frame_view.h"

namespace taut::render {

class Hems {
  public:
    // Puts items with rims in place of those without and returns their surfaces, which the items point to.
    std::vector<view::Surface> addTo(std::vector<DrawItem>& items, const PixelScale& scale, MeshCache& meshes);

  private:
    // The constant part of a rim.
    struct Plan {
        std::weak_ptr<const view::Topology> owner;
        float hem = 0.0F;                                 // [m]
        std::vector<std::array<std::uint32_t, 2>> edges;  // free, with the cloth to their left: numbers in `border`
        std::vector<std::uint32_t> border;                // vertices on them
        std::shared_ptr<const view::Topology> topology;   // of the surface with its rim
    };

    struct Rim {
        DrawItem* item;
        const Plan* plan;
        std::vector<glm::vec3> places;  // (border) [m]
        std::vector<float> radius;      // (border) [m]
    };

    // Nothing where there is none or it would be seen thinner than a pixel. From there to a pixel and a half it grows.
    std::optional<Rim> rimOf(DrawItem& item, const PixelScale& scale);
    static void leaveOutSeams(std::vector<Rim>& rims);
    static std::shared_ptr<const view::Geometry> shapeOf(const view::Geometry& plain, const Plan& own,
                                                         const std::vector<float>& radius);
    const Plan& plan(const view::Surface& surface);

    std::map<const view::Topology*, Plan> plans_;
};

}  // namespace taut::render
