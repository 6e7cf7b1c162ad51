#include "taut/bodies/solid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "taut/bodies/drawing.h"
#include "taut/bodies/private/bound_mesh.h"
#include "taut/collision/private/convex_hull.h"
#include "taut/core/trig.h"
#include "taut/fields/private/problems.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/closed_mesh.h"
#include "taut/mechanics/rigid.h"
#include "taut/spec/common_rows.h"
#include "taut/spec/private/rotation.h"
#include "taut/spec/spec.h"

namespace taut::world {

using fields::FieldList;
using fields::notNegative;
using fields::positive;
using fields::Role;
using fields::Section;

namespace {

constexpr float creaseAngle = 0.6F;  // [rad] drawn edges of a mesh that are sharper stay sharp

const std::vector<std::string> solidShapes{"box", "sphere", "capsule", "cylinder", "cone", "mesh", "hull"};

// Corner i is on the positive side of axis k if bit k of i is set.
void addBox(const dvec3& half, mechanics::RigidShape& shape) {
    for (int i = 0; i < 8; ++i) {
        const auto side = [&](int k) { return ((i >> k) & 1) != 0 ? half[k] : -half[k]; };
        shape.positions.emplace_back(side(0), side(1), side(2));
    }
    for (int k = 0; k < 3; ++k) {
        const int u = 1 << ((k + 1) % 3), v = 1 << ((k + 2) % 3), top = 1 << k;
        shape.triangles.push_back({top, top | u, top | u | v});
        shape.triangles.push_back({top, top | u | v, top | v});
        shape.triangles.push_back({0, u | v, u});
        shape.triangles.push_back({0, v, u | v});
    }
}

// A prism of `sides` with these radii at its ends, `low` and `high` on the axis y; a pyramid if the second radius is 0.
void addPrism(double radius, double radiusAbove, double low, double high, mechanics::RigidShape& shape) {
    constexpr int sides = 24;
    const auto add = [&](double r, double y, int k) {
        const double angle = 2.0 * core::pi * k / sides;
        shape.positions.emplace_back(r * core::cosine(angle), y, r * core::sine(angle));
    };
    const bool hasTip = !(radiusAbove > 0);
    add(0.0, low, 0);
    for (int k = 0; k < sides; ++k) add(radius, low, k);
    const int top = static_cast<int>(shape.positions.size());
    add(0.0, high, 0);
    for (int k = 0; k < sides && !hasTip; ++k) add(radiusAbove, high, k);
    for (int k = 0; k < sides; ++k) {
        const int a = 1 + k, b = 1 + (k + 1) % sides;
        shape.triangles.push_back({0, a, b});
        if (hasTip) {
            shape.triangles.push_back({top, b, a});
            continue;
        }
        shape.triangles.push_back({a, top + a, b});
        shape.triangles.push_back({b, top + a, top + b});
        shape.triangles.push_back({top, top + b, top + a});
    }
    shape.revolution = {{0, top}, {radius, radiusAbove}, radius * (1.0 - core::cosine(core::pi / sides))};
}

// The least convex body around the points.
void addHull(std::span<const dvec3> points, mechanics::RigidShape& shape) {
    const std::vector<std::uint32_t> corners = collision::convexHull(points);
    if (corners.empty())
        throw mechanics::MeshFault("the points of the mesh lie in one plane, so that their hull has no inside", -1);
    std::vector<int> placeOf(points.size(), -1);
    for (std::size_t k = 0; k < corners.size(); ++k) {
        int& place = placeOf[corners[k]];
        if (place < 0) {
            place = static_cast<int>(shape.positions.size());
            shape.positions.push_back(points[corners[k]]);
        }
        if (k % 3 == 0) shape.triangles.emplace_back();
        shape.triangles.back()[k % 3] = place;
    }
}

// Draws a rigid mesh where the inner points say.
class SolidDrawing final : public BodyDrawing {
  public:
    SolidDrawing(const Body& body, view::Mesh mesh)
        : name_(body.fullName()), mesh_(std::move(mesh)), finish_(finishOf(body.spec->finish)) {
        const auto& spec = dynamic_cast<const SolidSpec&>(*body.spec);
        const dvec3 origin = body.model.positions[0] - jitterOf(body, 0) -
                             (spec.build({}).positions[0] - spec.position);  // an array's copies each have their own
        const glm::dquat back = glm::conjugate(rotationOf(spec.rotation));
        const std::vector<glm::vec3> start = startOf(body);
        for (std::size_t k = 0; k < 3; ++k) rest_[k] = rotated(back, dvec3(start[2 * k]) - origin);
    }
    void addSurfaces(std::span<const glm::vec3> positions, std::vector<view::Surface>& surfaces) const override {
        const std::array<dvec3, 3> now{dvec3(positions[0]), dvec3(positions[2]), dvec3(positions[4])};
        const glm::dmat3 turn = mechanics::rotationBetween(rest_, now);
        view::Surface surface;
        surface.name = name_;
        surface.topology = mesh_.topology;
        surface.geometry = mesh_.geometry;
        surface.finish = finish_;
        surface.transform = glm::mat4(glm::mat3(turn));
        surface.transform[3] = glm::vec4(glm::vec3(now[0] - turn * rest_[0]), 1.0F);
        surfaces.push_back(std::move(surface));
    }

