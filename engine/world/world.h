// A scene in motion: entities and their components, islands, the tick, and the view for a picture.
// It knows neither files nor GL.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "view/frame_view.h"
#include "world/spec.h"

namespace taut::world {

// Why a run cannot go on: everything a person needs to mend the scene.
struct Divergence {
    std::int64_t tick = 0;
    double time = 0;          // [s]
    std::string body;         // "cloth.flag"
    int point = -1;           // in the order of authoring
    std::string spring;       // the stiffest relative to its masses at that point, e.g. "structural 12-13"
    double omegaH = 0;        // ω h there
    double limit = 0;         // largest ω h that the method stands
    double safeStep = 0;      // [s] largest step that would hold
    std::string message;      // the whole diagnosis, several lines
};

struct Metrics {  // at a published tick, velocities synchronised
    double time = 0;                // [s]
    double kinetic = 0;             // [J]
    double elastic = 0;             // [J]
    double gravitational = 0;       // [J]
    glm::dvec3 momentum{0.0};       // [kg m/s]
    glm::dvec3 angularMomentum{0.0};  // [kg m²/s] about the origin
    double maxStrain = 0;           // largest |l - L|/L of any spring
    int contacts = 0;
    int invertedCells = 0;          // V/V0 <= 0
    double minVolumeRatio = 1;      // smallest V/V0
};

struct IslandInfo {
    std::string name;                 // of its first body
    std::vector<std::string> bodies;  // "cloth.flag", …
    int points = 0, heldPoints = 0, springs = 0, runs = 0, singles = 0, cells = 0;
    double mass = 0;                  // [kg] of the points
    std::string method;
    double omegaBound = 0;            // B1 [1/s]
    double omegaNow = 0;              // B2 at the start [1/s]
    double omegaEstimate = 0;         // Lanczos [1/s]
    double stepLimit = 0;             // [s] largest stable step by B1 with damping
    double step = 0;                  // [s] chosen
    int substeps = 1;
    std::string limitingSpring;
    std::uint64_t bytes = 0;
};

struct Options {
    int threads = 0;  // 0: as many as the machine has
};

class World {
  public:
    // Builds everything; throws core::Error(badContent) with file:line:column where the scene is at fault.
    explicit World(const SceneSpec& spec, const Options& options = {});
    ~World();
    World(World&&) noexcept;

    double tickSeconds() const;
    int ticksPerFrame() const;
    std::int64_t tick() const;
    double time() const;  // [s] = tick / ticks per second, computed from whole numbers

    // One tick: forces, integration, collision, substeps times for every island, side by side. On divergence the
    // state of the tick before is kept and the diagnosis returned; nothing else may be called then but the views.
    std::optional<Divergence> advance();

    // The picture of this moment; size in pixels sets the scale of the debug marks only.
    view::FrameView view(bool debug) const;

    std::uint64_t stateHash() const;  // chained over ticks
    Metrics metrics() const;
    std::vector<IslandInfo> islands() const;
    std::vector<std::string> warnings() const;  // steps over the limit, working stretch left, …

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// What a scene would need, computed from the numbers in it before anything is allocated.
struct Estimate {
    double points = 0, springs = 0, bytes = 0;
};
Estimate estimate(const SceneSpec& spec);

}  // namespace taut::world
