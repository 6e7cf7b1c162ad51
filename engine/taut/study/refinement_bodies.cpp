#include "taut/study/refinement_bodies.h"

#include <cmath>
#include <numbers>

#include "taut/core/private/bisect.h"
#include "taut/mechanics/builders.h"

namespace taut::study {
namespace {

using glm::dvec3;
using mechanics::Lumping;
using mechanics::Model;

constexpr double g = -refinementGravity.y;

void hold(Model& model, const char* group) {
    for (const int i : model.groups.at(group)) model.held[i] = true;
}

// Masses of one build and springs of another: the builders know both ways for cloths, but not one without the other.
template <class Build>
Model mixed(Build build, Lumped lumped) {
    Model model = build(Lumping::weighted);
    if (lumped.isMassNaive || lumped.areSpringsNaive) {
        Model naive = build(Lumping::uniform);
        if (lumped.isMassNaive) model.masses = std::move(naive.masses);
        if (lumped.areSpringsNaive) model.springs = std::move(naive.springs);
    }
    return model;
}

// A rope between two points on one level, `length` long before it is stretched. The smooth elastic catenary with the
// level pull H and half the weight V = Mg/2 (Irvine, Cable Structures, 1981, section 1.4):
//   span = H L/EA + (2HL/Mg) asinh(V/H),   sag = (HL/Mg) (√(1 + V²/H²) - 1) + V L/4EA.
struct Rope {
    double length, mass, stretch;

