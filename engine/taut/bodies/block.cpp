#include "taut/bodies/block.h"

#include "taut/mechanics/builders.h"
#include "taut/spec/common_rows.h"
#include "taut/bodies/drawing.h"
#include "taut/spec/private/rotation.h"

namespace taut::world {

using fields::Affects;
using fields::FieldList;
using fields::notNegative;
using fields::positive;
using fields::Range;
using fields::Section;

Section BlockSpec::section() {
    Section section;
    section.help = "A deformable block.";
    FieldList<BlockSpec> list;
    list.vector("size", &BlockSpec::size, "m", lengthRange, "Its three edges.")
        .vector("cells", &BlockSpec::cells, "", countRange, "Number of cells along each.")
        .vector("position", &BlockSpec::position, "m", placeRange, "Its centre.")
        .rotation("rotation_deg", &BlockSpec::rotation, "About x, then y, then z.")
        .number("density_kg_per_m3", &BlockSpec::density, "kg/m³", positive, "Mass of a cubic metre.")
        .number("young_Pa", &BlockSpec::young, "Pa", positive, "Young's modulus.")
        .ramps(Affects::springs)
        .number("bulk_Pa", &BlockSpec::bulk, "Pa", notNegative, "Resistance to a change of volume.")
        .ramps(Affects::springs)
        .number("working_stretch", &BlockSpec::workingStretch, "", Range{1.0, 100.0},
                "Stretch up to which the step must hold.");
    section.fields = withPlasticity(withLosses(list))
                         .choice("lumping", &BlockSpec::lumping, lumpingNames(),
                                 "How mass is shared out: by volume, or the same for every point.")
                         .take();
    return section;
}

mechanics::Model BlockSpec::build(const SceneSpec&) const {
    const glm::dquat turn = rotationOf(rotation);
    mechanics::Model model = mechanics::buildBlock(
        {.centre = position,
         .axes = glm::dmat3(rotated(turn, {1, 0, 0}), rotated(turn, {0, 1, 0}), rotated(turn, {0, 0, 1})),
         .size = size,
         .cells = cells,
         .density = density,
         .young = young,
         .bulk = bulk,
         .dampingTime = dampingTime,
         .dragRate = drag,
         .lumping = lumping});
    model.workingStretch = workingStretch;
    return model;
}

std::unique_ptr<BodyDrawing> BlockSpec::drawing(const Body& body) const {
    return sidedDrawing(body);
}

BodyOutline BlockSpec::outline(const SceneSpec&) const {
    BodyOutline outline;
    const dvec3 n(cells);
    outline.points = (n.x + 1) * (n.y + 1) * (n.z + 1);
    outline.springs = 9.0 * n.x * n.y * n.z;  // three edges and six face diagonals per cell
    outline.volumes = 6.0 * n.x * n.y * n.z;
    outline.hasSurface = true;
    outline.groups = mechanics::blockGroups();
    return outline;
}

Kind<BodySpec> blockKind() {
    return bodyKind<BlockSpec>();
}

}  // namespace taut::world
