// The required accuracy of a scene, in metres and seconds. It runs nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace taut::world {
struct SceneSpec;
}

namespace taut::study {

// Scales that convert percents and pixels to metres.
struct Scales {
    double extent = 0;          // [m] diagonal of the box that all points stay in
    double metresPerPixel = 0;  // [m] where a pixel shows least; 0: nothing is before the camera
};

struct Need {
    double target = 0;             // [m] largest RMS error of positions, over points and time
    std::string stated;            // the same in the words of the file: "0.5 px at 1280 x 720"
    double horizon = 0;            // [s] until when it counts
    std::optional<double> budget;  // [ms] of wall time a frame
};

// Throws core::Error(badContent) where [need] is missing, says nothing of accuracy, or contradicts the scene.
void checkNeed(const world::SceneSpec& spec);

// The strictest of the requirements. Expects a need that checkNeed accepts.
Need resolvedNeed(const world::SceneSpec& spec, const Scales& scales);

// "2 mm", "35 µm"
std::string lengthText(double metres);

}  // namespace taut::study