    Model build(int cells, Lumped lumped) const {
        Model model = mixed(
            [&](Lumping lumping) {
                return mechanics::buildRope({.start = {0, 0, 0},
                                             .end = {1, 0, 0},
                                             .segments = cells,
                                             .length = length,
                                             .mass = mass,
                                             .stretch = stretch,
                                             .lumping = lumping});
            },
            lumped);
        hold(model, "ends");
        return model;
    }
    double sag() const {
        const double v = 0.5 * mass * g, perWeight = length / (mass * g);
        const double pull =
            core::rootOf([&](double h) { return 1.0 - h * length / stretch - 2.0 * h * perWeight * std::asinh(v / h); },
                         1e-6, 1e6, 200);
        return pull * perWeight * (std::hypot(1.0, v / pull) - 1.0) + v * length / (4.0 * stretch);
    }
};

RefinementBody ropeBody(const char* name, const char* title, Rope rope) {
    return {name,
            title,
            "sag",
            rope.sag(),
            "elastic catenary",
            false,
            [rope](int cells, Lumped lumped) { return rope.build(cells, lumped); },
            [](const std::vector<dvec3>& x, int cells) { return -x[cells / 2].y; }};
}

RefinementBody hangingRope() {
    constexpr double length = 1.0, mass = 0.5, stretch = 60.0;
    return {"rope-hanging",
            "Rope hung by one end",
            "stretch",
            mass * g * length / (2.0 * stretch),
            "MgL/2EA",
            false,
            [](int cells, Lumped lumped) {
                Model model = mixed(
                    [&](Lumping lumping) {
                        return mechanics::buildRope({.start = {0, 0, 0},
                                                     .end = {0, -length, 0},
                                                     .segments = cells,
                                                     .mass = mass,
                                                     .stretch = stretch,
                                                     .lumping = lumping});
                    },
                    lumped);
                hold(model, "start");
                return model;
            },
            [](const std::vector<dvec3>& x, int) { return -x.back().y - length; }};
}

// Square cells of an isotropic sheet: k_d = k_s/2, E = 4 k_s/3 [N/m], ν = 1/3.
Model sheet(glm::dvec2 size, glm::ivec2 cells, double stretch, Lumped lumped) {
    return mixed(
        [&](Lumping lumping) {
            return mechanics::buildCloth({.origin = {-0.5 * size.x, 0, 0},
                                          .size = size,
                                          .cells = cells,
                                          .material = {0.2, stretch, 0.5 * stretch, 0.0, 0.0, 0.0, lumping}});
        },
        lumped);
}

// A bar that hangs from its upper end, uniform in its section: at the height s above the lower end the stress is ρgs,
// and, up to a rigid motion, the displacements are those of the linear theory of elasticity (Timoshenko and Goodier,
// Theory of Elasticity, section 96):
//   up      ρg (s² + ν r²)/2E,   r the distance from the axis
//   aside  -ν ρg s r/E.
// The upper end is held where this puts it, so that the solution holds throughout. Its middle stays.
void holdAsTheorySays(Model& model, double length, double poisson, double strainPerMetre) {
    for (const int i : model.groups.at("top")) {
        dvec3& x = model.positions[i];
        const double square = x.x * x.x + x.z * x.z;
        x.x -= poisson * strainPerMetre * length * x.x;
        x.z -= poisson * strainPerMetre * length * x.z;
        x.y += 0.5 * poisson * strainPerMetre * square;
    }
    hold(model, "top");
}

// The linear theories want small strains: of 1e-6 here, so that the neglected terms do not show.
constexpr double smallStrain = 1e-6;

RefinementBody clothStrip() {
    constexpr double length = 1.0, density = 0.2, young = density * g * length / smallStrain;
    return {"cloth-strip",
            "Cloth strip hung by its end",
            "stretch",
            density * g * length * length / (2.0 * young),
            "ρgL²/2E, E = 4/3 kₛ",
            true,
            [](int cells, Lumped lumped) {
                Model model = sheet({0.5 * length, length}, {cells / 2, cells}, 0.75 * young, lumped);
                holdAsTheorySays(model, length, 1.0 / 3.0, smallStrain / length);
                return model;
            },
            [](const std::vector<dvec3>& x, int cells) {
                const auto across = static_cast<std::size_t>(cells / 2 + 1);
                return -x[x.size() - 1 - across / 2].y - length;  // the middle of the lower edge
            }};
}

RefinementBody blockColumn() {
    constexpr double length = 1.0, density = 300.0, young = density * g * length / smallStrain;
    return {"block-column",
            "Block hung by its upper face",
            "stretch",
            density * g * length * length / (2.0 * young),
            "ρgL²/2E, E = 5/2 k/ℓ",
            true,
            [](int cells, Lumped lumped) {
                mechanics::BlockShape shape;
                shape.size = {0.5 * length, length, 0.5 * length};
                shape.centre = {0.0, -0.5 * length, 0.0};
                shape.cells = {cells / 2, cells, cells / 2};
                shape.density = density;
                shape.young = young;
                shape.bulk = 0.0;
                shape.lumping = lumped.isMassNaive ? Lumping::uniform : Lumping::weighted;
                Model model = mechanics::buildBlock(shape);
                if (lumped.areSpringsNaive)
                    for (mechanics::Spring& s : model.springs) s.stiffness = 0.4 * young * length / cells;
                holdAsTheorySays(model, length, 0.25, smallStrain / length);
                return model;
            },
            [](const std::vector<dvec3>& x, int cells) {
                const auto n = static_cast<std::size_t>(cells / 2 + 1), rows = static_cast<std::size_t>(cells + 1);
                return -x[(n / 2) * n * rows + n / 2].y - length;  // the middle of the lower face
            }};
}

// A square of material stretched 5 % both ways, held at its edges and level. In coordinates X of the material its
// springs pull a point back by (k_s + 2 k_d)(1 - 1/λ) ∇²w, and ∇²w = -1 over a square of side 1 gives 0.0736713532 in
// the middle (Timoshenko and Goodier, section 109: the membrane of a twisted bar). The slope stays below 1e-4.
RefinementBody clothDrumTight() {
    constexpr double stretched = 1.05, density = 0.2, stretch = 1e5;
    constexpr double tension = 2.0 * stretch * (1.0 - 1.0 / stretched);
    return {"cloth-membrane",
            "Taut cloth held all around",
            "sag",
            0.0736713532 * density * g / tension,
            "membrane, T∇²w = ρg",
            true,
            [](int cells, Lumped lumped) {
                Model model = sheet({1.0, 1.0}, {cells, cells}, stretch, lumped);
                for (dvec3& x : model.positions) x = stretched * dvec3(x.x, 0.0, x.y);
                hold(model, "edges");
                return model;
            },
            [](const std::vector<dvec3>& x, int) { return -x[x.size() / 2].y; }};
}

// Loose bodies, whose shape at rest no formula gives.
RefinementBody clothDrape() {
    return {"cloth-drape",
            "Loose cloth held all around",
            "sag",
            {},
            "limit of finer cloths",
            true,
            [](int cells, Lumped lumped) {
                Model model = sheet({1.0, 1.0}, {cells, cells}, 40.0, lumped);
                for (dvec3& x : model.positions)
                    x = {x.x, -0.1 * std::sin(std::numbers::pi * (x.x + 0.5)) * std::sin(-std::numbers::pi * x.y), x.y};
                for (const int i : model.groups.at("edges")) model.positions[i].y = 0.0;
                hold(model, "edges");
                return model;
            },
            [](const std::vector<dvec3>& x, int) { return -x[x.size() / 2].y; }};
}

RefinementBody clothCurtain() {
    return {"cloth-curtain",
            "Cloth held along its upper edge",
            "stretch",
            {},
            "limit of finer cloths",
            true,
            [](int cells, Lumped lumped) {
                Model model = sheet({1.0, 1.0}, {cells, cells}, 40.0, lumped);
                hold(model, "top");
                return model;
            },
            [](const std::vector<dvec3>& x, int cells) {
                return -x[x.size() - 1 - static_cast<std::size_t>(cells / 2)].y - 1.0;  // middle of the lower edge
            }};
}

RefinementBody blockBeam() {
    return {"block-beam",
            "Block held at one end, level",
            "sag of the tip",
            {},
            "limit of finer blocks",
            true,
            [](int cells, Lumped lumped) {
                mechanics::BlockShape shape;
                shape.size = {1.0, 0.5, 0.5};
                shape.cells = {cells, cells / 2, cells / 2};
                shape.density = 300.0;
                shape.young = 2e6;
                shape.bulk = 0.0;
                shape.lumping = lumped.isMassNaive ? Lumping::uniform : Lumping::weighted;
                Model model = mechanics::buildBlock(shape);
                if (lumped.areSpringsNaive)
                    for (mechanics::Spring& s : model.springs) s.stiffness = 0.4 * shape.young / cells;
                hold(model, "left");
                return model;
            },
            [](const std::vector<dvec3>& x, int cells) {
                const auto n = static_cast<std::size_t>(cells / 2 + 1), row = static_cast<std::size_t>(cells + 1);
                return -x[(n / 2 * n + n / 2) * row + row - 1].y;  // the middle of the free face
            }};
}

}  // namespace

std::span<const RefinementBody> refinementBodies() {
    static const std::vector<RefinementBody> bodies = {
        ropeBody("rope-catenary", "Slack rope between two points", {1.2, 0.5, 20.0}),
        ropeBody("rope-taut", "Taut rope between two points", {0.95, 0.5, 400.0}),
        hangingRope(),
        clothDrumTight(),
        clothStrip(),
        blockColumn(),
        clothDrape(),
        clothCurtain(),
        blockBeam(),
    };
    return bodies;
}

}  // namespace taut::study
