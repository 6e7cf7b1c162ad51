// Draws energies over time as curves with a legend. It knows nothing about the picture around them.
#pragma once

#include <span>

#include "taut/pipeline/overlay.h"

namespace taut::pipeline {

// The step between two lines of an axis, and how its values are written.
struct EnergyScale {
    double low = 0.0, high = 1.0;  // [J] ends of the axis, multiples of `spacing`; 0 lies between them
    double spacing = 1.0;          // [J] from one line to the next: 1, 2 or 5 times a power of ten
    double unit = 1.0;             // [J] that values are shown in
    const char* unitName = "J";
    int decimals = 0;  // of a line's value
};

// The scale that contains least … most and 0, with three to six lines.
EnergyScale energyScale(double least, double most);

// "−0.25": with a minus sign of the width of a plus.
std::string numberText(double value, int decimals);

// The place in the box of an energy at a moment: the right end is the time `now` [s], the left end Overlay::span before
// it.
glm::vec2 placeOf(double time, double energy, double now, const EnergyScale& scale, const PictureBox& box);

inline constexpr Ink kineticInk{110, 200, 255}, elasticInk{255, 150, 90}, gravitationalInk{150, 220, 110},
    totalInk{250, 250, 250};

// [px] width that the legend needs.
float legendWidth(Painting& painting, float em, std::span<const Moment> moments);

// Paints the graph in the box and the legend in two lines below it, with type of size `em` [px]. Expects moments in
// ascending order. A box without height gets only the legend.
void paintEnergies(Painting& painting, const PictureBox& box, float em, std::span<const Moment> moments, double now);

}  // namespace taut::pipeline
