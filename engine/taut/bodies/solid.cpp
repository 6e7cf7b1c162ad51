#include "taut/bodies/solid.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/bodies/private/rigid_marks.h"
#include "taut/drawing/drawing.h"
#include "taut/drawing/private/bound_mesh.h"
#include "taut/fields/private/problems.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/closed_mesh.h"
#include "taut/mechanics/rigid.h"
#include "taut/spec/common_rows.h"
#include "taut/spec/kinds.h"
#include "taut/spec/private/rotation.h"
#include "taut/spec/private/shape_rows.h"
#include "taut/spec/spec.h"

namespace taut::world {

SolidSpec::SolidSpec() {
    touch = Touch::others;
    thickness = 0.002;
    shape = "box";
    size = dvec3(0.5);
    radius = 0.25;
    height = 0.5;
    edge = 0.0;
}
TAUT_VALUE_COPIES(SolidSpec);

using fields::FieldList;
using fields::notNegative;
using fields::positive;
using fields::Section;

namespace {

using collision::Extent;
using collision::ShapeKind;
using collision::ShapeKinds;

// A shape of a solid, as it is drawn.
struct Piece {
    view::Mesh mesh;
    std::shared_ptr<const view::Finish> finish;
    glm::mat4 place{1.0F};  // at the start
};

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
        for (std::size_t k = 0; k < body.pieces.size(); ++k) {
            const RigidPiece& piece = body.pieces[k];
            pieces_.push_back(
                {piece.mesh, finishOf((spec.parts.empty() ? spec : spec.parts[k]).finish), matrixOf(piece.at)});
        }
    }
    void addSurfaces(std::span<const glm::vec3> positions, std::vector<view::Surface>& surfaces) const override {
        std::array<dvec3, 3> now;
        for (std::size_t k = 0; k < 3; ++k) now[k] = dvec3(positions[marks_.points[k]]);
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

bool isSolid(const ShapeKind& kind) {
    return kind.solid || kind.extent == Extent::parts;
}
// The shapes that solids may have.
ShapeKinds solidShapes(const ShapeKinds& shapes) {
    return shapesThat(shapes, isSolid);
}
ShapeKinds solidParts(const ShapeKinds& shapes) {
    return shapesThat(
        shapes, [](const ShapeKind& kind) { return static_cast<bool>(kind.solid); });
}

// The fields that a solid and a shape of a compound share.
FieldList<SolidSpec> solidRows(const ShapeKinds& shapes) {
    FieldList<SolidSpec> list =
        shapeRows<SolidSpec>(shapes, "OBJ or glTF file; its surfaces are closed, except for a hull.");
    list.number("edge", &SolidSpec::edge, "m", notNegative, "Radius of the drawn edges.")
        .only(namesOf(solidParts(shapes), "edge"))
        .number("density_kg_per_m3", &SolidSpec::density, "kg/m³", positive,
                "Density; of a part by default that of the compound.")
        .number("mass_kg", &SolidSpec::mass, "kg", positive, "Mass, instead of the density.")
        .inPlaceOf("density_kg_per_m3");
    return list;
}

// A solid with sharp edges and no thickness in the file gets a suitable one.
void checkThickness(const fields::CheckInput& input, const ShapeKind& kind, SolidSpec& solid, const std::string& name) {
    if (!kind.largestBall) return;
    const double most = kind.largestBall(sizesOf(solid, kind));
    if (kind.isRound) solid.thickness = most;
    if (kind.isRound || solid.thickness < most) return;
    if (input.table.find("thickness") != nullptr)
        input.problems.addError(input.at("thickness"),
                                fmt::format("the thickness goes into the {} from all sides: it must be less than the "
                                            "radius of the largest ball in it, {:.3g} m",
                                            name, most));
    else
        solid.thickness = 0.2 * most;
}

Section partSection(const ShapeKinds& shapes) {
    Section section;
    section.variant = shapeNameIn;
    section.variantKey = "shape";
    section.fields =
        solidRows(solidParts(shapes))
            .table("finish", &SolidSpec::finish, finishSection(), "Appearance; default that of the compound.")
            .take();
    return section;
}

// The parts inherit missing values from the compound.
void checkParts(const fields::CheckInput& input, const ShapeKinds& shapes, SolidSpec& compound) {
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
        checkThickness(input, shapeKindOf(part, shapes), part, fmt::format("{} of part {}", part.shape, k));
    }
    const auto isRound = [&](const SolidSpec& part) { return shapeKindOf(part, shapes).isRound; };
    if (input.table.find("thickness") != nullptr && std::all_of(compound.parts.begin(), compound.parts.end(), isRound))
        input.problems.addWarning(input.at("thickness"), "that of spheres and capsules is their radius",
                                  "leave it out");
    compound.thickness = 0;
    for (const SolidSpec& part : compound.parts) compound.thickness = std::max(compound.thickness, part.thickness);
}

}  // namespace

