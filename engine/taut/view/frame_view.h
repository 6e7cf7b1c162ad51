// One picture as plain data: camera, light, float meshes. It knows neither the physics nor the renderer.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "taut/core/value.h"

namespace taut::view {

// All colours are linear RGB, 1 is white paper in full light. Lengths in metres, angles in radians, y up.

enum class Pattern { plain, checker, stripes, tartan, image };
enum class Binding { plain, twill, satin, rib, knit };

// How a surface looks.
struct Finish {
    glm::vec3 front{0.8F};
    glm::vec3 back{0.8F};    // the other side of a cloth
    glm::vec3 accent{0.2F};  // second colour of a pattern
    Pattern pattern = Pattern::plain;
    float repeat = 0.2F;  // [m] length after which a pattern repeats along uv
    float weave = 0.0F;   // strength of the weave normal, 0 (smooth) … 1 (coarse linen)
    Binding binding = Binding::plain;
    float thread = 0.0015F;     // [m] distance between two threads of the weave
    float slub = 0.0F;          // unevenness of the threads, 0 … 1
    float fuzz = 0.0F;          // fibres that stand up from the surface, 0 … 1
    float roughness = 0.7F;     // 0 mirror … 1 chalk
    float sheen = 0.0F;         // bright rim of fabric, 0 … 1
    float translucency = 0.2F;  // share of the light on the other side of a cloth that comes through, in its colour
    float anisotropy = 0.0F;  // how far the threads of the warp spread the gloss across them, in their colour, 0 … 1
    std::string texture;      // path of a PNG or JPEG when pattern is image; spans one repeat
    bool operator==(const Finish&) const = default;
};

// The constant part of a surface: drawn by index, shared by all frames.
struct Topology {
    std::vector<std::uint32_t> triangles;  // (3 · triangles) counter-clockwise seen from the front
    std::vector<glm::vec2> uv;             // (vertices) [m] along the material
};

struct Geometry {
    std::vector<glm::vec3> positions;  // (vertices) [m]
    std::vector<glm::vec3> normals;    // (vertices) unit
};

// A new pointer marks new data: a renderer may keep uploaded data of a pointer that it has seen before.
struct Surface {
    std::string name;
    std::shared_ptr<const Topology> topology;
    std::shared_ptr<const Geometry> geometry;
    std::shared_ptr<const Finish> finish;
    glm::mat4 transform{1.0F};
    bool twoSided = false;  // a cloth; anything else is closed, or is seen and lit from its front only
    float tubeRadius =
        0.0F;  // [m] of a rope or rod as tubeGeometry makes it: it is never drawn thinner than a pixel; 0: other
    float hem = 0.0F;     // [m] thickness of a cloth as its free edges show it, seen close
    float dulled = 0.0F;  // 0 … 1: blend towards a dull red, for stopped bodies
    float greyed = 0.0F;  // 0 … 1: blend towards grey, for sleeping bodies; of a surface that is not dulled
};

struct Camera {
    glm::vec3 eye{0.0F, 1.5F, 5.0F};     // [m]
    glm::vec3 target{0.0F, 1.0F, 0.0F};  // [m]
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    float fieldOfView = 0.7F;  // [rad] vertical in pictures of 16:9 and wider: verticalField()
    float nearPlane = 0.05F;   // [m]
    float farPlane = 200.0F;   // [m]
    float lensRadius = 0.0F;   // [m] of a thin lens; 0: all is sharp
    float focus = 5.0F;        // [m] ahead, where things are sharp under a lens
};

struct Light {
    glm::vec3 direction{-0.4F, -1.0F, -0.3F};  // the way the light travels
    glm::vec3 colour{3.0F, 2.73F, 2.36F};      // radiance times intensity
    glm::vec3 sky{0.2F, 0.27F, 0.38F};         // ambient light from above
    glm::vec3 ground{0.13F, 0.12F, 0.1F};      // ambient light from below
    float softness = 0.03F;                    // [rad] apparent size of the light: width of the penumbra
};

// A picture of all that is around, far away: light from everywhere, in place of that of the sky and the ground.
struct Environment {
    std::string
        picture;  // path of an equirectangular Radiance HDR, PNG or JPEG; its middle lies at -z, its right at +x
    float strength = 1.0F;  // factor on its light
    float turn = 0.0F;      // [rad] about y
    bool isShown = true;    // behind everything, in place of the background
    bool operator==(const Environment&) const = default;
};

// A light beside the sun and as far away; at most mostLamps of them.
struct Lamp {
    std::string name;
    glm::vec3 direction{0.5F, -1.0F, 0.4F};  // the way the light travels
    glm::vec3 colour{1.0F};                  // radiance times intensity
    float softness = 0.03F;                  // [rad] apparent size
    bool shadow = true;                      // whether things throw shadows in it
};
inline constexpr std::size_t mostLamps = 2;

struct Background {
    glm::vec3 top{0.051F, 0.084F, 0.163F};
    glm::vec3 horizon{0.319F, 0.367F, 0.448F};
    float fadeStart = 8.0F;       // [m] from the camera target, where the ground begins to fade into the horizon
    float fadeEnd = 30.0F;        // [m]
    bool fadesWithCamera = true;  // both grow where the camera is so far from its target that little ground would show
};

// The endless floor, drawn when a scene has a level plane.
struct Ground {
    float height = 0.0F;  // [m]
    glm::vec3 colour{0.5F, 0.49F, 0.47F};
    float gridSpacing = 1.0F;               // [m] thin lines; 0 is none
    std::shared_ptr<const Finish> pattern;  // along x and -z, in place of colour and lines; null: none
};

// The debug view: lines (springs coloured by strain) and dots (points, contacts), drawn over the picture.
struct Marks {
    struct Line {
        glm::vec3 from, to, colour;
    };
    struct Dot {
        glm::vec3 at, colour;
        float radius;  // [px at 720p]
    };
    std::vector<Line> lines;
    std::vector<Dot> dots;
};

enum class Align { left, centre, right };

// A line of text over the picture, at a place of the world or of the screen.
struct Label {
    std::string text;              // UTF-8
    std::optional<glm::vec3> at;   // [m] seen through the camera; none: `screen` counts
    glm::vec2 screen{0.5F, 0.5F};  // from the top left, as shares of width and height
    glm::vec2 shift{0.0F};         // [picture heights] from there to the right and down
    Align align = Align::centre;   // alignment of the text's base line at its place
    float size = 0.035F;           // [picture heights] of the type
    glm::vec3 colour{1.0F};        // of the letters; they have a dark rim
    float plate = 0.0F;            // darkness of a plate behind the text, 0 (none) … 1
};

// Expects of every surface topology, geometry and finish, and as many uv, positions and normals; mostLamps at most.
struct FrameView {
    TAUT_VALUE(FrameView);
    std::int64_t frame = 0;
    double time = 0.0;  // [s]
    Camera camera;
    Light light;
    std::optional<Environment> environment;
    std::vector<Lamp> lamps;
    Background background;
    std::optional<Ground> ground;
    std::vector<Surface> surfaces;
    Marks marks;
    std::vector<Label> labels;
    bool showMarks = false;  // debug view: marks drawn, surfaces faded

    // How all of it is at moments while the shutter is open, evenly spaced; the picture is their mean. Their labels do
    // not count. Empty: it is open for no time.
    std::vector<FrameView> moments;

    // The view of the next frame, for layers that show motion; null: they do not know it.
    std::shared_ptr<const FrameView> next;
};

}  // namespace taut::view
