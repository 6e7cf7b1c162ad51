// Energies over time as curves with a legend. It knows nothing of the picture around them.
#pragma once

#include <span>

#include "taut/pipeline/overlay.h"

namespace taut::pipeline {

// A part of an axis between two of its lines, and how its values read.
struct EnergyScale {
    double low = 0.0, high = 1.0;  // [J] ends of the axis, multiples of `spacing`; 0 lies between them
    double spacing = 1.0;          // [J] from one line to the next: 1, 2 or 5 times a power of ten
    double unit = 1.0;             // [J] that values are shown in
    const char* unitName = "J";
    int decimals = 0;  // of a line's value
};

// The scale that holds least … most and 0 with three to six lines.
EnergyScale energyScale(double least, double most);

// "−0.25": with a minus sign of the width of a plus.
std::string numberText(double value, int decimals);

// Where energies of a moment stand in the box: the right end is `time` [s], the left end Overlay::span before it.
glm::vec2 placeOf(double time, double energy, double now, const EnergyScale& scale, const PictureBox& box);

inline constexpr Ink kineticInk{110, 200, 255}, elasticInk{255, 150, 90}, gravitationalInk{150, 220, 110},
    totalInk{250, 250, 250};

// [px] that the legend needs.
float legendWidth(Painting& painting, float em, std::span<const Moment> moments);

// The graph in the box and the legend in two lines below it, type of a size of `em` [px]. Expects moments, ascending.
// A box without height has the legend only.
void paintEnergies(Painting& painting, const PictureBox& box, float em, std::span<const Moment> moments, double now);

}  // namespace taut::pipeline
