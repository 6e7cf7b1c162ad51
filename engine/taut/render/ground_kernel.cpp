// Compiled once for each instruction set; see taut_kernels in engine/taut.cmake. The formulas are those of ground.frag,
// background.frag and tone.glsl, which draw what this leaves out; RenderGround.* compares the two.
#include "taut/core/private/vectors.h"
#include "taut/render/private/ground_kernels.h"

namespace taut::render::TAUT_ISA {
namespace {

using core::TAUT_ISA::isAny, core::TAUT_ISA::larger, core::TAUT_ISA::root;
using core::TAUT_ISA::smaller, core::TAUT_ISA::vectorBytes;
using Floats = core::TAUT_ISA::WideVector<float>;
using Ints = core::TAUT_ISA::WideVector<std::int32_t>;
constexpr int lanesOfGround = vectorBytes / 4;

Floats all(float x) {
    return x - Floats{};
}

Floats limited(Floats x, float low, float high) {
    return smaller(larger(x, all(low)), all(high));
}

Floats blend(Floats a, Floats b, Floats part) {
    return a + (b - a) * part;
}

// Of numbers within ± 2³¹.
Floats floorOf(Floats x) {
    const Floats whole = __builtin_convertvector(__builtin_convertvector(x, Ints), Floats);
    return whole > x ? whole - 1.0F : whole;
}

Floats fraction(Floats x) {
    return x - floorOf(x);
}

Floats sizeOf(Floats x) {
    return x < 0.0F ? -x : x;
}

Floats linesOf(Floats x, Floats pixel) {
    const Floats width = all(0.012F);
    pixel = larger(pixel, all(1e-5F));
    const Floats drawn = larger(width, pixel), off = sizeOf(fraction(x + 0.5F) - 0.5F);
    const Floats cover = limited((0.5F * drawn - off) / pixel + 0.5F, 0.0F, 1.0F) * width / drawn;
    return blend(cover, width, limited(2.0F * pixel - 0.5F, 0.0F, 1.0F));
}

Floats toned(Floats light) {
    const Floats x = 0.75F * light;
    return limited((x * (2.51F * x + 0.03F)) / (x * (2.43F * x + 0.59F) + 0.14F), 0.0F, 1.0F);
}

// A byte of the sRGB curve. Mesa's software renderers take the power 1 / 2.4 as a mean of 3/8 and 1/2; it is off by
// 0.1.
Ints curveByte(Floats light) {
    light = limited(light, 0.0F, 1.0F);
    const Floats half = root(light), quarter = root(half);
    const Floats curve = 255.0F * (1.0622F * (0.675F * quarter * root(quarter) + 0.325F * half) - 0.062F);
    return __builtin_convertvector((light < 0.0031308F ? 255.0F * 12.92F * light : curve) + 0.5F, Ints);
}

// Of each of some pixels beside each other.
struct GroundRow {
    Floats x, z;           // [m] place on the ground
    Floats across, along;  // [m] size of the pixel there, along x and z
    Floats away;           // how far it has faded into the horizon, 0 … 1; of sky the part of its upper colour
    Floats open;           // part of the light of the sky
    Ints isGround;
};

GroundRow placesOf(const GroundArgs& args, Floats right, float upper) {
    const float *first = args.firstWay, *up = args.upWay, *aside = args.rightWay;
    const Floats wayX = right * aside[0] + (first[0] + upper * up[0]);
    const Floats wayY = right * aside[1] + (first[1] + upper * up[1]);
    const Floats wayZ = right * aside[2] + (first[2] + upper * up[2]);
    const Floats inverse = 1.0F / wayY, t = (args.height - args.eye[1]) * inverse;
    GroundRow row;
    row.x = args.eye[0] + t * wayX;
    row.z = args.eye[2] + t * wayZ;
    const Floats slopeX = wayX * inverse, slopeZ = wayZ * inverse;
    row.across = t * (sizeOf(aside[0] - slopeX * aside[1]) + sizeOf(up[0] - slopeX * up[1]));
    row.along = t * (sizeOf(aside[2] - slopeZ * aside[1]) + sizeOf(up[2] - slopeZ * up[1]));
    const float start = args.fade[2], end = args.fade[3], range = 1.0F - start / end;
    const Floats offX = row.x - args.fade[0], offZ = row.z - args.fade[1];
    const Floats far = larger(root(offX * offX + offZ * offZ), all(start));
    row.isGround = (t > 0.0F) & (far < end);
    const Floats part = limited((1.0F - start / far) / (range > 1e-3F ? range : 1e-3F), 0.0F, 1.0F);
    const Floats rise = larger(wayY, Floats{}), square = rise * rise / (wayX * wayX + wayY * wayY + wayZ * wayZ);
    row.away = row.isGround ? part * part * (3.0F - 2.0F * part) : square / (square + 0.0064F);
    row.open = all(1.0F);
    return row;
}

// Filtered as GL does it, 0 beyond the map.
void findOpen(const GroundArgs& args, GroundRow& row) {
    const int edge = args.hiddenEdge;
    const auto size = static_cast<float>(edge);
    const Floats x = (row.x - args.hiddenLow[0]) * (args.hiddenScale[0] * size) - 0.5F;
    const Floats z = (row.z - args.hiddenLow[1]) * (args.hiddenScale[1] * size) - 0.5F;
    const Ints isInside = row.isGround & (x > -1.0F) & (z > -1.0F) & (x < size) & (z < size);
    if (!isAny(isInside)) return;
    const auto texel = [&](int column, int line) {
        const bool isOutside = column < 0 || line < 0 || column >= edge || line >= edge;
        return isOutside ? 0.0F : args.hidden[line * edge + column];
    };
    for (int i = 0; i < lanesOfGround; ++i) {
        if (isInside[i] == 0) continue;
        const int column = static_cast<int>(x[i] + 1.0F) - 1, line = static_cast<int>(z[i] + 1.0F) - 1;
        const float right = x[i] - static_cast<float>(column), upper = z[i] - static_cast<float>(line);
        const float low = texel(column, line) + (texel(column + 1, line) - texel(column, line)) * right;
        const float high = texel(column, line + 1) + (texel(column + 1, line + 1) - texel(column, line + 1)) * right;
        row.open[i] = 1.0F - 0.9F * (low + (high - low) * upper);
    }
}

Ints coloursOf(const GroundArgs& args, const GroundRow& row, Floats right, float upper) {
    const Floats across = linesOf(row.x * args.lines, row.across * args.lines);
    const Floats along = linesOf(row.z * args.lines, row.along * args.lines);
    const Floats shown = 1.0F - args.lineShade * larger(across, along);
    const Floats noise =
        (fraction(52.9829189F * fraction(0.06711056F * right + 0.00583715F * upper)) - 0.5F) * (1.0F / 255.0F);
    Ints colours{};
    for (int c = 0; c < 3; ++c) {
        const Floats light = toned(args.albedo[c] * shown * (args.direct[c] + args.sky[c] * row.open));
        const Floats from = row.isGround ? light : all(args.horizon[c]);
        const Floats to = all(args.horizon[c]) + (row.isGround ? Floats{} : all(args.top[c] - args.horizon[c]));
        const Floats here = blend(from, to, row.away);
        colours |= curveByte(here + noise * (1.8F * root(here) + 0.08F)) << (8 * c);
    }
    return colours;
}

void fillPixels(const GroundArgs& args, int x, int y, int count, std::uint32_t* colours, float* depths) {
    const auto nothing = static_cast<std::int32_t>(args.nothing << 24);
    Floats steps;
    for (int i = 0; i < lanesOfGround; ++i) steps[i] = static_cast<float>(i);
    for (int i = 0; i < count; i += lanesOfGround) {
        const std::size_t bytes = 4 * static_cast<std::size_t>(count - i < lanesOfGround ? count - i : lanesOfGround);
        Ints before{};  // beyond the row something is there, before all else
        Floats depth{};
        __builtin_memcpy(&before, colours + i, bytes);
        if (depths != nullptr) __builtin_memcpy(&depth, depths + i, bytes);
        const Floats column = static_cast<float>(x + i) + steps;
        const Floats ground = args.depthStart + args.depthUp * static_cast<float>(y) + args.depthAlong * column;
        const Ints mark = before & ~0xffffff, isUndrawn = mark == nothing;
        const Ints isBehind = (mark != 0) & (ground < depth);  // without a mark it is ground that GL has drawn
        if (!isAny(isUndrawn | isBehind)) continue;
        GroundRow row = placesOf(args, column + 0.5F, static_cast<float>(y) + 0.5F);
        if (args.hidden != nullptr) findOpen(args, row);
        const Ints colour = coloursOf(args, row, column + 0.5F, static_cast<float>(y) + 0.5F);
        const Ints isOwn = isUndrawn | (row.isGround & isBehind);
        before = isOwn ? colour : before;
        depth = isOwn ? (row.isGround ? ground : all(1.0F)) : depth;
        __builtin_memcpy(colours + i, &before, bytes);
        if (depths != nullptr) __builtin_memcpy(depths + i, &depth, bytes);
    }
}

}  // namespace

extern const GroundKernels grounds{fillPixels};

}  // namespace taut::render::TAUT_ISA
