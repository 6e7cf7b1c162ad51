#include "taut/world/private/publish.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "taut/drawing/drawing.h"
#include "taut/world/private/bodies.h"
#include "taut/world/private/cameras.h"
#include "taut/world/private/colliders.h"
#include "taut/world/private/drawn_contact.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/labels.h"
#include "taut/world/private/tick.h"

namespace taut::world {
namespace {

constexpr float frozenDullness = 0.93F;
constexpr float asleepGreyness = 0.9F;  // in the debug view
constexpr double fullStrain = 0.02;     // strain that the debug view shows in full colour

// Shows whether an island is frozen, and in the debug view whether it sleeps.
void addStillness(const Island& island, bool debug, view::Surface& surface) {
    if (island.frozen() != nullptr) surface.dulled = frozenDullness;
    if (debug && island.isAsleep()) surface.greyed = asleepGreyness;
}

constexpr glm::vec3 asleepColour(0.2F);  // of springs

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
        if (s.kind == mechanics::SpringKind::bend || plan.broken[i]) continue;  // bend: would cover structural ones
        const dvec3 a = island.position(s.a), b = island.position(s.b);
        const double l = std::sqrt(glm::dot(b - a, b - a));
        const double strain = s.restLength > 0 ? l / s.restLength - 1.0 : 0.0;
        marks.lines.push_back({glm::vec3(a), glm::vec3(b), island.isAsleep() ? asleepColour : strainColour(strain)});
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

// Marks contact between surfaces: pressing pairs by a line as long as their distance, and crossings.
void addTouchMarks(WorldImpl& w, view::Marks& marks) {
    const glm::vec3 pressing(0.05F, 0.75F, 0.95F), crossing(1.0F, 0.0F, 0.1F);
    for (const BodyContact& c : w.contactReport.contacts()) {
        double thickness = 0;
        for (const Body* body : {c.first, c.second}) thickness += body != nullptr ? body->spec->thickness : 0;
        const dvec3 way = 0.5 * thickness * c.normal;
        marks.lines.push_back({glm::vec3(c.place - way), glm::vec3(c.place + way), pressing});
        marks.dots.push_back({glm::vec3(c.place), pressing, 2.5F});
    }
    if (!touchesAny(w)) return;
    for (const BodyCrossing& c : crossingsOf(w)) marks.dots.push_back({glm::vec3(c.place), crossing, 4.0F});
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

view::Lamp lampOf(const LampSpec& spec) {
    return {spec.name, glm::normalize(glm::vec3(spec.direction)),
            static_cast<float>(spec.intensity) * linearColour(spec.colour), static_cast<float>(spec.softness),
            spec.shadow};
}

// (points of the island) [m]
std::vector<dvec3> placesAhead(const Island& island, double ahead) {
    std::vector<dvec3> x(island.plan().points.size()), v(x.size());
    island.read(x, v);
    if (ahead == 0.0) return x;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (std::isfinite(glm::dot(v[i], v[i]))) x[i] += ahead * v[i];  // v of held points may be infinite
    return x;
}

// Draws ties of joints. Ties between bodies are extrapolated with them.
void addTies(const WorldImpl& w, double ahead, bool debug, view::FrameView& view) {
    const auto isDrawn = [](const auto& drawing) { return drawing != nullptr; };
    if (std::none_of(w.drawings.begin(), w.drawings.end(), isDrawn)) return;
    std::map<std::string, glm::mat4> poses;  // of the carriers of ties
    std::map<std::string, int> count;        // number of ties so far, by name of the drawing
    const auto matrix = [&](const std::string& holder) {
        auto known = poses.find(holder);
        if (known == poses.end())
            known = poses.emplace(holder, matrixOf(poseOf(w, holder, ahead).value_or(collision::Pose{}))).first;
        return known->second;
    };
    for (const auto& island : w.islands) {
        const IslandPlan& plan = island->plan();
        const std::vector<dvec3> x = placesAhead(*island, ahead);
        for (const JointTie& tie : plan.ties) {
            const auto& drawing = w.drawings[tie.joint];
            if (!drawing) continue;
            const int number = count[drawing->name()]++;
            if (!holds(plan, tie)) continue;
            const glm::vec3 a(tie.from.of(x));
            const glm::vec3 b = tie.b >= 0 ? glm::vec3(tie.to.of(x))
                                           : glm::vec3(matrix(tie.collider) * glm::vec4(glm::vec3(tie.offset), 1.0F));
            if (!drawing->isShown(a, b)) continue;
            view.surfaces.push_back(drawing->surface(a, b, number));
            addStillness(*island, debug, view.surfaces.back());
        }
    }
}

collision::Colliders collidersAt(const WorldImpl& w, double ahead) {
    collision::Colliders all;
    w.registry.each<ColliderPart, Placement>([&](ecs::Entity, const ColliderPart& part, const Placement& placement) {
        all.add(part.model->shape, {}, poseAhead(placement, ahead * w.ticksPerSecond));
    });
    return all;
}

// The contents of a picture without labels and marks. Puts bodies into `drawn`, in order.
view::FrameView sceneOf(const WorldImpl& w, double ahead, bool debug, std::vector<Body*>& drawn) {
    const double time = w.seconds() + ahead;
    view::FrameView view;
    view.frame = w.tick / w.ticksPerFrame;
    view.time = time;
    // Light and background, then the camera.
    view.light = lightOf(w.spec.light);
    if (const EnvironmentSpec& around = w.spec.environment; !around.image.empty())
        view.environment = view::Environment{around.image, static_cast<float>(around.strength),
                                             static_cast<float>(around.turn), around.visible};
    for (const LampSpec& lamp : w.spec.lamps) view.lamps.push_back(lampOf(lamp));
    view.background = {linearColour(w.spec.background.top), linearColour(w.spec.background.horizon),
                       static_cast<float>(w.spec.background.fadeStart), static_cast<float>(w.spec.background.fadeEnd),
                       w.spec.background.fadesWithCamera};
    view.camera = cameraOfPictures(w, time, ahead);
    // Colliders; the first visible level plane is the ground.
    w.registry.each<ColliderPart, Placement>([&](ecs::Entity, const ColliderPart& part, const Placement& placement) {
        const collision::Pose pose = poseAhead(placement, ahead * w.ticksPerSecond);
        if (part.spec.visible && part.model->isGround && !view.ground) {
            view.ground = view::Ground{};
            view.ground->height = static_cast<float>(pose.position.y);
            view.ground->colour = linearColour(part.spec.finish.colour);
            if (part.spec.finish.pattern != view::Pattern::plain) view.ground->pattern = finishOf(part.spec.finish);
        }
        for (const ColliderModel::Piece& piece : part.model->pieces)
            view.surfaces.push_back({part.spec.name, piece.mesh.topology, piece.mesh.geometry, piece.finish,
                                     matrixOf(pose) * piece.transform, part.model->isPlane});
        if (part.model->figure != nullptr && part.spec.visible)
            part.model->figure->addSurfaces(time, pose, view.surfaces);
    });
    // Bodies, dulled if frozen.
    std::map<const Island*, std::vector<dvec3>> places;  // of the islands so far, if extrapolated
    std::optional<collision::Colliders> colliders;       // for bodies that are drawn finer
    for (const WorldImpl::Member& member : w.bodies) {
        const BodyPart& part = *w.registry.find<BodyPart>(member.entity);
        const Island& island = islandOf(*part.body);
        drawn.push_back(part.body.get());
        std::vector<glm::vec3> positions;
        positions.reserve(part.body->pointOf.size());
        if (ahead == 0.0) {
            for (int i : part.body->pointOf) positions.emplace_back(island.position(i));
        } else {
            auto known = places.find(&island);
            if (known == places.end()) known = places.emplace(&island, placesAhead(island, ahead)).first;
            for (int i : part.body->pointOf) positions.emplace_back(known->second[i]);
        }
        const std::size_t first = view.surfaces.size();
        part.drawing->addSurfaces(positions, view.surfaces);
        const BodySpec& spec = *part.body->spec;
        const bool isFine = spec.finish.smooth > 0 && spec.collide && !spec.facesMeet();
        if (isFine && !colliders) colliders = collidersAt(w, ahead);
        for (std::size_t i = first; i < view.surfaces.size(); ++i) {
            view::Surface& surface = view.surfaces[i];
            addStillness(island, debug, surface);
            if (!isFine || surface.tubeRadius > 0.0F) continue;
            auto outside = std::make_shared<view::Geometry>(*surface.geometry);
            keepOutside(*colliders, spec.thickness, surface.topology->triangles, *outside);
            surface.geometry = outside;
        }
    }
    addTies(w, ahead, debug, view);
    return view;
}

}  // namespace

view::Camera cameraOfPictures(const WorldImpl& w, double time, double ahead) {
    view::Camera camera;
    bool chosen = false;
    w.registry.each<CameraPart>([&](ecs::Entity, const CameraPart& part) {
        if (chosen || (!w.spec.picture.camera.empty() && part.spec.name != w.spec.picture.camera)) return;
        camera = cameraOf(part, time, ahead);
        chosen = true;
    });
    return camera;
}

view::FrameView viewAhead(const WorldImpl& w, double ahead) {
    std::vector<Body*> ignored;
    return sceneOf(w, ahead, false, ignored);
}

view::FrameView viewOf(WorldImpl& w, bool debug) {
    std::vector<Body*> bodies;
    view::FrameView view = sceneOf(w, 0.0, debug, bodies);
    for (const LabelSpec& label : w.spec.labels) {
        if (!label.isShown(w.seconds())) continue;
        std::vector<LabelSubject> subjects;
        for (const Body* body : matchBodies(bodies, label.of)) subjects.push_back({body, &islandOf(*body)});
        addLabels(label, subjects, view.labels);
    }
    view.showMarks = debug;
    if (!debug) return view;
    for (const auto& island : w.islands) addMarks(*island, view.marks);
    addTouchMarks(w, view.marks);
    for (const Hand& hand : w.hands)
        view.marks.dots.push_back({glm::vec3(hand.placeAt(w.tick)), glm::vec3(1.0F, 0.35F, 0.05F), 5.0F});
    return view;
}

}  // namespace taut::world
