#include "taut/mechanics/closed_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "taut/core/mass_properties.h"
#include "taut/mechanics/builders.h"

namespace taut::mechanics {
namespace {

// Refuses a mesh with a border, and one whose faces are turned against each other.
void expectMatchingSides(std::span<const std::array<int, 3>> triangles) {
    struct Side {
        int low, high, turn;
        int triangle;
    };
    std::vector<Side> sides;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
            sides.push_back({low, high, triangles[t][k] == low ? 1 : -1, static_cast<int>(t)});
        }
    const auto rank = [](const Side& s) { return std::array{s.low, s.high, s.triangle}; };
    std::sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) { return rank(a) < rank(b); });
    struct Edges {
        int count = 0, first = -1;  // the triangle of the first

        void add(int triangle) {
            if (count++ == 0) first = triangle;
        }
    };
    Edges open, doubled, turned;
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t last = i;
        int turns = 0;
        while (last < sides.size() && sides[last].low == sides[i].low && sides[last].high == sides[i].high)
            turns += sides[last++].turn;
        const bool isOdd = (last - i) % 2 == 1;
        if (isOdd)
            (last - i == 1 ? open : doubled).add(sides[i].triangle);
        else if (turns != 0)
            turned.add(sides[i].triangle);
        i = last;
    }
    const auto expectNone = [](const Edges& edges, fmt::format_string<const int&> text) {
        if (edges.count > 0) throw MeshFault(fmt::format(text, edges.count), edges.first);
    };
    expectNone(open,
               "the mesh is not closed, so that it has no inside: {} edges have faces on one side only, the first "
               "of them at this face; fill its holes, and merge vertices that lie on each other");
    expectNone(
        doubled,
        "the mesh has no inside: at {} edges three faces meet, or a larger odd number, the first of them at this "
        "face; take out faces that are there twice, or lie within");
    expectNone(turned,
               "faces that share an edge are turned against each other, at {} edges, the first of them at this "
               "face; let all fronts look outwards");
}

}  // namespace

void expectClosed(std::span<const dvec3> positions, std::span<const std::array<int, 3>> triangles) {
    expectMatchingSides(triangles);
    const double volume = core::massPropertiesOf(positions, triangles).volume;
    if (!(volume > 0.0))
        throw MeshFault(volume < 0.0 ? "the mesh is inside out: its faces look inwards; turn them over"
                                     : "the mesh is flat, and has no inside",
                        -1);
}

}  // namespace taut::mechanics