Section SolidSpec::section(const ShapeKinds& known) {
    const ShapeKinds shapes = solidShapes(known);
    Section section;
    section.help = "A rigid body.";
    section.variant = shapeNameIn;
    section.variantKey = "shape";
    section.fields =
        solidRows(shapes)
            .tables("parts", &SolidSpec::parts, partSection(shapes), "Shapes joined into one.")
            .required()
            .only(namesOf(shapes, "parts"))
            .number("rolling_friction", &BodySpec::turnFriction, &core::TurnFriction::rolling, "m", lengthOfTorque,
                    rollingHelp)
            .number("spin_friction", &BodySpec::turnFriction, &core::TurnFriction::spin, "m", lengthOfTorque, spinHelp)
            .number("drag_per_s", &SolidSpec::drag, "1/s", dragRange, "Rate at which still air slows it.")
            .take();
    section.check = [shapes](const fields::CheckInput& input, void* target) {
        auto& solid = *static_cast<SolidSpec*>(target);
        const ShapeKind* kind = shapes.find(solid.shape);
        if (kind == nullptr) return;  // reported already
        if (kind->extent != Extent::parts)
            checkThickness(input, *kind, solid, solid.shape);
        else if (input.isClean)
            checkParts(input, shapes, solid);
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

std::vector<const BodySpec*> SolidSpec::shapes() const {
    std::vector<const BodySpec*> all{this};
    for (const SolidSpec& part : parts) all.push_back(&part);
    return all;
}

const ShapeKind& SolidSpec::kindIn(const ShapeKinds& kinds) const {
    const ShapeKind* kind = kinds.find(shape);
    if (kind == nullptr || !isSolid(*kind))
        throw core::Error(core::ErrorKind::badContent,
                          at(source) + fmt::format("there is no solid of shape \"{}\"", shape));
    return *kind;
}

collision::Frame SolidSpec::axes() const {
    return {glm::mat3_cast(rotationOf(rotation)), position, true};
}

RigidPiece SolidSpec::piece(const ShapeKinds& kinds) const {
    const ShapeKind& kind = kindIn(kinds);
    const collision::ShapeSizes own = sizesOf(*this, kind);
    RigidPiece piece;
    piece.at = axes();
    if (kind.convex) piece.shape = kind.convex(own, thickness);
    piece.mesh = kind.mesh(own);
    return piece;
}

std::vector<RigidPiece> SolidSpec::pieces(const SceneSpec& scene) const {
    if (parts.empty()) return {piece(scene.knownShapes())};
    std::vector<RigidPiece> all;
    for (const SolidSpec& part : parts) {
        all.push_back(part.piece(scene.knownShapes()));
        all.back().at = axes().of(all.back().at);
    }
    return all;
}

// Its shape at its place.
mechanics::RigidShape SolidSpec::made(const ShapeKinds& kinds) const {
    mechanics::RigidShape made;
    if (!parts.empty()) {
        made.mass = 0;
        for (const SolidSpec& part : parts) join(made, part.made(kinds));
    } else {
        addShape(kindIn(kinds), made);
        made.mass = density * made.properties.volume;
    }
    if (mass) made.mass = *mass;
    const glm::dquat turn = rotationOf(rotation);
    made.axes = glm::dmat3(rotated(turn, {1, 0, 0}), rotated(turn, {0, 1, 0}), rotated(turn, {0, 0, 1}));
    made.place = position;
    return made;
}

void SolidSpec::addShape(const ShapeKind& kind, mechanics::RigidShape& made) const {
    collision::SolidShape own;
    const auto fail = [&](const core::Error& fault, int triangle) {
        throw core::Error(
            fault.kind(),
            at(source) + (meshData == nullptr ? fault.what() : meshFaultText(*this, fault.what(), triangle)));
    };
    try {
        own = kind.solid(sizesOf(*this, kind), thickness);
        if (!own.properties) mechanics::expectClosed(own.positions, own.triangles);
    } catch (const mechanics::MeshFault& fault) {
        fail(fault, fault.triangle);
    } catch (const core::Error& fault) {
        fail(fault, -1);
    }
    made.properties = own.properties ? *own.properties : core::massPropertiesOf(own.positions, own.triangles);
    mechanics::RigidPart& part = made.parts.emplace_back();
    part.last = static_cast<int>(own.positions.size());
    part.thickness = thickness;
    part.rounding = kind.largestBall ? thickness : 0.0;
    part.sag = own.sag;
    made.positions = std::move(own.positions);
    made.triangles = std::move(own.triangles);
    made.lines = std::move(own.lines);
    made.groups = std::move(own.sides);
}

mechanics::Model SolidSpec::build(const SceneSpec& scene) const {
    const ShapeKinds& kinds = scene.knownShapes();
    const auto isCompound = [&](const SolidSpec& own) { return own.kindIn(kinds).extent == Extent::parts; };
    if (isCompound(*this) == parts.empty() || std::any_of(parts.begin(), parts.end(), isCompound))
        throw core::Error(core::ErrorKind::badContent,
                          at(source) + "a compound, and nothing else, has parts; none of them is a compound");
    mechanics::RigidShape whole = made(kinds);
    whole.dragRate = drag;
    try {
        return mechanics::buildRigid(whole);
    } catch (const core::Error& error) {
        throw core::Error(error.kind(), at(source) + error.what());
    }
}

std::unique_ptr<BodyDrawing> SolidSpec::drawing(const Body& body) const {
    return std::make_unique<SolidDrawing>(body);
}

// The thickness of a round shape is its radius.
Kind<BodySpec> solidKind() {
    Kind<BodySpec> kind = bodyKind<SolidSpec>();
    kind.sectionWith = [rest = bodyRows<SolidSpec>()](const ShapeKinds& known) {
        Section section = SolidSpec::section(known);
        section.fields.insert(section.fields.end(), rest.begin(), rest.end());
        for (fields::Field& row : section.fields)
            if (row.key == "thickness")
                row.only = namesOf(shapesThat(solidShapes(known), [](const ShapeKind& own) { return !own.isRound; }));
        return section;
    };
    kind.section = kind.sectionWith(collision::builtInShapes());
    return kind;
}

}  // namespace taut::world
