#include "taut/pipeline/energy_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace taut::pipeline {
namespace {

constexpr Ink gridInk{150, 160, 175}, scaleInk{176, 184, 196};

struct Curve {
    const char* name;
    Ink ink;
    double (*energy)(const Moment&);
};
constexpr std::array curves{Curve{"gravity", gravitationalInk, [](const Moment& m) { return m.gravitational; }},
                            Curve{"elastic", elasticInk, [](const Moment& m) { return m.elastic; }},
                            Curve{"kinetic", kineticInk, [](const Moment& m) { return m.kinetic; }},
                            Curve{"total", totalInk, [](const Moment& m) { return m.energy(); }}};

void paintGrid(Painting& painting, const PictureBox& box, float em, const EnergyScale& scale) {
    const int first = static_cast<int>(std::lround(scale.low / scale.spacing));
    const int last = static_cast<int>(std::lround(scale.high / scale.spacing));
    for (int i = first; i <= last; ++i) {
        const float y = std::round(placeOf(0.0, i * scale.spacing, 0.0, scale, box).y) + 0.5F;
        const std::array ends{glm::vec2(box.low.x, y), glm::vec2(box.high.x, y)};
        painting.line(ends, 1.0F, gridInk, i == 0 ? 0.6F : 0.2F);
    }
    const float type = 0.72F * em;
    const auto value = [&](double energy) {
        return numberText(energy / scale.unit, scale.decimals) + " " + scale.unitName;
    };
    painting.text({box.low.x, box.low.y + 0.85F * type}, Side::left, value(scale.high), type, scaleInk);
    if (scale.low < 0.0)
        painting.text({box.low.x, box.high.y - 0.25F * type}, Side::left, value(scale.low), type, scaleInk);
}

constexpr float legendType = 0.9F, swatchWidth = 1.1F, legendGap = 0.6F;  // in sizes of the type

std::string valueText(const Curve& curve, const Moment& now, const EnergyScale& scale) {
    return numberText(curve.energy(now) / scale.unit, scale.decimals + 2) + " " + scale.unitName;
}

void paintLegend(Painting& painting, const PictureBox& box, float em, const Moment& now, const EnergyScale& scale) {
    const float type = legendType * em, half = 0.5F * (box.high.x - box.low.x - legendGap * em);
    constexpr std::array order{2, 1, 0, 3};  // kinetic, elastic / gravity, total
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Curve& curve = curves[order[i]];
        const float left = box.low.x + static_cast<float>(i % 2) * (half + legendGap * em);
        const float y = box.high.y + (1.35F + 1.35F * static_cast<float>(i / 2)) * em;
        const float middle = y - 0.32F * type;
        const std::array swatch{glm::vec2(left + 0.1F * em, middle), glm::vec2(left + 0.7F * em, middle)};
        painting.line(swatch, 0.16F * em, curve.ink);
        painting.pair(left + swatchWidth * em, left + half, y, curve.name, curve.ink, valueText(curve, now, scale),
                      curve.ink, type);
    }
}

EnergyScale scaleOf(std::span<const Moment> moments) {
    double least = 0.0, most = 0.0;
    for (const Moment& moment : moments)
        for (const Curve& curve : curves) {
            least = std::min(least, curve.energy(moment));
            most = std::max(most, curve.energy(moment));
        }
    return energyScale(least, most);
}

}  // namespace

std::string numberText(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
    const bool isZero = text.find_first_not_of("0.") == std::string::npos;
    return value < 0.0 && !isZero ? "\u2212" + text : text;
}

EnergyScale energyScale(double least, double most) {
    EnergyScale scale;
    least = std::min(least, 0.0);
    most = std::max(most, 0.0);
    const double range = std::isfinite(most - least) ? std::max(most - least, 1e-9) : 1.0;
    const double power = std::pow(10.0, std::floor(std::log10(range / 3.0)));
    for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
        scale.spacing = factor * power;
        if (scale.spacing * 3.0 >= range) break;
    }
    scale.low = std::isfinite(least) ? scale.spacing * std::floor(least / scale.spacing + 1e-9) : 0.0;
    scale.high = std::isfinite(most) ? scale.spacing * std::ceil(most / scale.spacing - 1e-9) : 1.0;
    if (!(scale.high > scale.low)) scale.high = scale.low + scale.spacing;

    struct Unit {
        double joule;
        const char* name;
    };
    for (const Unit unit : {Unit{1e-6, "µJ"}, Unit{1e-3, "mJ"}, Unit{1.0, "J"}, Unit{1e3, "kJ"}, Unit{1e6, "MJ"}}) {
        if (unit.joule > 1e-6 && range < 0.5 * unit.joule) break;
        scale.unit = unit.joule;
        scale.unitName = unit.name;
    }
    scale.decimals = std::clamp(static_cast<int>(-std::floor(std::log10(scale.spacing / scale.unit) + 1e-9)), 0, 4);
    return scale;
}

glm::vec2 placeOf(double time, double energy, double now, const EnergyScale& scale, const PictureBox& box) {
    const double across = 1.0 + (time - now) / Overlay::span;
    const double up = (energy - scale.low) / (scale.high - scale.low);
    return {static_cast<float>(box.low.x + across * static_cast<double>(box.high.x - box.low.x)),
            static_cast<float>(box.high.y - up * static_cast<double>(box.high.y - box.low.y))};
}

float legendWidth(Painting& painting, float em, std::span<const Moment> moments) {
    const EnergyScale scale = scaleOf(moments);
    float half = 0.0F;
    for (const Curve& curve : curves)
        half = std::max(half, swatchWidth * em + painting.pairWidth(curve.name, valueText(curve, moments.back(), scale),
                                                                    legendType * em));
    return 2.0F * half + legendGap * em;
}

void paintEnergies(Painting& painting, const PictureBox& box, float em, std::span<const Moment> moments, double now) {
    const EnergyScale scale = scaleOf(moments);
    paintLegend(painting, box, em, moments.back(), scale);
    if (!(box.high.y > box.low.y)) return;
    paintGrid(painting, box, em, scale);
    for (const Curve& curve : curves) {
        std::vector<glm::vec2> corners;
        for (const Moment& moment : moments) {
            const double energy = curve.energy(moment);
            if (!std::isfinite(energy)) continue;
            glm::vec2 place = placeOf(moment.time, energy, now, scale, box);
            if (place.x < box.low.x) {  // the curve comes in from the edge
                place.x = box.low.x;
                corners.clear();
            }
            corners.push_back(place);
        }
        painting.line(corners, 0.11F * em, curve.ink);
    }
}

}  // namespace taut::pipeline
