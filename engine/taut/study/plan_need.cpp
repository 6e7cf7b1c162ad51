#include "taut/study/plan_need.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/spec/spec.h"

namespace taut::study {
namespace {

constexpr double longestHorizon = 2.0;  // [s] unless the scene says how long

[[noreturn]] void fail(const world::SceneSpec& spec, const std::string& why) {
    throw core::Error(core::ErrorKind::badContent, core::at({spec.file}) + why);
}

}  // namespace

std::string lengthText(double metres) {
    if (!(metres < 1e6)) return "-";
    if (metres >= 1.0) return fmt::format("{:.3g} m", metres);
    if (metres >= 1e-3) return fmt::format("{:.3g} mm", 1e3 * metres);
    if (metres >= 1e-6) return fmt::format("{:.3g} um", 1e6 * metres);
    return fmt::format("{:.3g} nm", 1e9 * metres);
}

void checkNeed(const world::SceneSpec& spec) {
    const world::NeedSpec& need = spec.need;
    const std::string example =
        "\n  add for example\n\n    [need]\n    rms_position_m = 2e-3   # or rms_percent of the bounding box, or "
        "rms_pixels\n    horizon_s = 0.5\n    budget_ms = 4.0         # a frame; may be left out\n";
    const bool isEmpty = !need.rmsPosition && !need.rmsPercent && !need.rmsPixels && !need.horizon && !need.budget;
    if (isEmpty) fail(spec, "the scene has no need: add [need]" + example);
    if (!need.rmsPosition && !need.rmsPercent && !need.rmsPixels)
        fail(spec, "[need] has no accuracy of the positions" + example);
    if (need.horizon && *need.horizon > spec.run.seconds * (1 + 1e-9))
        fail(spec,
             fmt::format("[need] contradicts [run]: horizon_s = {:.4g} is later than the end of the run at {:.4g} s",
                         *need.horizon, spec.run.seconds));
    if (spec.bodies.empty()) fail(spec, "nothing moves by springs here: there is nothing to plan");
}

Need resolvedNeed(const world::SceneSpec& spec, const Scales& scales) {
    const world::NeedSpec& given = spec.need;
    Need need;
    need.horizon = given.horizon.value_or(std::min(spec.run.seconds, longestHorizon));
    need.budget = given.budget;
    need.target = HUGE_VAL;
    const auto consider = [&](double metres, const std::string& stated) {
        if (metres >= need.target) return;
        need.target = metres;
        need.stated = stated;
    };
    if (given.rmsPosition) consider(*given.rmsPosition, lengthText(*given.rmsPosition));
    if (given.rmsPercent)
        consider(*given.rmsPercent / 100 * scales.extent,
                 fmt::format("{:.4g} % of {}", *given.rmsPercent, lengthText(scales.extent)));
    if (given.rmsPixels && scales.metresPerPixel <= 0 && !given.rmsPosition && !given.rmsPercent)
        fail(spec, "rms_pixels does not apply: the camera sees no point of the scene within the horizon");
    if (given.rmsPixels && scales.metresPerPixel > 0)
        consider(*given.rmsPixels * scales.metresPerPixel,
                 fmt::format("{:.4g} px at {} x {}, {} each", *given.rmsPixels, spec.picture.size.x,
                             spec.picture.size.y, lengthText(scales.metresPerPixel)));
    return need;
}

}  // namespace taut::study
