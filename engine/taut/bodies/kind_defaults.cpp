// Default behaviour of kinds of bodies.
#include "taut/body/body.h"
#include "taut/body/private/solid_places.h"
#include "taut/drawing/drawing.h"

namespace taut::world {

TAUT_BASE_MEMBERS(BodySpec);

std::vector<RigidPiece> BodySpec::pieces(const SceneSpec&) const {
    return {};
}

std::unique_ptr<BodyDrawing> BodySpec::drawing(const Body& body) const {
    return body.model.triangles.empty() ? rodDrawing(body, 0.01, 0.0) : sheetDrawing(body);
}

BodyOutline BodySpec::outline(const SceneSpec& scene) const {
    const mechanics::Model model = build(scene);
    BodyOutline outline;
    outline.points = model.pointCount();
    outline.springs = static_cast<double>(model.springs.size());
    outline.volumes = static_cast<double>(model.cells.size());
    for (const auto& [group, points] : model.groups)
        if (group != "all") outline.groups.push_back(group);
    outline.places = placeNames(model);
    outline.isGrid = model.grid[0] > 0;
    outline.hasSurface = !model.triangles.empty();
    return outline;
}

}  // namespace taut::world