  private:
    std::string name_;
    view::Mesh mesh_;
    std::shared_ptr<const view::Finish> finish_;
    std::array<dvec3, 3> rest_;  // [m] of three inner points, in the axes of the mesh
};

}  // namespace

Section SolidSpec::section() {
    Section section;
    section.help = "A rigid body.";
    section.variant = [](const fields::Node& table) -> std::string {
        const fields::Member* named = table.find("shape");
        return named != nullptr && named->value.kind == fields::NodeKind::text ? named->value.text : "";
    };
    section.variantKey = "shape";
    section.fields =
        FieldList<SolidSpec>()
            .choice("shape", &SolidSpec::shape, solidShapes, "Its shape.")
            .required()
            .vector("size", &SolidSpec::size, "m", lengthRange, "Its three edges.")
            .only({"box"})
            .number("edge", &SolidSpec::edge, "m", notNegative, "Rounding of its edges as they are drawn.")
            .only({"box"})
            .number("radius", &SolidSpec::radius, "m", lengthRange, "Its radius.")
            .only({"sphere", "capsule", "cylinder", "cone"})
            .number("height", &SolidSpec::height, "m", lengthRange,
                    "Along y; of a capsule, between the centres of its half spheres.")
            .only({"capsule", "cylinder", "cone"})
            .text("mesh", &SolidSpec::mesh, Role::mesh, "OBJ or glTF file; its surfaces are closed, but for a hull.")
            .required()
            .only({"mesh", "hull"})
            .number("scale", &SolidSpec::scale, "", lengthRange, "Metres of a unit of the file.")
            .only({"mesh", "hull"})
            .vector("position", &SolidSpec::position, "m", placeRange, "Its centre; of a mesh the origin of its file.")
            .rotation("rotation_deg", &SolidSpec::rotation, "About x, then y, then z.")
            .number("density_kg_per_m3", &SolidSpec::density, "kg/m³", positive, "Mass of a cubic metre.")
            .number("mass_kg", &SolidSpec::mass, "kg", positive, "Its mass, in place of the density.")
            .number("drag_per_s", &SolidSpec::drag, "1/s", dragRange, "Rate at which still air slows it.")
            .take();
    section.check = [](const fields::CheckInput& input, void* target) {
        auto& solid = *static_cast<SolidSpec*>(target);
        if (input.table.find("mass_kg") != nullptr && input.table.find("density_kg_per_m3") != nullptr)
            input.problems.addError(input.at("mass_kg"), "a solid has either mass_kg or density_kg_per_m3",
                                    "leave one out");
        if (solid.isRound()) {
            solid.thickness = solid.radius;
            if (input.table.find("thickness") != nullptr)
                input.problems.addError(input.at("thickness"),
                                        fmt::format("the thickness of a {} is its radius", solid.shape),
                                        "leave thickness out");
            return;
        }
        const double most = solid.mostThickness();
        if (!(solid.thickness < most)) {
            if (input.table.find("thickness") != nullptr)
                input.problems.addError(input.at("thickness"),
                                        fmt::format("the thickness goes into the {} from all sides: it must be less "
                                                    "than the radius of the largest ball in it, {:.3g} m",
                                                    solid.shape, most));
            else
                solid.thickness = 0.2 * most;
        }
    };
    return section;
}

double SolidSpec::mostThickness() const {
    if (shape == "box") return 0.5 * std::min({size.x, size.y, size.z});
    if (shape == "cylinder") return std::min(radius, 0.5 * height);
    if (shape == "cone") return radius * height / (std::sqrt(height * height + radius * radius) + radius);
    return HUGE_VAL;
}

mechanics::Model SolidSpec::build(const SceneSpec&) const {
    mechanics::RigidShape made;
    if (shape == "sphere") {
        made.positions = {dvec3(0.0)};
        made.properties = mechanics::massPropertiesOfBall(radius);
    } else if (shape == "capsule") {
        made.positions = {{0.0, -0.5 * height, 0.0}, {0.0, 0.5 * height, 0.0}};
        made.lines = {{0, 1}};
        made.properties = mechanics::massPropertiesOfCapsule(radius, height);
    } else if (shape == "cylinder") {
        addPrism(radius - thickness, radius - thickness, thickness - 0.5 * height, 0.5 * height - thickness, made);
        made.properties = mechanics::massPropertiesOfCylinder(radius, height);
    } else if (shape == "cone") {
        const double side = std::sqrt(height * height + radius * radius);
        addPrism(radius - thickness * (side + radius) / height, 0.0, thickness - 0.5 * height,
                 0.5 * height - thickness * side / radius, made);
        made.properties = mechanics::massPropertiesOfCone(radius, height);
    } else if (shape != "box" && meshData != nullptr) {
        std::vector<dvec3> points;
        for (const dvec3& x : meshData->positions) points.push_back(scale * x);
        try {
            if (shape == "hull") {
                addHull(points, made);
            } else {
                made.positions = std::move(points);
                made.triangles = meshData->triangles;
                mechanics::expectClosed(made.positions, made.triangles);
            }
        } catch (const mechanics::MeshFault& fault) {
            throw core::Error(fault.kind(), at(source) + meshFaultText(*this, fault.what(), fault.triangle));
        }
        made.properties = mechanics::massPropertiesOf(made.positions, made.triangles);
    } else {
        addBox(0.5 * size, made);
        made.properties = mechanics::massPropertiesOf(made.positions, made.triangles);
        for (dvec3& corner : made.positions) corner -= thickness * glm::sign(corner);
    }
    made.mass = mass.value_or(density * made.properties.volume);
    const glm::dquat turn = rotationOf(rotation);
    made.axes = glm::dmat3(rotated(turn, {1, 0, 0}), rotated(turn, {0, 1, 0}), rotated(turn, {0, 0, 1}));
    made.place = position;
    made.dragRate = drag;
    mechanics::Model model = mechanics::buildRigid(made);
    if (const int top = model.revolution.ends[1]; top >= 0)
        for (int i = mechanics::innerPoints; i < model.pointCount(); ++i)
            model.groups[i < top ? "bottom" : "top"].push_back(i);
    if (shape != "box") return model;
    static constexpr const char* sides[3][2] = {{"left", "right"}, {"bottom", "top"}, {"back", "front"}};
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 3; ++k) model.groups[sides[k][(i >> k) & 1]].push_back(mechanics::innerPoints + i);
    return model;
}

