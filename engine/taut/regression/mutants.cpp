#include "taut/regression/mutants.h"

#include <cmath>

#include "taut/bodies/cloth.h"
#include "taut/bodies/net.h"
#include "taut/scene/private/by_key.h"
#include "taut/spec/actions.h"
#include "taut/view/camera_axes.h"

namespace taut::regression {
namespace {

using Islands = std::vector<world::IslandInfo>;

// Of the body itself, or of its first copy when it is an array.
bool isOf(const std::string& name, const std::string& body) {
    return name == body || name.starts_with(body + ".");
}

// Each island with half as many steps a tick; one that takes a single step, which cannot be longer, with two.
std::optional<world::SceneSpec> withOtherStep(world::SceneSpec spec, const Islands& islands) {
    bool changed = false;
    for (world::BodySpec& body : spec.bodies) {
        for (const world::IslandInfo& island : islands)
            for (const std::string& name : island.bodies) {
                if (!isOf(name, body.fullName())) continue;
                // A hundredth of leeway: the step is the tick over a whole number, and rounding decides which.
                body.solver.dt = (island.substeps > 1 ? 2.0 : 0.5) * island.step * 1.01;
                changed = true;
            }
    }
    return changed ? std::optional(std::move(spec)) : std::nullopt;
}

std::optional<world::SceneSpec> withLessDamping(world::SceneSpec spec, const Islands&) {
    bool changed = false;
    constexpr std::string_view losses[] = {"damping_time_s", "drag_per_s"};
    scene::eachNumber(spec, "", losses, [&](double& value) {
        changed = changed || value > 0.0;
        value *= 0.8;
    });
    return changed ? std::optional(std::move(spec)) : std::nullopt;
}

// The last one of a net; of a grid cloth the spring across the middle of a thread near its middle, at the start.
std::optional<world::SceneSpec> withoutOneSpring(world::SceneSpec spec, const Islands&) {
    for (world::NetSpec& net : spec.bodies.of<world::NetSpec>())
        if (net.springs.size() > 1) {
            net.springs.pop_back();
            return spec;
        }
    for (const world::ClothSpec& cloth : spec.bodies.of<world::ClothSpec>()) {
        if (cloth.meshData || !cloth.mesh.empty()) continue;
        const glm::dvec2 cell = 1.0 / glm::dvec2(cloth.cells);
        const glm::dvec2 corner = glm::floor(glm::dvec2(cloth.cells) * 0.5) * cell;
        world::CutAction cut;
        cut.target = cloth.fullName();
        if (cloth.array.count != world::ivec3{1, 1, 1}) cut.target += ".0";
        // Across the thread that leaves the corner to the right, far shorter than a cell.
        cut.from = corner + cell * glm::dvec2(0.5, -0.05);
        cut.upTo = corner + cell * glm::dvec2(0.5, 0.05);
        world::Specs<world::ActionSpec> actions(cut);
        for (const world::ActionSpec& action : spec.actions) actions.add(action.copy());
        spec.actions = std::move(actions);
        return spec;
    }
    return std::nullopt;
}

// Turned about the eye by the angle of one pixel in the middle of the picture.
void turnByOnePixel(view::FrameView& view, glm::ivec2 size) {
    const glm::vec3 ahead = view.camera.target - view.camera.eye;
    const glm::vec3 right = glm::normalize(glm::cross(ahead, view.camera.up));
    const float pixel = 2.0F * std::tan(0.5F * verticalField(view.camera, size)) / static_cast<float>(size.y);
    view.camera.target += right * (glm::length(ahead) * pixel);
}

// Too weak for any pixel to count alone in most pictures.
constexpr float dimmed = 0.98F;
void dimSun(view::FrameView& view, glm::ivec2) {
    view.light.colour *= dimmed;
}
void dimSurroundings(view::FrameView& view, glm::ivec2) {
    for (glm::vec3* light : {&view.light.sky, &view.light.ground}) *light *= dimmed;
    if (view.environment) view.environment->strength *= dimmed;
}
template <std::size_t number>
void dimLamp(view::FrameView& view, glm::ivec2) {
    if (number < view.lamps.size()) view.lamps[number].colour *= dimmed;
}
static_assert(view::mostLamps == 2);

void widenPenumbra(view::FrameView& view, glm::ivec2) {
    view.light.softness *= 1.5F;
}

}  // namespace

std::vector<Mutant> mutants() {
    return {
        {.name = "dt × 2", .ofScene = withOtherStep},
        {.name = "damping − 20 %", .ofScene = withLessDamping},
        {.name = "one spring missing", .ofScene = withoutOneSpring},
        {.name = "camera one pixel off", .ofView = turnByOnePixel},
        {.name = "sun − 2 %", .ofView = dimSun},
        {.name = "surroundings − 2 %", .ofView = dimSurroundings},
        {.name = "first lamp − 2 %", .ofView = dimLamp<0>},
        {.name = "second lamp − 2 %", .ofView = dimLamp<1>},
        {.name = "penumbra + 50 %", .ofView = widenPenumbra},
        {.name = "shadow off", .withoutShadows = true},
    };
}

}  // namespace taut::regression
