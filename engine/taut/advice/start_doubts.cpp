#include "taut/advice/private/start_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "taut/advice/contact_doubts.h"
#include "taut/advice/figures.h"
#include "taut/bodies/block.h"
#include "taut/bodies/net.h"
#include "taut/forces/filling.h"
#include "taut/forces/wind.h"
#include "taut/joints/joints.h"
#include "taut/mechanics/private/filling.h"
#include "taut/plan/private/ties.h"
#include "taut/spec/actions.h"
#include "taut/spec/private/motion.h"
#include "taut/world/private/bodies.h"
#include "taut/world/private/impl.h"

namespace taut::world {
namespace {

constexpr double strongestStorm = 120;  // [m/s] the fastest gust measured near the ground was 113
constexpr double mostStrain = 0.5;
constexpr int mostSteps = 1000;  // in a tick

void doubtWinds(const WorldImpl& world, std::vector<core::Finding>& doubts) {
    for (const WindSpec& wind : world.spec.forces.of<WindSpec>()) {
        const double speed = std::sqrt(glm::dot(wind.velocity, wind.velocity)) + std::abs(wind.gustAmplitude);
        if (!(speed > strongestStorm)) continue;
        doubts.push_back(warningAt(wind.source) +
                         fmt::format("wind.{} blows at up to {:.4g} m/s, faster than any storm; a gale has 20 to 30",
                                     wind.name, speed));
    }
}

// Checks all places to which keyframes lead cameras and colliders.
void doubtCameras(WorldImpl& world, std::vector<core::Finding>& doubts) {
    constexpr int moments = 100;
    for (const CameraSpec& camera : world.spec.cameras)
        for (int k = 0; k <= moments; ++k) {
            const double t = world.spec.run.seconds * k / moments;
            collision::Colliders all;
            std::vector<const ColliderSpec*> specs;
            world.registry.each<ColliderPart>([&](ecs::Entity, const ColliderPart& part) {
                all.add(part.model->shape, {}, poseAt(part.spec, t));
                specs.push_back(&part.spec);
            });
            const int found = all.inside(cameraAt(camera, t).eye).collider;
            if (found < 0) continue;
            doubts.push_back(warningAt(camera.source) +
                             fmt::format("camera.{} is inside collider.{} at {:.3g} s, and sees little else; move "
                                         "one of them",
                                         camera.name, specs[found]->name, t));
            break;
        }
}

void doubtStrains(const Island& island, std::vector<core::Finding>& doubts) {
    const IslandPlan& plan = island.plan();
    struct Longest {
        double strain = mostStrain, length = 0, restLength = 0;
    };
    std::vector<Longest> longest(plan.bodies.size());
    for (std::size_t i = 0; i < plan.springs.size(); ++i) {
        const mechanics::Spring& s = plan.springs[i];
        if (plan.origins[i].body < 0 || s.kind == mechanics::SpringKind::bend || !(s.restLength > 0)) continue;
        const double length = lengthOf(s, plan.positions), strain = length / s.restLength - 1;
        Longest& of = longest[plan.origins[i].body];
        if (strain > of.strain) of = {strain, length, s.restLength};
    }
    for (std::size_t b = 0; b < longest.size(); ++b)
        if (longest[b].length > 0 && plan.bodies[b]->kind() != NetSpec::kindName)  // a net has springs of any length
            doubts.push_back(warningAt(plan.bodies[b]->spec->source) +
                             fmt::format("{} starts with a strain of {:.2g}: a spring of it is {:.3g} m long, and "
                                         "{:.3g} m at rest; bring its ends together, or make it longer",
                                         plan.bodies[b]->fullName(), longest[b].strain, longest[b].length,
                                         longest[b].restLength));
}

// Lengths in millimetres make bodies of a billion times their mass.
void doubtMasses(const WorldImpl& world, std::vector<core::Finding>& doubts) {
    constexpr double mostTimes = 1000, most = 1e6;  // of the median; [kg]
    std::vector<std::pair<double, const Body*>> all;
    for (const auto& island : world.islands)
        for (const Body* body : island->plan().bodies) {
            double mass = 0;
            for (const int i : body->pointOf) mass += island->plan().points[i].weighedMass();
            all.emplace_back(mass, body);
        }
    if (all.empty()) return;
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const double median = all[all.size() / 2].first;
    std::set<const BodySpec*> seen;  // copies would repeat the same
    for (const auto& [mass, body] : all)
        if ((mass > mostTimes * median || mass > most) && seen.insert(body->spec.get()).second)
            doubts.push_back(warningAt(body->spec->source) +
                             fmt::format("{} weighs {:.2g} kg{}: lengths are in metres; give its size in metres, or "
                                         "less density",
                                         body->fullName(), mass,
                                         mass > mostTimes * median
                                             ? fmt::format(", {:.2g} times the median of the bodies", mass / median)
                                             : ""));
}

void doubtSteps(const Island& island, double ticksPerSecond, std::vector<core::Finding>& doubts) {
    if (island.substeps() <= mostSteps) return;
    const StepChoice choice = island.choice();
    doubts.push_back(
        warningAt(limitingBody(island.plan(), choice.anywhere).spec->source) +
        fmt::format("{} needs {} steps a tick, {:.2g} million a second{}: take less stiffness or damping there, larger "
                    "cells or more mass, or an implicit method with a dt",
                    island.plan().bodies.front()->fullName(), island.substeps(),
                    1e-6 * ticksPerSecond * island.substeps(),
                    choice.limitingSpring.empty() ? "" : ", set by the " + choice.limitingSpring));
}

// Two pieces of a block are still one body.
void doubtCuts(const WorldImpl& world, std::vector<core::Finding>& doubts) {
    foreseen<CutAction>(
        world.spec.actions,
        [&](const CutAction& cut) {
            for (const Body* body : bodiesOf(world))
                if (cut.planePoint && names(cut.target, *body) && body->kind() == BlockSpec::kindName &&
                    body->spec->touch == Touch::others)
                    doubts.push_back(
                        warningAt(cut.source) +
                        fmt::format("{} touches others only: its pieces will go through each other; give it "
                                    "touch = \"all\"",
                                    body->fullName()));
        });
}

// Panels that are still apart give a filling another volume than the sewn body.
void doubtFillings(const WorldImpl& world, std::vector<core::Finding>& doubts) {
    const std::vector<Body*> bodies = bodiesOf(world);
    for (const FillingSpec& filling : world.spec.forces.of<FillingSpec>()) {
        const bool keepsPressure = filling.keeps == mechanics::FillingKeeps::pressure;
        if (keepsPressure && filling.pressure == 0.0) continue;
        const auto isIn = [&](const JointSide& side) {
            return std::any_of(bodies.begin(), bodies.end(), [&](const Body* body) {
                return names(side, *body) && std::any_of(filling.in.begin(), filling.in.end(),
                                                         [&](const std::string& in) { return names(in, *body); });
            });
        };
        for (const JointSpec& joint : world.spec.joints) {
            const auto* seam = dynamic_cast<const SeamJoint*>(&joint);
            if (seam == nullptr || seam->isWeld() || !isIn(seam->a) || !isIn(seam->b)) continue;
            doubts.push_back(
                warningAt(filling.source) +
                fmt::format(
                    "filling.{} {} before the seam \"{}\" – \"{}\" is closed at {:g} s; {}ramp pressure_Pa from "
                    "0 after that",
                    filling.name, keepsPressure ? "presses" : "has its volume of panels as they stand,", seam->a.text(),
                    seam->b.text(), seam->start + seam->over,
                    keepsPressure ? "" : "give it keeps = \"pressure\", and "));
            break;
        }
    }
}

}  // namespace

std::vector<core::Finding> startDoubts(World& world) {
    WorldImpl& w = WorldAccess::of(world);
    std::vector<core::Finding> doubts = touchDoubts(world);
    doubtWinds(w, doubts);
    doubtCameras(w, doubts);
    doubtCuts(w, doubts);
    doubtFillings(w, doubts);
    doubtMasses(w, doubts);
    for (core::Finding& doubt : figureDoubts(w.spec)) doubts.push_back(std::move(doubt));
    for (const auto& island : w.islands) {
        doubtStrains(*island, doubts);
        doubtSteps(*island, w.ticksPerSecond, doubts);
    }
    return doubts;
}

}  // namespace taut::world
