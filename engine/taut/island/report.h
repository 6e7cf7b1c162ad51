// The reports of islands: energies, steps, why a run ended. It knows no island.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "taut/ode/fastest_mode.h"
#include "taut/ode/work.h"

namespace taut::world {

// Why a run cannot go on, with everything that a person needs to mend the scene.
struct Divergence {
    std::int64_t tick = 0;
    double time = 0;      // [s]
    std::string body;     // "cloth.flag"
    int point = -1;       // in the order of authoring
    std::string spring;   // the stiffest one at that point, relative to its masses, e.g. "structural 12-13"
    double omegaH = 0;    // ω h there
    double limit = 0;     // largest ω h that the method can stand
    double safeStep = 0;  // [s] largest step that would hold
    std::string message;  // the whole diagnosis, several lines
};

// An island that diverged while others went on: [solver] on_divergence = "freeze".
struct FrozenIsland {
    std::string name;                 // of its first body
    std::vector<std::string> bodies;  // "cloth.flag", …
    double time = 0;                  // [s] of the state that is kept
    Divergence divergence;
};

// Crossings cost the most, up to some microseconds for each point of bodies that touch. They include crossings of
// colliders' edges.
enum class Measures { all, butCrossings };

struct Metrics {                      // at a published tick, velocities synchronised; frozen islands left out
    double time = 0;                  // [s]
    double kinetic = 0;               // [J]
    double elastic = 0;               // [J]
    double gravitational = 0;         // [J]
    glm::dvec3 momentum{0.0};         // [kg m/s]
    glm::dvec3 angularMomentum{0.0};  // [kg m²/s] about the origin
    double maxStrain = 0;             // largest |l - L|/L of all rods and of all springs except bending springs
    int contacts = 0;
    int invertedCells = 0;          // V/V0 <= 0
    int brokenSprings = 0;          // cut or torn since the start
    double volume = 0;              // [m³] of the cells of blocks
    double restVolume = 0;          // [m³] of the same cells without force
    double penetration = 0;         // [m] largest depth of a free, colliding point inside a collider
    int asleep = 0;                 // points of islands that sleep
    double sleptEnergy = 0;         // [J] of motion, which falling asleep has taken since the start
    glm::dvec3 sleptMomentum{0.0};  // [kg m/s] taken in the same way
    double facePenetration =
        0;  // [m] largest height of a collider's corner or edge out of a triangle of a body that meets faces
    double minVolumeRatio = 1;  // smallest V/V0
    ode::Work work{};           // of the methods since the start
    int squeezed = 0;           // points that parts of a figure closed upon, and were let through, in the last tick
    int bodyContacts = 0;       // pairs of parts of bodies that pressed each other at the end of the last tick
    int crossings = 0;          // edges of touching bodies through triangles of touching bodies; 0 if not looked for
    std::vector<double>
        measured{};  // (rows of metric_table.h) values of rows that measure by themselves; empty: none yet

    double energy() const { return kinetic + elastic + gravitational; }  // [J]
};

// One change of the step of an island that follows its state.
struct StepChange {
    double time = 0;          // [s] start of the tick from which it holds
    int from = 1, to = 1;     // substeps a tick
    bool isRepeated = false;  // the tick was first taken in longer steps, which were too long
};

struct IslandInfo {
    std::string name;                 // of its first body
    std::vector<std::string> bodies;  // "cloth.flag", …
    int points = 0, heldPoints = 0, springs = 0, runs = 0, singles = 0, cells = 0;
    int constraints = 0;  // rods and other constraints that tie points without a spring
    double mass = 0;      // [kg] of the points
    std::string method;
    double omegaBound = 0;       // B1 [1/s]
    double omegaNow = 0;         // B2 as it is now [1/s]
    double omegaEstimate = 0;    // Lanczos, as it is now [1/s]
    ode::FastestMode fastest{};  // source of stepLimit, with omegaBound
    double stepLimit = 0;        // [s] largest stable step by B1 with damping
    double step = 0;             // [s] chosen
    int substeps = 1;
    bool followsState = false;            // the step may change during the run
    bool splitsDashpots = false;          // the dashpots act apart from the other forces
    std::vector<StepChange> stepChanges;  // so far
    std::string limitingSpring;           // cause of the limit, in words
    std::vector<std::string> advice;      // changes that would allow a longer step
    std::uint64_t bytes = 0;
    ode::Work work{};  // of its method since the start
};

}  // namespace taut::world
