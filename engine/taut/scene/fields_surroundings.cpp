// The field table, part three: joints, seams, masses and colliders.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "taut/fields/field_list.h"
#include "taut/fields/private/problems.h"
#include "taut/joints/joints.h"
#include "taut/plan/private/ties.h"
#include "taut/scene/private/merged_rows.h"
#include "taut/scene/private/sections.h"
#include "taut/spec/private/shape_rows.h"

namespace taut::scene {

using namespace world;

namespace {

Section poseKeySection() {
    Section section;
    section.fields = FieldList<PoseKey>()
                         .number("t", &PoseKey::t, "s", Range{0.0, 1e6}, "Moment.")
                         .required()
                         .role(Role::time)
                         .vector("position", &PoseKey::position, "m", placeRange, "Position of its centre.")
                         .rotation("rotation_deg", &PoseKey::rotation, "Rotation about x, then y, then z.")
                         .choice("ease", &PoseKey::ease, easeNames(), "Easing from the key before to this one.")
                         .take();
    return section;
}

collision::ShapeKinds partsOf(const collision::ShapeKinds& shapes) {
    return shapesThat(
        shapes, [](const auto& kind) { return kind.extent == collision::Extent::bounded; });
}

constexpr const char* colliderMesh = "OBJ or glTF file.";

Section partSection(const collision::ShapeKinds& shapes) {
    Section section;
    section.variant = shapeNameIn;
    section.variantKey = "shape";
    section.fields =
        shapeRows<ColliderSpec>(partsOf(shapes), colliderMesh)
            .table("finish", &ColliderSpec::ownFinish, finishSection(), "Appearance; default that of the compound.")
            .take();
    return section;
}

void checkCollider(const CheckInput& input, ColliderSpec& collider) {
    checkAscending(input);
    if (input.table.find("finish") != nullptr) collider.ownFinish = collider.finish;
    collider.normal /= std::sqrt(glm::dot(collider.normal, collider.normal));
    if (input.isClean && input.table.find("parts") != nullptr && collider.parts.empty())
        input.problems.addError(input.at("parts"), "a compound needs parts");
    if (input.table.find("keys") == nullptr) return;
    for (const char* key : {"position", "rotation_deg"}) {
        const Member* member = input.table.find(key);
        if (member == nullptr) continue;
        input.problems.addError(member->place, fmt::format("a collider with keys has no {} of its own", key),
                                "write it into the keys");
    }
}

// The titles of a joint between bodies and, if a kind has fields for one of the two only, of a joint with a collider.
std::vector<std::string> variantsOf(const Kind<JointSpec>& kind) {
    const std::string title(kind.make()->title());
    const std::vector<Field>& rows = kind.section.fields;
    if (std::all_of(rows.begin(), rows.end(), [](const Field& row) { return row.only.empty(); })) return {title};
    return {title, title + " to a collider"};
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

SceneSection jointSection(const KindTable<JointSpec>& kinds) {
    SceneSection section;
    section.name = "joint";
    section.layout = Layout::list;
    section.help = "Ties points of bodies to each other, or to a collider that carries them.";
    // The variant depends on the kind, and on whether a side is a collider.
    section.variant = [kinds](const Node& table) -> std::string {
        const Member* kind = table.find("kind");
        const Kind<JointSpec>* row = kind != nullptr ? kinds.find(kind->value.text) : nullptr;
        const std::vector<std::string> variants = variantsOf(row != nullptr ? *row : kinds.all().front());
        const auto isOn = [&](const char* key) {
            const Member* side = table.find(key);
            return side != nullptr && (isCollider(side->value.text) ||
                                       std::any_of(side->value.items.begin(), side->value.items.end(),
                                                   [](const Node& item) { return isCollider(item.text); }));
        };
        return isOn("a") || isOn("b") ? variants.back() : variants.front();
    };
    // The field `kind` chooses the struct; it is not stored.
    Field what;
    what.key = "kind";
    what.kind = FieldKind::choice;
    what.write = [](void*, const Value&) {};
    what.read = [first = kinds.all().front().name](const void*) { return Value(first); };
    std::map<std::string, std::function<std::unique_ptr<JointSpec>()>> makers;  // by variant
    for (const Kind<JointSpec>& kind : kinds.all()) {
        what.choices.push_back(kind.name);
        what.help += (what.help.empty() ? "" : " ") + kind.section.help;
        for (const std::string& variant : variantsOf(kind)) {
            section.forms.push_back(kind.section);
            section.forms.back().name = variant;
            makers[variant] = kind.make;
        }
    }
    // Enters a joint of its variant. The fields of all kinds stand together.
    section.enter = [makers, first = kinds.all().front().make](SceneSpec& scene, const std::string& variant,
                                                               const Source& source) -> void* {
        const auto maker = makers.find(variant);
        JointSpec& joint = scene.joints.add(maker != makers.end() ? maker->second() : first());
        joint.source = source;
        return dynamic_cast<void*>(&joint);
    };
    section.fields = mergedRows(kinds.all(), [](const Kind<JointSpec>& kind, const Field& field) {
        return field.only.empty() ? variantsOf(kind) : field.only;
    });
    section.fields.insert(section.fields.begin() + 2, what);
    return section;
}

SceneSection seamSection() {
    const Kind<JointSpec> kind = seamKind();
    SceneSection section{kind.section, {}, {}};
    section.name = kind.name;
    section.layout = Layout::list;
    section.enter = [make = kind.make](SceneSpec& scene, const std::string&, const Source& source) -> void* {
        JointSpec& seam = scene.joints.add(make());
        seam.source = source;
        return dynamic_cast<void*>(&seam);
    };
    return section;
}

SceneSection massSection() {
    return sectionOf(
        "mass", "Mass added to points.", &SceneSpec::masses,
        FieldList<MassSpec>()
            .text("target", &MassSpec::target, Role::points, "Points: KIND.NAME@SELECTOR.")
            .required()
            .number("mass_kg", &MassSpec::mass, "kg", positive, "Added mass, shared evenly among the points.")
            .required()
            .take(),
        Layout::list);
}

SceneSection colliderSection(const collision::ShapeKinds& shapes) {
    SceneSection section = sectionOf(
        "collider", "A rigid obstacle, at rest or moved by keys.", &SceneSpec::colliders,
        shapeRows<ColliderSpec>(shapes, colliderMesh)
            .direction("normal", &ColliderSpec::normal, "Direction away from the solid; any length.")
            .only(namesOf(shapes, "normal"))
            .tables("parts", &ColliderSpec::parts, partSection(shapes), "Shapes joined into one.")
            .required()
            .only(namesOf(shapes, "parts"))
            .number("friction", &ColliderSpec::friction, "", Range{0.0, 100.0}, "Coulomb's coefficient.")
            .ramps(Affects::colliders)
            .number("restitution", &ColliderSpec::restitution, "", share, "Speed after a bounce over speed before.")
            .ramps(Affects::colliders)
            .number("rolling_friction", &ColliderSpec::turnFriction, &core::TurnFriction::rolling, "m",
                    world::lengthOfTorque, world::rollingHelp)
            .ramps(Affects::colliders)
            .number("spin_friction", &ColliderSpec::turnFriction, &core::TurnFriction::spin, "m", world::lengthOfTorque,
                    world::spinHelp)
            .ramps(Affects::colliders)
            .text("animation", &ColliderSpec::animation, Role::none, "Animation of the file.")
            .only(namesOf(shapes, "animation"))
            .number("start_s", &ColliderSpec::start, "s", placeRange,
                    "Time of the animation at the start; below 0 the figure waits.")
            .only(namesOf(shapes, "animation"))
            .number("speed", &ColliderSpec::speed, "", placeRange, "Speed of the animation.")
            .only(namesOf(shapes, "animation"))
            .flag("loop", &ColliderSpec::loops, "Whether the animation repeats.")
            .only(namesOf(shapes, "animation"))
            .tables("keys", &ColliderSpec::keys, poseKeySection(), "Keyframes, in the order of time.")
            .flag("visible", &ColliderSpec::visible, "Whether it is drawn.")
            .number("edge", &ColliderSpec::edge, "m", Range{0.0, 1e3},
                    "Radius of a drawn box's edges, except at its foot on the ground.")
            .only(namesOf(shapes, "edge"))
            .table("finish", &ColliderSpec::finish, finishSection(), "Appearance.")
            .take());
    section.variant = shapeNameIn;
    section.variantKey = "shape";
    section.check = [](const CheckInput& input, void* target) {
        checkCollider(input, *static_cast<ColliderSpec*>(target));
    };
    return section;
}

}  // namespace taut::scene
