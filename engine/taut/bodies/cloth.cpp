#include "taut/bodies/cloth.h"

#include <algorithm>
#include <cmath>

#include "taut/bodies/private/cloth_panel.h"
#include "taut/core/error.h"
#include "taut/drawing/drawing.h"
#include "taut/fields/private/problems.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/panel_mesher.h"
#include "taut/spec/common_rows.h"
#include "taut/spec/private/rotation.h"
#include "taut/spec/spec.h"

namespace taut::world {

TAUT_VALUE_MEMBERS(ClothSpec);

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
    const dvec3 u = unit(spec.across), v = unit(spec.down - glm::dot(spec.down, u) * u);
    for (const dvec3& x : spec.meshData->positions)
        shape.positions.push_back(spec.isPanel() ? spec.origin + x.x * u - x.y * v
                                                 : spec.position + rotated(turn, spec.scale * x));
    shape.uv = spec.meshData->uv;
    shape.triangles = spec.meshData->triangles;
    shape.cornerUv = spec.meshData->cornerUv;
    shape.groups = spec.meshData->groups;
    shape.numbers = spec.meshData->numbers;
    return shape;
}

// Makes both directions unit vectors, and exactly perpendicular if they are nearly so.
void checkDirections(const fields::CheckInput& input, ClothSpec& cloth) {
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
                            namesDown ? "" : "set down too; its default is [0, -1, 0]");
}

}  // namespace

Section ClothSpec::section() {
    // Three variants: each field says to which it belongs.
    Section section;
    section.help = "A cloth: a grid, a panel with an outline, or a mesh from an OBJ or glTF file.";
    section.variant = [](const fields::Node& table) -> std::string {
        if (table.find("mesh") != nullptr) return "a cloth from a mesh";
        return table.find("outline") != nullptr ? "a cloth panel" : "a cloth grid";
    };
    const std::vector<std::string> grid{"a cloth grid"}, panel{"a cloth panel"}, mesh{"a cloth from a mesh"};
    const std::vector<std::string> both{"a cloth grid", "a cloth panel"};
    section.fields =
        FieldList<ClothSpec>()
            .text("material", &ClothSpec::material, Role::material, "Name of its material.")
            .required()
            .vector("size", &ClothSpec::size, "m", lengthRange, "Lengths across and down.")
            .only(grid)
            .vector("cells", &ClothSpec::cells, "", countRange, "Number of cells across and down.")
            .only(grid)
            .vector("origin", &ClothSpec::origin, "m", placeRange,
                    "Top left corner; of a panel the place of [0, 0] of its outline.")
            .only(both)
            .direction("across", &ClothSpec::across, "Direction from left to right; any length.")
            .only(both)
            .direction("down", &ClothSpec::down, "Direction from top to bottom; any length.")
            .only(both)
            .degrees("grain_deg", &ClothSpec::grain, fields::Range{-360.0, 360.0},
                     "Angle of the warp from across towards down. Bending turns to any angle; stretch is exact at "
                     "multiples of 90° and, in square cells, at 45°, and approximate in between. Hysteresis needs "
                     "multiples of 90°. The rows of a panel's triangles follow the warp, at any angle.")
            .only(both)
            .flag("round", &ClothSpec::isRound,
                  "Whether only cells with their middle inside the ellipse that fits into its size exist: a round "
                  "tablecloth.")
            .only(grid)
            .places("outline", &ClothSpec::corners, "m", placeRange,
                    "Corners of a panel in order, [x, y] with x along across and y against down. Its sides are groups "
                    "of points: side0, from corner 0 to corner 1, and so on.")
            .required()
            .only(panel)
            .tables("holes", &ClothSpec::holes, panelHoleSection(),
                    "Holes of a panel; the points around the first are hole0.")
            .only(panel)
            .tables("edges", &ClothSpec::edges, panelEdgeSection(),
                    "Names for runs of its sides: points in the order of the outline.")
            .only(panel)
            .number("cell_m", &ClothSpec::cell, "m", lengthRange, "Approximate length of the edges of its triangles.")
            .only(panel)
            .text("mesh", &ClothSpec::mesh, Role::mesh,
                  "OBJ or glTF file; groups and objects of an OBJ (g, o), of faces or of lines, are names of points.")
            .only(mesh)
            .vector("position", &ClothSpec::position, "m", placeRange, "Origin of the file.")
            .only(mesh)
            .rotation("rotation_deg", &ClothSpec::rotation, "Rotation about x, then y, then z.")
            .only(mesh)
            .number("scale", &ClothSpec::scale, "", lengthRange, "Size of a unit of the file in metres.")
            .only(mesh)
            .take();
    section.check = [](const fields::CheckInput& input, void* target) {
        auto& cloth = *static_cast<ClothSpec*>(target);
        checkDirections(input, cloth);
        if (!input.isClean || input.variant != "a cloth panel") return;
        checkPanel(input, cloth);
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
    if (!meshData && isPanel()) {
        ClothSpec meshed = *this;
        try {
            meshed.meshPanel();
        } catch (const mechanics::PanelFault& fault) {
            throw core::Error(fault.kind(), at(source) + fault.what());
        }
        return meshed.buildSheet(scene);
    }
    if (!meshData) {
        const dvec3 u = unit(across);
        const dvec3 v = unit(down - glm::dot(down, u) * u);
        return mechanics::buildCloth({origin, u, v, size, cells, made, grain, isRound});
    }
    mechanics::MeshClothShape shape = shapeOf(*this);
    shape.material = made;
    try {
        mechanics::Model model = mechanics::buildMeshCloth(shape);
        if (isPanel())  // an edge "left" is not the points furthest to the left
            for (const auto& group : meshData->groups) model.groups[group.first] = group.second;
        return model;
    } catch (const mechanics::MeshFault& fault) {
        throw core::Error(fault.kind(), at(source) + meshFaultText(*this, fault.what(), fault.triangle));
    }
}

PlasticitySpec ClothSpec::plasticityIn(const SceneSpec& scene) const {
    const auto found = scene.materials.find(material);
    return found == scene.materials.end() ? PlasticitySpec{} : found->second.plasticity;
}

// A skin lies as its mesh, else in metres of the scene; an array's copies each have their own.
std::unique_ptr<BodyDrawing> ClothSpec::drawing(const Body& body) const {
    const dvec3 first = body.model.positions.front() - jitterOf(body, 0);
    if (meshData == nullptr) return sheetDrawing(body, {first - origin});
    const glm::dquat turn = rotationOf(rotation);
    return sheetDrawing(body, {first - rotated(turn, scale * meshData->positions.front()), turn, scale});
}

BodyOutline ClothSpec::outline(const SceneSpec&) const {
    BodyOutline outline;
    outline.hasSurface = true;
    outline.isGrid = mesh.empty() && !isPanel();
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
    if (!meshData) return outline;
    for (const auto& group : meshData->groups)
        if (std::find(outline.groups.begin(), outline.groups.end(), group.first) == outline.groups.end())
            outline.groups.push_back(group.first);
    return outline;
}

Kind<BodySpec> clothKind() {
    return bodyKind<ClothSpec>();
}

}  // namespace taut::world
