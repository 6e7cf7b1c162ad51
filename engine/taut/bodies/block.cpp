#include "taut/bodies/block.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "taut/bodies/private/carried_surface.h"
#include "taut/core/error.h"
#include "taut/drawing/drawing.h"
#include "taut/fields/private/problems.h"
#include "taut/mechanics/builders.h"
#include "taut/spec/common_rows.h"
#include "taut/spec/private/rotation.h"

namespace taut::world {

TAUT_VALUE_MEMBERS(BlockSpec);

using fields::Affects;
using fields::FieldList;
using fields::notNegative;
using fields::positive;
using fields::Range;
using fields::Role;
using fields::Section;

Section BlockSpec::section() {
    Section section;
    section.help = "A deformable block: a box or a filled closed mesh of an OBJ or glTF file.";
    section.variant = [](const fields::Node& table) -> std::string {
        return table.find("mesh") != nullptr ? "a block from a mesh" : "a block that is a box";
    };
    const std::vector<std::string> box{"a block that is a box"}, mesh{"a block from a mesh"};
    FieldList<BlockSpec> list;
    list.vector("size", &BlockSpec::size, "m", lengthRange, "Lengths of its three edges.")
        .only(box)
        .vector("cells", &BlockSpec::cells, "", countRange, "Number of cells along each edge.")
        .only(box)
        .text("mesh", &BlockSpec::mesh, Role::mesh,
              "OBJ or glTF file of a closed surface, which is drawn; groups and objects of an OBJ (g, o) name the "
              "points around them.")
        .only(mesh)
        .number("cells_m", &BlockSpec::cell, "m", lengthRange,
                "Approximate edge of the cubes that carry the mesh, along the axes of its file; partly filled cubes "
                "have their share of mass and stiffness.")
        .required()
        .only(mesh)
        .number("scale", &BlockSpec::scale, "", lengthRange, "Size of a unit of the file in metres.")
        .only(mesh)
        .vector("position", &BlockSpec::position, "m", placeRange, "Centre; of a mesh the origin of its file.")
        .rotation("rotation_deg", &BlockSpec::rotation, "Rotation about x, then y, then z.")
        .number("density_kg_per_m3", &BlockSpec::density, "kg/m³", positive, "Density.")
        .number("young_Pa", &BlockSpec::young, "Pa", positive,
                "Young's modulus; with bulk_Pa that of the springs only.")
        .ramps(Affects::springs)
        .number("poisson", &BlockSpec::poisson, "", Range{0.25, 0.45}, "Poisson's ratio; default 0.4 without bulk_Pa.")
        .ramps(Affects::springs)
        .number("bulk_Pa", &BlockSpec::bulk, "Pa", notNegative,
                "Bulk modulus of a pressure in each cell, instead of poisson: springs of young_Pa have the ratio 1/4. "
                "0: springs only.")
        .inPlaceOf("poisson")
        .ramps(Affects::springs)
        .number("working_stretch", &BlockSpec::workingStretch, "", Range{1.0, 100.0},
                "Largest stretch for which the step is stable.");
    section.fields = withPlasticity(withLosses(list))
                         .choice("lumping", &BlockSpec::lumping, lumpingNames(),
                                 "Distribution of mass: by volume, or the same for every point.")
                         .take();
    return section;
}

void BlockSpec::fillMesh() {
    constexpr double mostCells = 2e6;
    const dvec3 n = mechanics::boxCells(meshData->positions, cell / scale);
    if (n.x * n.y * n.z > mostCells)
        throw core::Error(
            core::ErrorKind::badContent,
            fmt::format(
                "there are {:.3g} cubes of cells_m = {:g} in the box around {}, more than {:g}: make them larger",
                n.x * n.y * n.z, cell, mesh, mostCells));
    std::vector<dvec3> places;
    for (const dvec3& x : meshData->positions) places.push_back(scale * x);
    try {
        filled_ = std::make_shared<const mechanics::Lattice>(mechanics::meshLattice(places, meshData->triangles, cell));
    } catch (const mechanics::MeshFault& fault) {
        throw core::Error(fault.kind(), meshFaultText(*this, fault.what(), fault.triangle));
    }
}

std::shared_ptr<const mechanics::Lattice> BlockSpec::lattice() const {
    if (!meshData) return std::make_shared<const mechanics::Lattice>(mechanics::fullLattice(cells, size));
    if (filled_) return filled_;
    BlockSpec filled = *this;
    try {
        filled.fillMesh();
    } catch (const core::Error& error) {
        throw core::Error(error.kind(), at(source) + error.what());
    }
    return filled.filled_;
}

mechanics::BlockShape BlockSpec::shapeOf(const mechanics::Lattice& lattice) const {
    const glm::dquat turn = rotationOf(rotation);
    return {.centre = meshData ? position + rotated(turn, lattice.centre) : position,
            .axes = glm::dmat3(rotated(turn, {1, 0, 0}), rotated(turn, {0, 1, 0}), rotated(turn, {0, 0, 1})),
            .size = meshData ? lattice.cell * dvec3(lattice.counts) : size,
            .cells = cells,
            .density = density,
            .young = young,
            .poisson = poisson.value_or(mechanics::BlockShape{}.poisson),
            .bulk = bulk,
            .dampingTime = dampingTime,
            .dragRate = drag,
            .lumping = lumping,
            .lattice = meshData ? &lattice : nullptr};
}

mechanics::Model BlockSpec::build(const SceneSpec&) const {
    const std::shared_ptr<const mechanics::Lattice> found = meshData ? lattice() : nullptr;
    mechanics::Model model = mechanics::buildBlock(shapeOf(found ? *found : mechanics::Lattice{}));
    model.workingStretch = workingStretch;
    if (!found) return model;
    // A group of the file is the corners of the cells that carry its vertices.
    const dvec3 low = found->centre - 0.5 * found->cell * dvec3(found->counts);
    for (const auto& [group, vertices] : meshData->groups) {
        std::set<int> points;
        for (const int v : vertices) {
            const dvec3 place = scale * meshData->positions[v];
            const auto& corners = found->carrierOf((place - low) / found->cell).points;
            points.insert(corners.begin(), corners.end());
        }
        model.groups.try_emplace(group, points.begin(), points.end());
    }
    return model;
}

std::unique_ptr<BodyDrawing> BlockSpec::drawing(const Body& body) const {
    const bool drawsSkin = finish.skinData != nullptr && body.damage.isEmpty();
    if (!drawsSkin && meshData == nullptr) return sidedDrawing(body);
    const BlockFrame frame = frameOf(body);
    return sidedDrawing(body, frame, drawsSkin ? shiftOf(body, frame) : meshPlaceOf(body, frame));
}

BodyOutline BlockSpec::outline(const SceneSpec&) const {
    BodyOutline outline;
    dvec3 n(cells);
    if (meshData) n = mechanics::boxCells(meshData->positions, cell / scale);
    outline.points = (n.x + 1) * (n.y + 1) * (n.z + 1);
    outline.volumes = n.x * n.y * n.z;
    outline.hasSurface = true;
    outline.groups = mechanics::blockGroups(!meshData);
    if (filled_) {
        outline.points = static_cast<double>(filled_->points.size());
        outline.volumes = static_cast<double>(filled_->cells.size());
    }
    outline.springs = 9.0 * outline.volumes;  // three edges and six face diagonals per cell
    if (!meshData) return outline;
    for (const auto& group : meshData->groups)
        if (std::find(outline.groups.begin(), outline.groups.end(), group.first) == outline.groups.end())
            outline.groups.push_back(group.first);
    return outline;
}

Kind<BodySpec> blockKind() {
    return bodyKind<BlockSpec>();
}

}  // namespace taut::world
