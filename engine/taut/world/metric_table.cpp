#include "taut/world/metric_table.h"

#include <algorithm>

#include "taut/spec/spec.h"

namespace taut::world {
namespace {

void visitNumber(glm::dvec3& vector, const NumberVisitor& visit) {
    for (int i = 0; i < 3; ++i) visit(&vector[i]);
}

template <class Number>
void visitNumber(Number& number, const NumberVisitor& visit) {
    visit(&number);
}

// A member of Metrics.
template <auto member>
constexpr MetricSource plain = {
    [](const Metrics& metrics) -> MetricValue { return metrics.*member; },
    [](Metrics& metrics, const NumberVisitor& visit) { visitNumber(metrics.*member, visit); }};

// A count of the methods' work.
template <auto member>
constexpr MetricSource done = {
    [](const Metrics& metrics) -> MetricValue { return metrics.work.*member; },
    [](Metrics& metrics, const NumberVisitor& visit) { visitNumber(metrics.work.*member, visit); }};

constexpr MetricSource totalEnergy = {[](const Metrics& metrics) -> MetricValue { return metrics.energy(); }};

constexpr MetricSource volumeRatio = {[](const Metrics& metrics) -> MetricValue {
                                          return metrics.restVolume > 0 ? metrics.volume / metrics.restVolume
                                                                        : 1.0;  // of nothing nothing is missing
                                      },
                                      [](Metrics& metrics, const NumberVisitor& visit) {
                                          visitNumber(metrics.volume, visit);
                                          visitNumber(metrics.restVolume, visit);
                                      }};

}  // namespace

std::span<const Metric> metricTable() {
    using M = Metrics;
    static constexpr Metric table[] = {
        {"kinetic_J", "kinetic_energy", "J", "Of motion.", plain<&M::kinetic>, 1},
        {"elastic_J", "elastic_energy", "J", "Of springs and volumes.", plain<&M::elastic>, 1},
        {"gravitational_J", "potential_energy", "J", "Of gravity; 0 for a point at the origin.",
         plain<&M::gravitational>},
        {"total_J", "energy", "J", "Kinetic, elastic and gravitational energy.", totalEnergy},
        {"momentum_x_kg_m_per_s,momentum_y_kg_m_per_s,momentum_z_kg_m_per_s", "momentum", "kg m/s",
         "Sum of mass times velocity.", plain<&M::momentum>},
        {"angular_x_kg_m2_per_s,angular_y_kg_m2_per_s,angular_z_kg_m2_per_s", "angular_momentum", "kg m²/s",
         "About the origin.", plain<&M::angularMomentum>},
        {"max_strain", "max_strain", "", "Largest |l - L|/L of any rod and any spring but those of bending.", plain<&M::maxStrain>,
         1},
        {"contacts", "contacts", "", "Number of points that touch a collider.", plain<&M::contacts>, 1},
        {"inverted_cells", "inverted", "", "Number of cells of blocks that are turned inside out.",
         plain<&M::invertedCells>, 1},
        {"min_volume_ratio", "cell_volume", "", "Volume over that at rest of the cell of a block that has shrunk most.",
         plain<&M::minVolumeRatio>, -1},
        {"evaluations", "", "", "", done<&ode::Work::evaluations>},
        {"solver_iterations", "", "", "", done<&ode::Work::iterations>},
        {"unconverged_solves", "", "", "", done<&ode::Work::unconverged>},
        {"torn_springs", "torn", "", "Number of springs, and of ties of joints, that were cut, have torn or let go.",
         plain<&M::brokenSprings>, 1},
        {"volume_ratio", "volume", "", "Volume of blocks over that at rest; 1 of none.", volumeRatio},
        {"penetration_m", "penetration", "m", "Largest depth of a free point inside a collider.",
         plain<&M::penetration>, 1},
        {"body_contacts", "body_contacts", "",
         "Number of places where bodies with `touch` press on each other, or on themselves.", plain<&M::bodyContacts>,
         1, Measures::butCrossings, Counts::whatTouches},
        {"crossings", "crossings", "", "Number of edges of bodies with `touch` that go through triangles of such.",
         plain<&M::crossings>, 1, Measures::all, Counts::whatTouches},
        {"face_penetration_m", "face_penetration", "m",
         "Largest height that a collider's corner or sharp edge stands out of a triangle, of bodies that meet those.",
         plain<&M::facePenetration>, 1, Measures::all, Counts::whatMeetsFaces},
    };
    return table;
}

void eachNumber(Metrics& metrics, const NumberVisitor& visit) {
    visit(&metrics.time);
    for (const Metric& metric : metricTable())
        if (metric.source.eachNumber != nullptr) metric.source.eachNumber(metrics, visit);
}

bool isCounted(Counts counts, const BodySpec& body) {
    return counts == Counts::everyBody || body.touch != Touch::nothing ||
           (counts == Counts::whatMeetsFaces && body.meetsFaces);
}

bool isCounted(Counts counts, const SceneSpec& scene) {
    return counts == Counts::everyBody ||
           std::any_of(
               scene.bodies.begin(), scene.bodies.end(), [&](const BodySpec& body) { return isCounted(counts, body); });
}

}  // namespace taut::world
