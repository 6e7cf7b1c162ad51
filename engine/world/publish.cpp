// The one hand-over from simulation to pictures.
#include <algorithm>
#include <cmath>

#include "taut/world/impl.h"
#include "taut/world/labels.h"
#include "taut/world/motion.h"

namespace taut::world {
namespace {

constexpr float frozenDullness = 0.93F;
constexpr double fullStrain = 0.02;  // strain that the debug view draws in full colour

// Blue when compressed, grey at rest, red when stretched.
glm::vec3 strainColour(double strain) {
    const auto share = static_cast<float>(std::clamp(strain / fullStrain, -1.0, 1.0));
    const glm::vec3 rest(0.55F), stretched(1.0F, 0.12F, 0.05F), compressed(0.05F, 0.25F, 1.0F);
    return share >= 0 ? glm::mix(rest, stretched, share) : glm::mix(rest, compressed, -share);
}

void addMarks(const Island& island, view::Marks& marks) {
    const IslandPlan& plan = island.plan();
    for (std::size_t i = 0; i < plan.springs.size(); ++i) {
        const mechanics::Spring& s = plan.springs[i];
        if (s.kind == mechanics::SpringKind::bend || plan.broken[i]) continue;  // bend: on top of the structural ones
        const dvec3 a = island.position(s.a), b = island.position(s.b);
        const double l = std::sqrt(glm::dot(b - a, b - a));
        marks.lines.push_back(
            {glm::vec3(a), glm::vec3(b), strainColour(s.restLength > 0 ? l / s.restLength - 1.0 : 0.0)});
    }
    const std::vector<bool> isHeld = heldPointsOf(plan);
    for (std::size_t i = 0; i < plan.points.size(); ++i) {
        const glm::vec3 at(island.position(static_cast<int>(i)));
        if (isHeld[i])
            marks.dots.push_back({at, glm::vec3(0.95F, 0.75F, 0.05F), 3.0F});
        else
            marks.dots.push_back({at, glm::vec3(0.02F), 0.8F});
    }
    for (const collision::Contact& contact : island.contacts())
        marks.dots.push_back({glm::vec3(contact.position), glm::vec3(0.1F, 0.85F, 0.2F), 2.5F});
}

// Between bodies: what presses, with a line as long as both keep apart, and what goes through what.
void addTouchMarks(WorldImpl& w, view::Marks& marks) {
    const glm::vec3 pressing(0.05F, 0.75F, 0.95F), crossing(1.0F, 0.0F, 0.1F);
    for (const BodyContact& c : w.touchWatch.contacts()) {
        const dvec3 way = 0.5 * (c.first->spec->thickness + c.second->spec->thickness) * c.normal;
        marks.lines.push_back({glm::vec3(c.place - way), glm::vec3(c.place + way), pressing});
        marks.dots.push_back({glm::vec3(c.place), pressing, 2.5F});
    }
    if (!w.touchesAny()) return;
    for (const BodyCrossing& c : w.crossings()) marks.dots.push_back({glm::vec3(c.place), crossing, 4.0F});
}

view::Light lightOf(const LightSpec& spec) {
    view::Light light;
    light.direction = glm::normalize(glm::vec3(spec.direction));
    light.colour = static_cast<float>(spec.intensity) * linearColour(spec.colour);
    light.sky = static_cast<float>(spec.ambient) * linearColour(spec.sky);
    light.ground = static_cast<float>(spec.ambient) * linearColour(spec.ground);
    light.softness = static_cast<float>(spec.softness);
    return light;
}

}  // namespace

view::FrameView World::view(bool debug) const {
    const Impl& w = *impl_;
    view::FrameView view;
    view.frame = w.tick / w.ticksPerFrame;
    view.time = time();
    view.light = lightOf(w.spec.light);
    view.background = {linearColour(w.spec.background.top), linearColour(w.spec.background.horizon),
                       static_cast<float>(w.spec.background.fadeStart), static_cast<float>(w.spec.background.fadeEnd),
                       w.spec.background.fadesWithCamera};
    bool chosen = false;
    w.registry.each<CameraPart>([&](ecs::Entity, const CameraPart& part) {
        if (chosen || (!w.spec.picture.camera.empty() && part.spec.name != w.spec.picture.camera)) return;
        view.camera = cameraAt(part.spec, time());
        chosen = true;
    });
    w.registry.each<ColliderPart, Placement>([&](ecs::Entity, const ColliderPart& part, const Placement& placement) {
        if (part.spec.visible && part.model->isGround && !view.ground) {
            view.ground = view::Ground{};
            view.ground->height = static_cast<float>(placement.to.position.y);
            view.ground->colour = linearColour(part.spec.finish.colour);
        }
        for (const ColliderModel::Piece& piece : part.model->pieces)
            view.surfaces.push_back({part.spec.name, piece.mesh.topology, piece.mesh.geometry, piece.finish,
                                     matrixOf(placement.to) * piece.transform, part.spec.shape == "plane"});
    });
    std::vector<Body*> bodies;
    for (const Impl::Member& member : w.bodies) {
        const BodyPart& part = *w.registry.find<BodyPart>(member.entity);
        const Island& island = w.islandOf(*part.body);
        bodies.push_back(part.body.get());
        std::vector<glm::vec3> positions;
        positions.reserve(part.body->pointOf.size());
        for (int i : part.body->pointOf) positions.emplace_back(island.position(i));
        const std::size_t first = view.surfaces.size();
        part.drawing->addSurfaces(positions, view.surfaces);
        if (island.frozen() == nullptr) continue;
        for (std::size_t i = first; i < view.surfaces.size(); ++i) view.surfaces[i].dulled = frozenDullness;
    }
    for (const LabelSpec& label : w.spec.labels) {
        std::vector<LabelSubject> subjects;
        for (const Body* body : matchBodies(bodies, label.of)) subjects.push_back({body, &w.islandOf(*body)});
        addLabels(label, subjects, view.labels);
    }
    view.showMarks = debug;
    if (!debug) return view;
    for (const auto& island : w.islands) addMarks(*island, view.marks);
    addTouchMarks(*impl_, view.marks);
    for (const Hand& hand : w.hands)
        view.marks.dots.push_back({glm::vec3(hand.placeAt(w.tick)), glm::vec3(1.0F, 0.35F, 0.05F), 5.0F});
    return view;
}

}  // namespace taut::world
