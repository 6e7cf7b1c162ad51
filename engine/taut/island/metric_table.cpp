#include "taut/island/metric_table.h"

#include <algorithm>
#include <cmath>

#include "taut/plan/island_plan.h"
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

// A row that reads a member of Metrics.
template <auto member>
constexpr MetricSource ofMember = {
    [](const Metrics& metrics) -> MetricValue { return metrics.*member; },
    [](Metrics& metrics, const NumberVisitor& visit) { visitNumber(metrics.*member, visit); }};

// A row that reads a count of the methods' work.
template <auto member>
constexpr MetricSource ofWork = {
    [](const Metrics& metrics) -> MetricValue { return metrics.work.*member; },
    [](Metrics& metrics, const NumberVisitor& visit) { visitNumber(metrics.work.*member, visit); }};

constexpr MetricSource totalEnergy = {[](const Metrics& metrics) -> MetricValue { return metrics.energy(); }};

constexpr MetricSource volumeRatio = {[](const Metrics& metrics) -> MetricValue {
                                          return metrics.restVolume > 0 ? metrics.volume / metrics.restVolume
                                                                        : 1.0;  // without cells no volume is lost
                                      },
                                      [](Metrics& metrics, const NumberVisitor& visit) {
                                          visitNumber(metrics.volume, visit);
                                          visitNumber(metrics.restVolume, visit);
                                      }};

double largestSpeed(const MeasuredIsland& island, double before) {
    double squared = 0;
    for (std::size_t i = 0; i < island.v.size(); ++i)
        if (island.counts[i]) squared = std::max(squared, glm::dot(island.v[i], island.v[i]));
    return std::max(before, std::sqrt(squared));
}

}  // namespace

std::span<const Metric> metricTable() {
    using M = Metrics;
    static constexpr Metric table[] = {
        {"kinetic_J", "kinetic_energy", "J", "Of motion.", ofMember<&M::kinetic>, 1},
        {"elastic_J", "elastic_energy", "J", "Of springs and volumes.", ofMember<&M::elastic>, 1},
        {"gravitational_J", "potential_energy", "J", "Of gravity; 0 for a point at the origin.",
         ofMember<&M::gravitational>},
        {"total_J", "energy", "J", "Kinetic, elastic and gravitational energy.", totalEnergy},
        {"momentum_x_kg_m_per_s,momentum_y_kg_m_per_s,momentum_z_kg_m_per_s", "momentum", "kg m/s",
         "Sum of mass times velocity.", ofMember<&M::momentum>},
        {"angular_x_kg_m2_per_s,angular_y_kg_m2_per_s,angular_z_kg_m2_per_s", "angular_momentum", "kg m²/s",
         "About the origin.", ofMember<&M::angularMomentum>},
        {"max_strain", "max_strain", "", "Largest |l - L|/L of any rod and any spring but those of bending.",
         ofMember<&M::maxStrain>, 1},
        {"contacts", "contacts", "", "Number of points that touch a collider.", ofMember<&M::contacts>, 1},
        {"inverted_cells", "inverted", "", "Number of cells of blocks that are turned inside out.",
         ofMember<&M::invertedCells>, 1},
        {"min_volume_ratio", "cell_volume", "", "Volume over that at rest of the cell of a block that has shrunk most.",
         ofMember<&M::minVolumeRatio>, -1},
        {"evaluations", "", "", "", ofWork<&ode::Work::evaluations>},
        {"solver_iterations", "", "", "", ofWork<&ode::Work::iterations>},
        {"unconverged_solves", "", "", "", ofWork<&ode::Work::unconverged>},
        {"torn_springs", "torn", "",
         "Number of springs, and of ties of joints, that were cut, have torn or were released.",
         ofMember<&M::brokenSprings>, 1},
        {"volume_ratio", "volume", "", "Volume of blocks over that at rest; 1 of none.", volumeRatio},
        {"penetration_m", "penetration", "m", "Largest depth of a free point inside a collider.",
         ofMember<&M::penetration>, 1},
        {"body_contacts", "body_contacts", "",
         "Number of places where bodies with `touch` press on each other, or on themselves.",
         ofMember<&M::bodyContacts>, 1, Measures::butCrossings, Counts::touchingBodies},
        {"crossings", "crossings", "",
         "Number of edges of bodies with `touch` that go through triangles of such, and of edges through figures.",
         ofMember<&M::crossings>, 1, Measures::all, Counts::touchingBodies},
        {"face_penetration_m", "face_penetration", "m",
         "Largest height that a collider's corner or sharp edge stands out of a triangle, of bodies that meet those.",
         ofMember<&M::facePenetration>, 1, Measures::all, Counts::bodiesMeetingFaces},
        {"squeezed", "squeezed", "",
         "Number of points that parts of a figure close upon from both sides, and are let through one of them.",
         ofMember<&M::squeezed>, 1, Measures::butCrossings, Counts::touchingBodies},
        {"max_speed_m_per_s", "", "m/s", "Largest speed of a point.", {.measure = largestSpeed}},
        {"asleep", "asleep", "", "Number of points that sleep.", ofMember<&M::asleep>},
        {"slept_J", "slept_energy", "J", "Energy of motion that falling asleep has taken since the start.",
         ofMember<&M::sleptEnergy>},
    };
    return table;
}

MetricValue Metric::value(const Metrics& metrics) const {
    if (source.measure == nullptr) return source.value(metrics);
    const auto row = static_cast<std::size_t>(this - metricTable().data());
    return row < metrics.measured.size() ? metrics.measured[row] : 0.0;
}

void addMeasured(const MeasuredIsland& island, Metrics& metrics) {
    const std::span<const Metric> table = metricTable();
    metrics.measured.resize(table.size(), 0.0);
    for (std::size_t row = 0; row < table.size(); ++row)
        if (table[row].source.measure != nullptr)
            metrics.measured[row] = table[row].source.measure(island, metrics.measured[row]);
}

void eachNumber(Metrics& metrics, const NumberVisitor& visit) {
    visit(&metrics.time);
    const std::span<const Metric> table = metricTable();
    metrics.measured.resize(table.size(), 0.0);
    for (std::size_t row = 0; row < table.size(); ++row) {
        if (table[row].source.eachNumber != nullptr) table[row].source.eachNumber(metrics, visit);
        if (table[row].source.measure != nullptr) visit(&metrics.measured[row]);
    }
}

bool isCounted(Counts counts, const BodySpec& body) {
    return counts == Counts::everyBody || body.touch != Touch::nothing || body.meetsFigures ||
           (counts == Counts::bodiesMeetingFaces && body.meetsFaces);
}

bool isCounted(Counts counts, const SceneSpec& scene) {
    return counts == Counts::everyBody ||
           std::any_of(
               scene.bodies.begin(), scene.bodies.end(), [&](const BodySpec& body) { return isCounted(counts, body); });
}

}  // namespace taut::world
