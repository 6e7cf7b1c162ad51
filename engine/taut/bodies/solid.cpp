#include "taut/bodies/solid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "taut/bodies/drawing.h"
#include "taut/bodies/private/bound_mesh.h"
#include "taut/bodies/private/rigid_marks.h"
#include "taut/collision/private/convex_hull.h"
#include "taut/core/trig.h"
#include "taut/fields/private/problems.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/closed_mesh.h"
#include "taut/mechanics/rigid.h"
#include "taut/spec/common_rows.h"
#include "taut/spec/kinds.h"
#include "taut/spec/private/rotation.h"
#include "taut/spec/spec.h"

namespace taut::world {

SolidSpec::SolidSpec() {
    touch = Touch::others;
    thickness = 0.002;
}
TAUT_VALUE_COPIES(SolidSpec);

using fields::FieldList;
using fields::notNegative;
using fields::positive;
using fields::Role;
using fields::Section;

namespace {

constexpr float creaseAngle = 0.6F;  // [rad] drawn edges of a mesh that are sharper stay sharp

enum class In { solid, compound };

std::vector<std::string> shapeNames(In where) {
    std::vector<std::string> names{"box", "sphere", "capsule", "cylinder", "cone", "mesh", "hull"};
    if (where == In::solid) names.emplace_back("compound");
    return names;
}

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

constexpr int prismSides = 24;

// A prism with these radii at its ends, `low` and `high` on the axis y; a pyramid if the second radius is 0. The points
// of the lower end come first.
void addPrism(double radius, double radiusAbove, double low, double high, mechanics::RigidShape& shape) {
    const auto add = [&](double r, double y, int k) {
        const double angle = 2.0 * core::pi * k / prismSides;
        shape.positions.emplace_back(r * core::cosine(angle), y, r * core::sine(angle));
    };
    const bool hasTip = !(radiusAbove > 0);
    add(0.0, low, 0);
    for (int k = 0; k < prismSides; ++k) add(radius, low, k);
    const int top = static_cast<int>(shape.positions.size());
    add(0.0, high, 0);
    for (int k = 0; k < prismSides && !hasTip; ++k) add(radiusAbove, high, k);
    for (int k = 0; k < prismSides; ++k) {
        const int a = 1 + k, b = 1 + (k + 1) % prismSides;
        shape.triangles.push_back({0, a, b});
        if (hasTip) {
            shape.triangles.push_back({top, b, a});
            continue;
        }
        shape.triangles.push_back({a, top + a, b});
        shape.triangles.push_back({b, top + a, top + b});
        shape.triangles.push_back({top, top + b, top + a});
    }
    shape.parts.back().sag = radius * (1.0 - core::cosine(core::pi / prismSides));
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

collision::ShapeSizes sizesOf(const SolidSpec& solid) {
    collision::ShapeSizes sizes;
    sizes.halfSize = 0.5 * solid.size;
    sizes.radius = solid.radius;
    sizes.height = solid.height;
    if (solid.meshData != nullptr)
        for (const dvec3& x : solid.meshData->positions) sizes.vertices.push_back(solid.scale * x);
    return sizes;
}

// A shape of a solid, as it is drawn.
struct Piece {
    view::Mesh mesh;
    std::shared_ptr<const view::Finish> finish;
    glm::mat4 place{1.0F};  // at the start
};

view::Mesh meshOf(const SolidSpec& solid) {
    const auto r = static_cast<float>(solid.radius), height = static_cast<float>(solid.height);
    if (solid.shape == "sphere") return view::sphereMesh(r);
    if (solid.shape == "capsule") return view::capsuleMesh(r, height);
    if (solid.shape == "cylinder") return view::cylinderMesh(r, height);
    if (solid.shape == "cone") return view::coneMesh(r, height);
    if (solid.shape == "box") return view::boxMesh(0.5 * solid.size, static_cast<float>(solid.edge));
    std::vector<glm::vec3> positions;
    for (const dvec3& x : solid.meshData->positions) positions.emplace_back(solid.scale * x);
    std::vector<std::uint32_t> triangles;
    for (const auto& t : solid.meshData->triangles)
        for (const int i : t) triangles.push_back(static_cast<std::uint32_t>(i));
    return view::creasedMesh(positions, triangles, creaseAngle);
}

glm::mat4 matrixOf(const collision::Frame& frame) {
    glm::mat4 m{glm::mat3(frame.rotation)};
    m[3] = glm::vec4(glm::vec3(frame.position), 1.0F);
    return m;
}

// Draws rigid meshes where the inner points say.
class SolidDrawing final : public BodyDrawing {
  public:
    explicit SolidDrawing(const Body& body) : name_(body.fullName()), marks_(marksOf(body)) {
        const auto& spec = dynamic_cast<const SolidSpec&>(*body.spec);
        if (spec.parts.empty()) pieces_.push_back({meshOf(spec), finishOf(spec.finish)});
        for (const SolidSpec& part : spec.parts) pieces_.push_back({meshOf(part), finishOf(part.finish)});
        for (std::size_t k = 0; k < pieces_.size(); ++k) pieces_[k].place = matrixOf(body.pieces[k].at);
    }
    void addSurfaces(std::span<const glm::vec3> positions, std::vector<view::Surface>& surfaces) const override {
        std::array<dvec3, 3> now;
        for (std::size_t k = 0; k < 3; ++k) now[k] = dvec3(positions[static_cast<std::size_t>(marks_.points[k])]);
        const glm::mat4 transform = matrixOf(marks_.motionTo(now));
        for (const Piece& piece : pieces_) {
            view::Surface& surface = surfaces.emplace_back();
            surface.name = name_;
            surface.topology = piece.mesh.topology;
            surface.geometry = piece.mesh.geometry;
            surface.finish = piece.finish;
            surface.transform = transform * piece.place;
        }
    }

  private:
    std::string name_;
    std::vector<Piece> pieces_;
    RigidMarks marks_;
};

// The fields that a solid and a shape of a compound share.
FieldList<SolidSpec> shapeFields(In where) {
    FieldList<SolidSpec> list;
    list.choice("shape", &SolidSpec::shape, shapeNames(where), "Its shape.")
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
        .number("density_kg_per_m3", &SolidSpec::density, "kg/m³", positive,
                "Mass of a cubic metre; of a part, that of the compound if not given.")
        .number("mass_kg", &SolidSpec::mass, "kg", positive, "Its mass, in place of the density.")
        .inPlaceOf("density_kg_per_m3");
    return list;
}

std::string shapeNameOf(const fields::Node& table) {
    return table.textAt("shape");
}

// What has sharp edges and no thickness in the file gets one that fits.
void checkThickness(const fields::CheckInput& input, SolidSpec& solid, const std::string& name) {
    if (solid.isRound()) {
        solid.thickness = solid.radius;
        return;
    }
    const double most = solid.mostThickness();
    if (solid.thickness < most) return;
    if (input.table.find("thickness") != nullptr)
        input.problems.addError(input.at("thickness"),
                                fmt::format("the thickness goes into the {} from all sides: it must be less than the "
                                            "radius of the largest ball in it, {:.3g} m",
                                            name, most));
    else
        solid.thickness = 0.2 * most;
}

Section partSection() {
    Section section;
    section.variant = shapeNameOf;
    section.variantKey = "shape";
    section.fields =
        shapeFields(In::compound)
            .table("finish", &SolidSpec::finish, finishSection(), "How it looks; as the compound if not given.")
            .take();
    return section;
}

// The parts take from the compound what they do not have of their own.
void checkParts(const fields::CheckInput& input, SolidSpec& compound) {
    const fields::Member* rows = input.table.find("parts");
    if (compound.parts.empty() || rows == nullptr)
        return input.problems.addError(input.at("parts"), "a compound needs parts",
                                       "e.g. parts = [{ shape = \"box\", size = [1, 1, 1] }]");
    for (std::size_t k = 0; k < compound.parts.size() && k < rows->value.items.size(); ++k) {
        SolidSpec& part = compound.parts[k];
        const fields::Node& row = rows->value.items[k];
        if (row.find("density_kg_per_m3") == nullptr) part.density = compound.density;
        if (row.find("finish") == nullptr) part.finish = compound.finish;
        part.thickness = compound.thickness;
        part.name = compound.name;
        checkThickness(input, part, fmt::format("{} of part {}", part.shape, k));
    }
    const auto isRound = [](const SolidSpec& part) { return part.isRound(); };
    if (input.table.find("thickness") != nullptr && std::all_of(compound.parts.begin(), compound.parts.end(), isRound))
        input.problems.addWarning(input.at("thickness"), "that of spheres and capsules is their radius",
                                  "leave it out");
    compound.thickness = 0;
    for (const SolidSpec& part : compound.parts) compound.thickness = std::max(compound.thickness, part.thickness);
}

}  // namespace

Section SolidSpec::section() {
    Section section;
    section.help = "A rigid body.";
    section.variant = shapeNameOf;
    section.variantKey = "shape";
    section.fields = shapeFields(In::solid)
                         .tables("parts", &SolidSpec::parts, partSection(), "Shapes joined into one.")
                         .required()
                         .only({"compound"})
                         .number("drag_per_s", &SolidSpec::drag, "1/s", dragRange, "Rate at which still air slows it.")
                         .take();
    section.check = [](const fields::CheckInput& input, void* target) {
        auto& solid = *static_cast<SolidSpec*>(target);
        if (solid.shape != "compound")
            checkThickness(input, solid, solid.shape);
        else if (input.isClean)
            checkParts(input, solid);
    };
    return section;
}

collision::Frame RigidMarks::motionTo(const std::array<dvec3, 3>& now) const {
    const glm::dmat3 turn = mechanics::rotationBetween(rest, now);
    return {turn, now[0] - turn * rest[0], true};
}

RigidMarks marksOf(const Body& body) {
    RigidMarks marks;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto i = 2 * k;
        marks.points[k] = static_cast<int>(i);
        marks.rest[k] = body.model.positions[i] - jitterOf(body, static_cast<int>(i));
    }
    return marks;
}

double SolidSpec::mostThickness() const {
    if (shape == "box") return 0.5 * std::min({size.x, size.y, size.z});
    if (shape == "cylinder") return std::min(radius, 0.5 * height);
    if (shape == "cone") return radius * height / (std::sqrt(height * height + radius * radius) + radius);
    return HUGE_VAL;
}

std::vector<const BodySpec*> SolidSpec::shapes() const {
    std::vector<const BodySpec*> all{this};
    for (const SolidSpec& part : parts) all.push_back(&part);
    return all;
}

std::vector<collision::PlacedConvex> SolidSpec::pieces(const SceneSpec& scene) const {
    const collision::ShapeKinds& kinds = scene.shapes != nullptr ? *scene.shapes : collision::builtInShapes();
    const auto frameOf = [](const SolidSpec& of) {
        return collision::Frame{glm::mat3_cast(rotationOf(of.rotation)), of.position, true};
    };
    const auto pieceOf = [&](const SolidSpec& part) {
        const collision::ShapeKind* kind = kinds.find(part.shape);
        collision::PlacedConvex piece;
        if (kind != nullptr && kind->convex) piece.shape = kind->convex(sizesOf(part), part.thickness);
        return piece;
    };
    std::vector<collision::PlacedConvex> all;
    if (parts.empty()) all.push_back(pieceOf(*this));
    for (const SolidSpec& part : parts) {
        all.push_back(pieceOf(part));
        all.back().at = frameOf(part);
    }
    for (collision::PlacedConvex& piece : all) piece.at = frameOf(*this).of(piece.at);
    return all;
}

// Its shape at its place.
mechanics::RigidShape SolidSpec::made() const {
    mechanics::RigidShape made;
    if (shape == "compound") {
        made.mass = 0;
        for (const SolidSpec& part : parts) join(made, part.made());
    } else {
        addShape(made);
        made.mass = density * made.properties.volume;
    }
    if (mass) made.mass = *mass;
    const glm::dquat turn = rotationOf(rotation);
    made.axes = glm::dmat3(rotated(turn, {1, 0, 0}), rotated(turn, {0, 1, 0}), rotated(turn, {0, 0, 1}));
    made.place = position;
    return made;
}

void SolidSpec::addShape(mechanics::RigidShape& made) const {
    mechanics::RigidPart& part = made.parts.emplace_back();
    part.thickness = thickness;
    const bool isRounded = shape != "mesh" && shape != "hull";
    part.rounding = isRounded ? thickness : 0.0;
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
    } else if (!isRounded && meshData != nullptr) {
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
    part.last = static_cast<int>(made.positions.size());
}

mechanics::Model SolidSpec::build(const SceneSpec&) const {
    const auto isCompound = [](const SolidSpec& own) { return own.shape == "compound"; };
    if (isCompound(*this) == parts.empty() || std::any_of(parts.begin(), parts.end(), isCompound))
        throw core::Error(core::ErrorKind::badContent,
                          at(source) + "a compound, and nothing else, has parts; none of them is a compound");
    mechanics::RigidShape whole = made();
    whole.dragRate = drag;
    mechanics::Model model;
    try {
        model = mechanics::buildRigid(whole);
    } catch (const core::Error& error) {
        throw core::Error(error.kind(), at(source) + error.what());
    }
    // Points of a shape by the side that they are on.
    const auto addSides = [&](const SolidSpec& of, const mechanics::RigidPart& part, const std::string& prefix) {
        static constexpr const char* sides[3][2] = {{"left", "right"}, {"bottom", "top"}, {"back", "front"}};
        for (int i = part.first; i < part.last; ++i) {
            if (part.sag > 0) model.groups[prefix + (i - part.first <= prismSides ? "bottom" : "top")].push_back(i);
            for (int k = 0; k < 3 && of.shape == "box"; ++k)
                model.groups[prefix + sides[k][((i - part.first) >> k) & 1]].push_back(i);
        }
    };
    if (parts.empty()) addSides(*this, model.parts.front(), "");
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const std::string group = fmt::format("part{}", k);
        for (int i = model.parts[k].first; i < model.parts[k].last; ++i) model.groups[group].push_back(i);
        addSides(parts[k], model.parts[k], group + "-");
    }
    return model;
}

std::unique_ptr<BodyDrawing> SolidSpec::drawing(const Body& body) const {
    return std::make_unique<SolidDrawing>(body);
}

// The thickness of a sphere or a capsule is its radius.
Kind<BodySpec> solidKind() {
    Kind<BodySpec> kind = bodyKind<SolidSpec>();
    for (fields::Field& row : kind.section.fields)
        if (row.key == "thickness") row.only = {"box", "cylinder", "cone", "mesh", "hull", "compound"};
    return kind;
}

}  // namespace taut::world
