// Compiled once for each instruction set; see taut_kernels in engine/taut.cmake.
#include "taut/core/private/vectorise.h"
#include "taut/core/private/vectors.h"
#include "taut/render/private/edge_kernels.h"

namespace taut::render::TAUT_ISA {
namespace {

using core::TAUT_ISA::load, core::TAUT_ISA::select, core::TAUT_ISA::store;

// Four samples of each of so many pixels beside each other.
constexpr int pixels = core::TAUT_ISA::vectorBytes / 16;
using Floats = core::TAUT_ISA::WideVector<float>;
using Ints = core::TAUT_ISA::WideVector<std::int32_t>;

constexpr int tile = 16;  // [pixels]
constexpr int group = 4;  // [pixels] beside each other, from whose first one numbers are reckoned
constexpr int vectors = group / pixels;

// What each sample has more than the corner of a group's first pixel.
struct Within {
    Floats parts[vectors];

    Within(float along, const float* samples) {
        float result[4 * group];
        for (int pixel = 0; pixel < group; ++pixel)
            for (int i = 0; i < 4; ++i) result[4 * pixel + i] = along * static_cast<float>(pixel) + samples[i];
        __builtin_memcpy(parts, result, sizeof(result));
    }
};

float clamped(float x, float low, float high) {
    return x < low ? low : x > high ? high : x;
}

// Leaves those of the columns of a row that may have a sample inside.
void narrow(const TileSlope& side, int y, int& left, int& right) {
    if (side.along == 0.0F) return;
    const float up = side.up > 0.0F ? side.up * static_cast<float>(y + 1) : side.up * static_cast<float>(y);
    const float crossing = clamped(-(side.start + up) / side.along, -2.0F, 1.0F + tile);
    const int column = static_cast<int>(crossing + 1.0F);
    if (side.along > 0.0F)
        left = column - 2 > left ? column - 2 : left;  // not before the pixel with the crossing
    else
        right = column < right ? column : right;
}

constexpr int wide = 10;  // [pixels] narrowing a row pays where it is longer

void cover(const CoverageArgs& args) {
    const TileSlope &a = args.sides[0], &b = args.sides[1], &c = args.sides[2], &depth = args.depth;
    const Within inA(a.along, a.samples), inB(b.along, b.samples), inC(c.along, c.samples);
    const float middles[4]{args.toMiddle, args.toMiddle, args.toMiddle, args.toMiddle};
    const Within ahead(depth.along, depth.samples), middle(depth.along, middles);
    const Ints mark = args.mark - Ints{};
    for (int y = args.low; y <= args.high; ++y) {
        int from = args.left, to = args.right;
        if (to - from >= wide)
            for (const TileSlope& side : args.sides) narrow(side, y, from, to);
        const auto row = static_cast<float>(y);
        const float startA = a.start + a.up * row, startB = b.start + b.up * row, startC = c.start + c.up * row;
        const float startDepth = depth.start + depth.up * row;
        for (int x = from & -group; x <= to; x += group) {
            const auto column = static_cast<float>(x);
            const float atA = startA + a.along * column, atB = startB + b.along * column;
            const float atC = startC + c.along * column, atDepth = startDepth + depth.along * column;
            for (int i = 0; i < vectors; ++i) {
                const int first = 4 * (y * tile + x + i * pixels);
                float *nearest = args.nearest + first, *depths = args.middle + first;
                std::int32_t* marks = args.marks + first;
                // A sign is that of what is outside, or of what is nearer.
                const Ints sides = (Ints)(atA + inA.parts[i]) | (Ints)(atB + inB.parts[i]) | (Ints)(atC + inC.parts[i]);
                const Floats here = atDepth + ahead.parts[i], before = load<Floats>(nearest);
                const Ints seen = ~(sides >> 31) & ((Ints)(here - before) >> 31);
                store(nearest, select(seen, here, before));
                store(depths, select(seen, atDepth + middle.parts[i], load<Floats>(depths)));
                store(marks, select(seen, mark, load<Ints>(marks)));
            }
        }
    }
}

void findEdges(const std::uint32_t* const colours[3], const float* const depths[3], int first, int last,
               std::uint8_t* isEdge) {
    const std::uint32_t *below = colours[0], *here = colours[1], *above = colours[2];
    const float *depthBelow = depths[0], *depthHere = depths[1], *depthAbove = depths[2];
    TAUT_INDEPENDENT
    for (int x = first; x < last; ++x) {
        const std::uint32_t mark = here[x] >> 24;
        const std::uint32_t others = (mark ^ (here[x - 1] >> 24)) | (mark ^ (here[x + 1] >> 24)) |
                                     (mark ^ (below[x] >> 24)) | (mark ^ (above[x] >> 24));
        const float twice = 2.0F * depthHere[x];
        const float along = __builtin_fabsf(depthHere[x - 1] + depthHere[x + 1] - twice);
        const float across = __builtin_fabsf(depthBelow[x] + depthAbove[x] - twice);
        const float bend = along > across ? along : across;
        const bool isBent = bend > 0.0004F * (1.0F - depthHere[x]) + 5e-7F;
        isEdge[x] = static_cast<std::uint8_t>((others != 0) | (isBent & (mark != 0)));
    }
}

void fillUndrawn(std::size_t count, std::uint32_t mark, const std::uint32_t* kept, std::uint32_t* colours) {
    TAUT_INDEPENDENT
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t before = colours[i], other = kept[i];
        colours[i] = before >> 24 == mark ? other : before;
    }
}

void fillNearer(std::size_t count, const std::uint32_t* kept, const float* keptDepths, std::uint32_t* colours,
                float* depths) {
    TAUT_INDEPENDENT
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t before = colours[i], other = kept[i];
        const float depth = depths[i], otherDepth = keptDepths[i];
        colours[i] = otherDepth < depth ? other : before;
        depths[i] = otherDepth < depth ? otherDepth : depth;
    }
}

void takeColours(std::size_t count, const std::uint32_t* from, std::uint8_t* to) {
    std::size_t i = 0;
#ifdef __AVX2__
    // Sixteen bytes are written for twelve: the next ones, or the loop below, go over the rest.
    for (; i + 6 <= count; i += 4) {
        const auto four = load<core::TAUT_ISA::NarrowVector<std::uint8_t>>(from + i);
        store(to + 3 * i, __builtin_shufflevector(four, four, 0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, 3, 7, 11, 15));
    }
#endif
    for (; i < count; ++i) {
        to[3 * i] = static_cast<std::uint8_t>(from[i]);
        to[3 * i + 1] = static_cast<std::uint8_t>(from[i] >> 8);
        to[3 * i + 2] = static_cast<std::uint8_t>(from[i] >> 16);
    }
}

}  // namespace

extern const EdgeKernels edges{cover, findEdges, fillUndrawn, fillNearer, takeColours};

}  // namespace taut::render::TAUT_ISA
