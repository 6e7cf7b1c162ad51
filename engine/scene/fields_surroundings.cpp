// The field table, part three: joints, masses, anchors, colliders and winds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "taut/collision/shape_table.h"
#include "taut/fields/field_list.h"
#include "taut/scene/sections.h"
#include "taut/fields/problems.h"

namespace taut::scene {

using namespace world;

namespace {

// The names of the shapes that have a use for this field.
std::vector<std::string> shapesWith(std::string_view field) {
    std::vector<std::string> names;
    for (const collision::ShapeKind& kind : collision::builtInShapes().all())
        if (std::find(kind.fields.begin(), kind.fields.end(), field) != kind.fields.end())
            names.emplace_back(kind.name);
    return names;
}

enum class In { collider, compound };

std::vector<std::string> shapeNames(In where) {
    std::vector<std::string> names;
    for (const collision::ShapeKind& kind : collision::builtInShapes().all())
        if (where == In::collider || kind.isBounded) names.emplace_back(kind.name);
    if (where == In::collider) names.emplace_back("compound");
    return names;
}

// The sizes and the place of a shape: what a collider and a part of a compound have in common.
FieldList<ColliderSpec> shapeFields(In where) {
    FieldList<ColliderSpec> list;
    list.choice("shape", &ColliderSpec::shape, shapeNames(where), "Its shape.")
        .required()
        .vector("position", &ColliderSpec::position, "m", placeRange, "Its centre.")
        .rotation("rotation_deg", &ColliderSpec::rotation, "About x, then y, then z.")
        .vector("size", &ColliderSpec::size, "m", lengthRange, "Its three edges.")
        .only(shapesWith("size"))
        .number("radius", &ColliderSpec::radius, "m", lengthRange, "Its radius.")
        .only(shapesWith("radius"))
        .number("height", &ColliderSpec::height, "m", lengthRange,
                "Whole height along y; of a capsule between the centres of its half spheres.")
        .only(shapesWith("height"))
        .text("mesh", &ColliderSpec::mesh, Role::mesh, "OBJ file.")
        .required()
        .only(shapesWith("mesh"))
        .number("scale", &ColliderSpec::scale, "", lengthRange, "Metres of a unit of the file.")
        .only(shapesWith("scale"));
    for (const collision::ShapeKind& kind : collision::builtInShapes().all())
        for (const collision::OwnSize& own : kind.own)
            list.entry(own.key, &ColliderSpec::sizes, own.unit, Range{own.least, own.most}, own.standard, own.help)
                .only({std::string(kind.name)});
    return list;
}

std::string shapeOf(const Node& table) {
    const Member* shape = table.find("shape");
    return shape != nullptr && shape->value.kind == NodeKind::text ? shape->value.text : "";
}

Section poseKeySection() {
    Section section;
    section.fields = FieldList<PoseKey>()
                         .number("t", &PoseKey::t, "s", Range{0.0, 1e6}, "Moment.")
                         .required()
                         .role(Role::time)
                         .vector("position", &PoseKey::position, "m", placeRange, "Where its centre is then.")
                         .rotation("rotation_deg", &PoseKey::rotation, "About x, then y, then z.")
                         .choice("ease", &PoseKey::ease, easeNames(), "Way from the key before to this one.")
                         .take();
    return section;
}

Section partSection() {
    Section section;
    section.variant = shapeOf;
    section.variantKey = "shape";
    section.fields = shapeFields(In::compound).take();
    return section;
}

void checkCollider(const CheckInput& input, ColliderSpec& collider) {
    checkAscending(input);
    collider.normal /= std::sqrt(glm::dot(collider.normal, collider.normal));
    if (input.isClean && collider.shape == "compound" && collider.parts.empty()) {
        input.problems.addError(input.at("parts"), "a compound needs parts");
    }
    if (input.table.find("keys") == nullptr) return;
    for (const char* key : {"position", "rotation_deg"}) {
        const Member* member = input.table.find(key);
        if (member == nullptr) continue;
        input.problems.addError(member->place, fmt::format("a collider with keys has no {} of its own", key),
                                "write it into the keys");
    }
}

}  // namespace

void checkAscending(const CheckInput& input) {
    const Member* keys = input.table.find("keys");
    if (keys == nullptr) return;
    bool isFirst = true;
    double before = 0;
    for (const Node& item : keys->value.items) {
        const Member* t = item.find("t");
        if (t == nullptr || (t->value.kind != NodeKind::number && t->value.kind != NodeKind::whole)) continue;
        if (!isFirst && t->value.number <= before) {
            input.problems.addError(t->value.place,
                                    fmt::format("keys must ascend in t: {} follows {}", t->value.number, before));
        }
        isFirst = false;
        before = t->value.number;
    }
}

SceneSection jointSection() {
    SceneSection section;
    section.name = "joint";
    section.layout = Layout::list;
    section.help = "Ties points of one body to points of another.";
    section.enter = enterNamed(&SceneSpec::joints);
    section.variant = [](const Node& table) -> std::string {
        const Member* kind = table.find("kind");
        return kind != nullptr && kind->value.text == "spring" ? "a spring joint" : "a weld";
    };
    section.fields = FieldList<JointSpec>()
                         .text("a", &JointSpec::a, Role::points, "Points of one body: KIND.NAME@SELECTOR.")
                         .required()
                         .text("b", &JointSpec::b, Role::points, "Points of the other.")
                         .required()
                         .choice("kind", &JointSpec::kind, {"weld", "spring"}, "Points made one, or springs.")
                         .number("stiffness_N_per_m", &JointSpec::stiffness, "N/m", positive, "Of each spring.")
                         .only({"a spring joint"})
                         .number("damping_time_s", &JointSpec::dampingTime, "s", Range{0.0, 1e3}, "Of each spring.")
                         .only({"a spring joint"})
                         .number("reach_m", &JointSpec::reach, "m", Range{0.0, 1e3},
                                 "Largest distance of two points that a weld makes one.")
                         .only({"a weld"})
                         .take();
    return section;
}

SceneSection massSection() {
    SceneSection section;
    section.name = "mass";
    section.layout = Layout::list;
    section.help = "Adds mass to points.";
    section.enter = enterNamed(&SceneSpec::masses);
    section.fields = FieldList<MassSpec>()
                         .text("target", &MassSpec::target, Role::points, "The points: KIND.NAME@SELECTOR.")
                         .required()
                         .number("mass_kg", &MassSpec::mass, "kg", positive, "Shared evenly among the points.")
                         .required()
                         .take();
    return section;
}

SceneSection anchorSection() {
    SceneSection section;
    section.name = "anchor";
    section.layout = Layout::named;
    section.help = "Springs of no length from points to a place.";
    section.enter = enterNamed(&SceneSpec::anchors);
    section.existing = findNamed(&SceneSpec::anchors);
    section.fields = FieldList<AnchorSpec>()
                         .text("target", &AnchorSpec::target, Role::points, "The points: KIND.NAME@SELECTOR.")
                         .required()
                         .vector("at", &AnchorSpec::at, "m", placeRange, "The place.")
                         .ramps(Affects::forces)
                         .required()
                         .number("stiffness_N_per_m", &AnchorSpec::stiffness, "N/m", notNegative, "Of each point.")
                         .ramps(Affects::forces)
                         .number("damping_kg_per_s", &AnchorSpec::damping, "kg/s", notNegative, "Of each point.")
                         .ramps(Affects::forces)
                         .take();
    return section;
}

SceneSection colliderSection() {
    SceneSection section;
    section.name = "collider";
    section.layout = Layout::named;
    section.help = "A rigid thing that stops bodies, still or moved by keys.";
    section.enter = enterNamed(&SceneSpec::colliders);
    section.existing = findNamed(&SceneSpec::colliders);
    section.variant = shapeOf;
    section.variantKey = "shape";
    std::vector<std::string> edged = shapesWith("edge");  // and what may have such parts
    edged.emplace_back("compound");
    section.fields =
        shapeFields(In::collider)
            .direction("normal", &ColliderSpec::normal, "Away from the solid; any length.")
            .only(shapesWith("normal"))
            .tables("parts", &ColliderSpec::parts, partSection(), "Shapes joined into one.")
            .required()
            .only({"compound"})
            .number("friction", &ColliderSpec::friction, "", Range{0.0, 100.0}, "Coulomb's coefficient.")
            .ramps(Affects::colliders)
            .number("restitution", &ColliderSpec::restitution, "", share, "Speed after a bounce over speed before.")
            .ramps(Affects::colliders)
            .tables("keys", &ColliderSpec::keys, poseKeySection(), "Keyframes, in the order of time.")
            .flag("visible", &ColliderSpec::visible, "Whether it is drawn.")
            .number("edge", &ColliderSpec::edge, "m", Range{0.0, 1e3}, "Rounding of a drawn box's edges.")
            .only(edged)
            .table("finish", &ColliderSpec::finish, finishSection(), "How it looks.")
            .take();
    section.check = [](const CheckInput& input, void* target) {
        checkCollider(input, *static_cast<ColliderSpec*>(target));
    };
    return section;
}

SceneSection windSection() {
    Section gust;
    gust.fields = FieldList<WindSpec>()
                      .number("amplitude", &WindSpec::gustAmplitude, "m/s", Range{0.0, 1e3}, "Strength.")
                      .ramps(Affects::forces)
                      .number("period_s", &WindSpec::gustPeriod, "s", Range{1e-3, 1e6}, "Time of a change.")
                      .number("length_m", &WindSpec::gustLength, "m", Range{1e-3, 1e6}, "Size of an eddy.")
                      .whole("seed", &WindSpec::gustSeed, "", Range{0.0, 1e12}, "Seed: the same gusts each time.")
                      .take();
    SceneSection section;
    section.name = "wind";
    section.layout = Layout::named;
    section.help = "Moving air; acts on surfaces.";
    section.enter = enterNamed(&SceneSpec::winds);
    section.existing = findNamed(&SceneSpec::winds);
    section.fields =
        FieldList<WindSpec>()
            .vector("velocity", &WindSpec::velocity, "m/s", Range{-1e3, 1e3}, "Mean velocity.")
            .ramps(Affects::forces)
            .tableOfSelf("gust", gust, "How it changes in space and time.")
            .number("drag", &WindSpec::drag, "", Range{0.0, 100.0}, "Drag coefficient across the flow.")
            .ramps(Affects::forces)
            .number("lift", &WindSpec::lift, "", Range{0.0, 100.0}, "Lift coefficient.")
            .ramps(Affects::forces)
            .texts("on", &WindSpec::on, Role::bodies, "Bodies it acts on, e.g. \"cloth.*\"; every cloth if not given.")
            .take();
    return section;
}

}  // namespace taut::scene
