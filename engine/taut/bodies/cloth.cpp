#include "taut/bodies/cloth.h"

#include <cmath>

#include "taut/core/error.h"
#include "taut/fields/private/problems.h"
#include "taut/mechanics/builders.h"
#include "taut/spec/common_rows.h"
#include "taut/spec/private/rotation.h"
#include "taut/spec/spec.h"

namespace taut::world {

using fields::FieldList;
using fields::Role;
using fields::Section;

namespace {

dvec3 unit(const dvec3& v) {
    return v / std::sqrt(glm::dot(v, v));
}

// The loader refuses numbers that belong to no bending energy (fields_materials.cpp).
mechanics::BendingRigidity rigidityOf(const BendingSpec& spec) {
    if (!spec.warp) return {};
    const auto rigidity = mechanics::orthotropicRigidity(*spec.warp, spec.weft.value_or(*spec.warp), spec.bias);
    TAUT_EXPECTS(rigidity.has_value());
    return *rigidity;
}

mechanics::ClothMaterial materialOf(const ClothSpec& spec, const SceneSpec& scene) {
    const auto found = scene.materials.find(spec.material);
    if (found == scene.materials.end() && !spec.material.empty())
        throw core::Error(core::ErrorKind::badContent, at(spec.source) + "no [material." + spec.material + "]");
    const MaterialSpec m = found == scene.materials.end() ? MaterialSpec{} : found->second;
    return {.density = m.density,
            .stretch = m.stretch,
            .shear = m.shear.value_or(m.defaultShear()),
            .bend = m.bend,
            .dampingTime = m.dampingTime,
            .dragRate = m.drag,
            .lumping = m.lumping,
            .rigidity = rigidityOf(m.rigidity),
            .weftStretch = m.weftStretch,
            .frictionMoment = 0.5 * m.friction.hysteresis.value_or(0),
            .frictionYield = m.friction.yield.value_or(0)};
}

mechanics::MeshClothShape shapeOf(const ClothSpec& spec) {
    mechanics::MeshClothShape shape;
    const glm::dquat turn = rotationOf(spec.rotation);
    for (const dvec3& x : spec.meshData->positions)
        shape.positions.push_back(spec.position + rotated(turn, spec.scale * x));
    shape.uv = spec.meshData->uv;
    shape.triangles = spec.meshData->triangles;
    shape.cornerUv = spec.meshData->cornerUv;
    shape.groups = spec.meshData->groups;
    shape.numbers = spec.meshData->numbers;
    return shape;
}

}  // namespace

Section ClothSpec::section() {
    // Two variants: each field says to which it belongs.
    Section section;
    section.help = "A cloth: a grid, or a mesh from an OBJ or glTF file.";
    section.variant = [](const fields::Node& table) -> std::string {
        return table.find("mesh") != nullptr ? "a cloth from a mesh" : "a cloth grid";
    };
    const std::vector<std::string> grid{"a cloth grid"}, mesh{"a cloth from a mesh"};
    section.fields =
        FieldList<ClothSpec>()
            .text("material", &ClothSpec::material, Role::material, "Name of its material.")
            .required()
            .vector("size", &ClothSpec::size, "m", lengthRange, "Across and down.")
            .only(grid)
            .vector("cells", &ClothSpec::cells, "", countRange, "Number of cells across and down.")
            .only(grid)
            .vector("origin", &ClothSpec::origin, "m", placeRange, "Top left corner.")
            .only(grid)
            .direction("across", &ClothSpec::across, "Direction from left to right; any length.")
            .only(grid)
            .direction("down", &ClothSpec::down, "Direction from top to bottom; any length.")
            .only(grid)
            .degrees(
                "grain_deg", &ClothSpec::grain, fields::Range{-360.0, 360.0},
                "Turns the warp of its material from across towards down. Bending is turned at any angle; stretch "
                "at multiples of 90° and, in square cells, 45°, in between as nearly as springs along the grid can. "
                "Hysteresis needs multiples of 90°.")
            .only(grid)
            .flag("round", &ClothSpec::isRound,
                  "Only the cells of which the middle lies in the ellipse that fits into its size: a round tablecloth.")
            .only(grid)
            .text("mesh", &ClothSpec::mesh, Role::mesh,
                  "OBJ or glTF file; groups and objects of an OBJ (g, o) are names of points.")
            .only(mesh)
            .vector("position", &ClothSpec::position, "m", placeRange, "Where the file's origin lies.")
            .only(mesh)
            .rotation("rotation_deg", &ClothSpec::rotation, "About x, then y, then z.")
            .only(mesh)
            .number("scale", &ClothSpec::scale, "", lengthRange, "Metres of a unit of the file.")
            .only(mesh)
            .take();
    // Makes both directions unit vectors, and exactly perpendicular if they are nearly so.
    section.check = [](const fields::CheckInput& input, void* target) {
        auto& cloth = *static_cast<ClothSpec*>(target);
        if (input.table.find("across") == nullptr && input.table.find("down") == nullptr) return;
        cloth.across /= std::sqrt(glm::dot(cloth.across, cloth.across));
        cloth.down /= std::sqrt(glm::dot(cloth.down, cloth.down));
        const double slant = glm::dot(cloth.across, cloth.down);
        if (std::abs(slant) <= 1e-3) {
            cloth.down -= slant * cloth.across;
            cloth.down /= std::sqrt(glm::dot(cloth.down, cloth.down));
            return;
        }
        const bool namesDown = input.table.find("down") != nullptr;
        input.problems.addError(input.at(namesDown ? "down" : "across"), "across and down must be at right angles",
                                namesDown ? "" : "give down too; it is [0, -1, 0] now");
    };
    return section;
}

mechanics::Model ClothSpec::build(const SceneSpec& scene) const {
    mechanics::Model model = buildSheet(scene);
    const auto found = scene.materials.find(material);
    if (found == scene.materials.end() || found->second.air == 0) return model;
    for (const double mass : model.masses) model.airMasses.push_back(mass * found->second.air / found->second.density);
    model.plateAir = found->second.flutter * found->second.air;
    return model;
}

mechanics::Model ClothSpec::buildSheet(const SceneSpec& scene) const {
    const mechanics::ClothMaterial made = materialOf(*this, scene);
    if (!meshData) {
        const dvec3 u = unit(across);
        const dvec3 v = unit(down - glm::dot(down, u) * u);
        return mechanics::buildCloth({origin, u, v, size, cells, made, grain, isRound});
    }
    mechanics::MeshClothShape shape = shapeOf(*this);
    shape.material = made;
    try {
        return mechanics::buildMeshCloth(shape);
    } catch (const mechanics::MeshFault& fault) {
        const auto triangle = static_cast<std::size_t>(fault.triangle);  // a fault of no triangle is larger than any
        const std::string line =
            triangle < meshData->lines.size() ? ":" + std::to_string(meshData->lines[triangle]) : "";
        throw core::Error(fault.kind(),
                          at(source) + "cannot use this mesh: " + mesh + line + ": error: " + fault.what());
    }
}

PlasticitySpec ClothSpec::plasticityIn(const SceneSpec& scene) const {
    const auto found = scene.materials.find(material);
    return found == scene.materials.end() ? PlasticitySpec{} : found->second.plasticity;
}

BodyOutline ClothSpec::outline(const SceneSpec&) const {
    BodyOutline outline;
    outline.hasSurface = true;
    outline.isGrid = mesh.empty();
    outline.isRound = isRound;
    if (meshData) {
        outline.points = static_cast<double>(meshData->positions.size());
        outline.springs = 3.0 * static_cast<double>(meshData->triangles.size());
    } else {
        const double x = cells.x, y = cells.y;
        outline.points = (x + 1) * (y + 1);
        outline.springs = 6.0 * x * y + x + y;
    }
    outline.groups = outline.isGrid ? mechanics::clothGroups(isRound) : mechanics::meshClothGroups();
    if (meshData)
        for (const auto& group : meshData->groups) outline.groups.push_back(group.first);
    return outline;
}

Kind<BodySpec> clothKind() {
    return bodyKind<ClothSpec>();
}

}  // namespace taut::world
