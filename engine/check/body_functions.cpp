// What is measured of whole bodies.
#include "taut/check/function_table.h"
#include "taut/check/places.h"

namespace taut::check {

namespace {

using Arguments = std::span<const Expression>;
using world::Metrics;

const Metrics& metricsOf(const Now& now, Arguments arguments) {
    return now.metrics(arguments.empty() ? "" : arguments[0].target);
}

template <auto measure>
Quantity measured(const Now& now, Arguments arguments) {
    return {glm::dvec3(static_cast<double>(measure(metricsOf(now, arguments))), 0, 0)};
}

template <auto measure>
std::string bodyOfLargest(const Now& now, Arguments arguments) {
    return extremeBody(now, arguments.empty() ? "" : arguments[0].target,
                       [](const Metrics& m) { return static_cast<double>(measure(m)); });
}

double strain(const Metrics& m) {
    return m.maxStrain;
}
double energy(const Metrics& m) {
    return m.kinetic + m.elastic + m.gravitational;
}
double kinetic(const Metrics& m) {
    return m.kinetic;
}
double elastic(const Metrics& m) {
    return m.elastic;
}
double potential(const Metrics& m) {
    return m.gravitational;
}
int contacts(const Metrics& m) {
    return m.contacts;
}
double volume(const Metrics& m) {
    return m.restVolume > 0 ? m.volume / m.restVolume : 1.0;  // of nothing nothing is missing
}
double cellVolume(const Metrics& m) {
    return m.minVolumeRatio;
}
double shrinking(const Metrics& m) {
    return -m.minVolumeRatio;
}
int inverted(const Metrics& m) {
    return m.invertedCells;
}
int torn(const Metrics& m) {
    return m.brokenSprings;
}
double penetration(const Metrics& m) {
    return m.penetration;
}

}  // namespace

std::vector<Function> bodyFunctions() {
    const std::vector<Takes> bodies{Takes::bodies};
    return {
        {"max_strain", bodies, true, false, "", "Largest |l - L|/L of any spring but those of bending.",
         measured<strain>, bodyOfLargest<strain>},
        {"energy", bodies, true, false, "J", "Kinetic, elastic and gravitational energy.", measured<energy>, nullptr},
        {"kinetic_energy", bodies, true, false, "J", "Of motion.", measured<kinetic>, bodyOfLargest<kinetic>},
        {"elastic_energy", bodies, true, false, "J", "Of springs and volumes.", measured<elastic>,
         bodyOfLargest<elastic>},
        {"potential_energy", bodies, true, false, "J", "Of gravity; 0 for a point at the origin.", measured<potential>,
         nullptr},
        {"momentum", bodies, true, true, "kg m/s", "Sum of mass times velocity.",
         [](const Now& now, Arguments a) -> Quantity { return {metricsOf(now, a).momentum}; }, nullptr},
        {"angular_momentum", bodies, true, true, "kg m²/s", "About the origin.",
         [](const Now& now, Arguments a) -> Quantity { return {metricsOf(now, a).angularMomentum}; }, nullptr},
        {"contacts", bodies, true, false, "", "Number of points that touch a collider.", measured<contacts>,
         bodyOfLargest<contacts>},
        {"penetration", bodies, true, false, "m", "Largest depth of a free point inside a collider.",
         measured<penetration>, bodyOfLargest<penetration>},
        {"volume", bodies, true, false, "", "Volume of blocks over that at rest; 1 of none.", measured<volume>, nullptr},
        {"cell_volume", bodies, true, false, "", "The same of the cell of a block that has shrunk most.",
         measured<cellVolume>, bodyOfLargest<shrinking>},
        {"inverted", bodies, true, false, "", "Number of cells of blocks that are turned inside out.",
         measured<inverted>, bodyOfLargest<inverted>},
        {"torn", bodies, true, false, "", "Number of springs that were cut or have torn.", measured<torn>,
         bodyOfLargest<torn>},
    };
}

}  // namespace taut::check
