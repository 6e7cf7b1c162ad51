#include "taut/scene/private/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "taut/plan/private/ties.h"
#include "taut/spec/targets.h"

namespace taut::scene {

namespace {

void report(const NameReference& reference, const std::optional<TargetFault>& fault, Problems& problems) {
    if (fault) problems.addError(reference.place, fault->message, fault->remedy);
}

void checkName(const NameReference& reference, const std::string& kind, const std::vector<std::string>& names,
               Problems& problems) {
    for (const std::string& name : names)
        if (name == reference.text) return;
    std::string remedy = suggestion(reference.text, names);
    if (remedy.empty()) {
        remedy = fmt::format("add a table [{}.{}]", kind, reference.text);
        if (kind == "material") remedy += ", or take a fabric: taut materials lists them";
    }
    if (reference.text.empty()) remedy = "give a name";
    problems.addError(reference.place, fmt::format("there is no {} \"{}\"", kind, reference.text), remedy);
}

// A joint of a figure.
void checkJointName(const NameReference& reference, const world::ColliderTarget& target,
                    const world::ColliderSpec& collider, const world::SceneSpec& scene, Problems& problems) {
    if (!scene.isFigure(collider))
        return problems.addError(reference.place,
                                 fmt::format("{} has no joints: it is a {}", target.collider, collider.shape),
                                 fmt::format("write {}", target.collider));
    if (collider.meshData == nullptr || collider.meshData->figure == nullptr) return;  // already reported
    std::vector<std::string> names;
    for (const figure::Node& node : collider.meshData->figure->nodes)
        if (!node.name.empty()) names.push_back(node.name);
    if (std::find(names.begin(), names.end(), target.joint) != names.end()) return;
    std::string remedy = suggestion(target.joint, names);
    if (remedy.empty()) remedy = names.empty() ? "its nodes have no names" : fmt::format("it has {}", joined(names));
    problems.addError(reference.place, fmt::format("{} has no joint \"{}\"", target.collider, target.joint), remedy);
}

void checkCollider(const NameReference& reference, const std::vector<std::string>& colliders,
                   const world::SceneSpec& scene, Problems& problems) {
    if (std::find(colliders.begin(), colliders.end(), reference.text) != colliders.end()) return;
    const world::ColliderTarget target = world::parseCollider(reference.text);
    for (const world::ColliderSpec& collider : scene.colliders)
        if (!target.joint.empty() && "collider." + collider.name == target.collider)
            return checkJointName(reference, target, collider, scene, problems);
    const auto say = [&](const std::string& message, const std::string& remedy) {
        problems.addError(reference.place, message, remedy);
    };
    if (!world::isCollider(reference.text))
        return say(fmt::format("\"{}\" names no collider", reference.text), "write collider.NAME");
    if (const std::string_view title = world::withoutSelector(reference.text); title != reference.text)
        return say("a collider has no points to choose from", fmt::format("write {}", title));
    std::string remedy = suggestion(target.collider, colliders);
    if (remedy.empty()) remedy = fmt::format("add a table [{}]", target.collider);
    say(fmt::format("there is no {}", target.collider), remedy);
}

void checkHoldOn(const NameReference& reference, const world::SceneSpec& scene, Problems& problems) {
    for (const world::BodySpec& body : scene.bodies)
        if (body.fullName() == reference.owner && body.hold.empty() && body.clamp.empty())
            problems.addError(reference.place, "hold_on attaches the points of hold, and there is no hold",
                              "name the points, e.g. hold = [\"top\"]");
}

// The first difference between two overrides, or nothing.
const char* difference(const world::SolverOverride& a, const world::SolverOverride& b) {
    return a.integrator != b.integrator ? "integrator"
           : a.dt != b.dt               ? "dt"
           : a.safety != b.safety       ? "safety"
           : a == b                     ? nullptr
                                        : "newton_steps, cg_tolerance or cg_iterations";
}

// A joint joins its bodies to one island, which has one method and one step.
void checkJoint(const world::JointSpec& joint, Place place, const BodyIndex& bodies, Problems& problems) {
    std::vector<const BodyEntry*> tied;
    for (const world::JointSide& side : {joint.a, joint.b})
        for (const std::string& target : side.targets)
            for (const BodyEntry* body : bodies.matches(target)) tied.push_back(body);
    if (world::isCollider(joint.a) && world::isCollider(joint.b))
        problems.addError(place, "both sides of this joint are colliders",
                          "one of them has to be points of a body: KIND.NAME@SELECTOR");
    for (const world::JointSide& side : {joint.a, joint.b})
        if (world::isCollider(side) && side.targets.size() > 1)
            problems.addError(place, "a collider is the only element of its side of a joint",
                              "write a [[joint]] for each");
    if (world::isTie(joint)) return;  // with a collider each body stays an island of its own
    for (const BodyEntry* body : tied) {
        const char* what = difference(tied.front()->solver, body->solver);
        if (what == nullptr) continue;
        problems.addError(place,
                          fmt::format("this joint ties {} and {}, whose solver overrides differ in {}",
                                      tied.front()->title(), body->title(), what),
                          "give both the same");
        return;
    }
}

}  // namespace

void checkReferences(const ReadScene& scene, const BodyIndex& bodies, Problems& problems) {
    std::vector<std::string> materials, cameras, colliders;
    for (const auto& [name, material] : scene.spec.materials) materials.push_back(name);
    for (const auto& camera : scene.spec.cameras) cameras.push_back(camera.name);
    for (const auto& collider : scene.spec.colliders) colliders.push_back("collider." + collider.name);

    for (const NameReference& reference : scene.references) {
        problems.about(reference.owner);
        switch (reference.role) {
            case Role::material: checkName(reference, "material", materials, problems); break;
            case Role::camera: checkName(reference, "camera", cameras, problems); break;
            case Role::points: report(reference, bodies.pointsFault(reference.text), problems); break;
            case Role::tieable:
                if (world::isCollider(reference.text))
                    checkCollider(reference, colliders, scene.spec, problems);
                else
                    report(reference, bodies.tieableFault(reference.text), problems);
                break;
            case Role::collider:
                checkCollider(reference, colliders, scene.spec, problems);
                checkHoldOn(reference, scene.spec, problems);
                break;
            case Role::bodies: report(reference, bodies.surfaceFault(reference.text), problems); break;
            case Role::anyBodies: report(reference, bodies.bodyFault(reference.text), problems); break;
            case Role::selector:
                report(reference, bodies.selectorFault(reference.owner, reference.text), problems);
                break;
            default: break;
        }
    }
    problems.about("");
    std::map<std::string, int> count;  // of [[joint]] and of [[seam]]
    for (const world::JointSpec& joint : scene.spec.joints) {
        const std::string section = joint.isSeam() ? "seam" : "joint";
        checkJoint(joint, scene.owners.at(fmt::format("{}[{}]", section, count[section]++)), bodies, problems);
    }
}

std::optional<TargetFault> nameFault(const world::SceneSpec& scene, const std::string& name) {
    std::vector<std::string> names;
    for (const world::JointSpec& joint : scene.joints) {
        if (joint.name == name) return std::nullopt;
        if (!joint.name.empty()) names.push_back(joint.name);
    }
    std::string remedy = suggestion(name, names);
    if (remedy.empty()) remedy = fmt::format("give a [[joint]] name = \"{}\"", name);
    return TargetFault{fmt::format("there is no joint \"{}\"", name), remedy};
}

}  // namespace taut::scene
