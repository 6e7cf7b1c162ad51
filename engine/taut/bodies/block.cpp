#include "taut/bodies/block.h"

#include "taut/bodies/drawing.h"
#include "taut/fields/private/problems.h"
#include "taut/mechanics/builders.h"
#include "taut/spec/common_rows.h"
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
        .number("young_Pa", &BlockSpec::young, "Pa", positive,
                "Young's modulus; with bulk_Pa that of the springs alone.")
        .ramps(Affects::springs)
        .number("poisson", &BlockSpec::poisson, "", Range{0.25, 0.45},
                "Poisson's ratio: how much it narrows when it is stretched. 0.4 if neither this nor bulk_Pa is given.")
        .ramps(Affects::springs)
        .number("bulk_Pa", &BlockSpec::bulk, "Pa", notNegative,
                "In place of poisson: a pressure that resists a change of volume, added to springs of young_Pa, whose "
                "ratio is 1/4. 0: springs alone.")
        .ramps(Affects::springs)
        .number("working_stretch", &BlockSpec::workingStretch, "", Range{1.0, 100.0},
                "Stretch up to which the step must hold.");
    section.fields = withPlasticity(withLosses(list))
                         .choice("lumping", &BlockSpec::lumping, lumpingNames(),
                                 "How mass is shared out: by volume, or the same for every point.")
                         .take();
    section.check = [](const fields::CheckInput& input, void* target) {
        const auto& block = *static_cast<const BlockSpec*>(target);
        if (block.poisson && block.bulk)
            input.problems.addError(input.at("poisson"), "a block has either poisson or bulk_Pa",
                                    "leave one out; with poisson, young_Pa is that of the block");
    };
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
         .poisson = poisson.value_or(mechanics::BlockShape{}.poisson),
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
    outline.volumes = n.x * n.y * n.z;
    outline.hasSurface = true;
    outline.groups = mechanics::blockGroups();
    return outline;
}

Kind<BodySpec> blockKind() {
    return bodyKind<BlockSpec>();
}

}  // namespace taut::world
