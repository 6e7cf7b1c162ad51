// How much memory a scene will need once built and drawn, so that too much is refused before it is allocated.
#pragma once

namespace taut::world {
struct BodySpec;
struct SceneSpec;
}  // namespace taut::world

namespace taut::scene {

// Counts are doubles, as they may be far beyond any integer.
struct BodySize {
    double points = 0, springs = 0, volumes = 0;  // of all copies
    double bytes() const;                         // of the model and the state, roughly
};

BodySize sizeOf(const world::BodySpec& body, const world::SceneSpec& scene);
BodySize sizeOf(const world::SceneSpec& scene);  // of all bodies together

// [bytes] Everything that a run with pictures takes, by rules measured with a software renderer and rounded up.
struct SceneSize {
    double bodies = 0;
    double colliders = 0;  // with their drawings and the triangles of their meshes
    double pictures = 0;   // buffers to draw into, and pictures on their way to a file
    double timeline = 0;   // actions, checks, keyframes
    double bytes() const { return bodies + colliders + pictures + timeline; }
};
SceneSize wholeSizeOf(const world::SceneSpec& scene);

// Half of the machine's memory [bytes].
double memoryLimit();

inline constexpr double maxPoints = 50e6;

}  // namespace taut::scene