std::unique_ptr<BodyDrawing> SolidSpec::drawing(const Body& body) const {
    const auto r = static_cast<float>(radius);
    if (shape == "sphere") return std::make_unique<SolidDrawing>(body, view::sphereMesh(r));
    if (shape == "capsule")
        return std::make_unique<SolidDrawing>(body, view::capsuleMesh(r, static_cast<float>(height)));
    if (shape == "cylinder")
        return std::make_unique<SolidDrawing>(body, view::cylinderMesh(r, static_cast<float>(height)));
    if (shape == "cone") return std::make_unique<SolidDrawing>(body, view::coneMesh(r, static_cast<float>(height)));
    if (shape == "box")
        return std::make_unique<SolidDrawing>(body, view::boxMesh(0.5 * size, static_cast<float>(edge)));
    std::vector<glm::vec3> positions;
    for (const dvec3& x : meshData->positions) positions.emplace_back(scale * x);
    std::vector<std::uint32_t> triangles;
    for (const auto& t : meshData->triangles)
        for (const int i : t) triangles.push_back(static_cast<std::uint32_t>(i));
    return std::make_unique<SolidDrawing>(body, view::creasedMesh(positions, triangles, creaseAngle));
}

Kind<BodySpec> solidKind() {
    return bodyKind<SolidSpec>();
}

}  // namespace taut::world
