// Compiled once for each instruction set; see taut_kernels in engine/taut.cmake.
#include "taut/core/private/vectorise.h"
#include "taut/core/private/vectors.h"
#include "taut/render/private/depth_kernels.h"

namespace taut::render::TAUT_ISA {
namespace {

using core::TAUT_ISA::larger, core::TAUT_ISA::load, core::TAUT_ISA::smaller, core::TAUT_ISA::store;
using core::TAUT_ISA::vectorBytes;
using Floats = core::TAUT_ISA::WideVector<float>;
using Ints = core::TAUT_ISA::WideVector<std::int32_t>;
using Depths = core::TAUT_ISA::Lanes<std::uint16_t, vectorBytes / 2>::Vector;
constexpr int lanes = vectorBytes / 4;

// Texels whose middles lie between two places, within low … high.
struct Range {
    int first, last;

    Range(float from, float to, int low, int high) {
        // Rounded inwards; the conversion rounds towards zero, places below 0 are cut off first.
        from = larger(from + 0.5F, 0.0F);
        to = smaller(to + 0.5F, static_cast<float>(high) + 1.0F);
        first = static_cast<int>(from);
        last = to < 0.0F ? -1 : static_cast<int>(to);
        first = first < low ? low : first;
        last = last > high ? high : last;
    }
};

// Not below zero on the inner side of the way from one corner to the next, a little of the outer one included: of two
// triangles with a side in common one has each texel on it, whatever rounding does.
struct Side {
    float start, along, up;

    Side(float ax, float ay, float bx, float by) {
        along = ay - by;
        up = bx - ax;
        const float size = (along < 0.0F ? -along : along) + (up < 0.0F ? -up : up);
        start = -up * ay - along * ax + 0.002F * size;
    }
};

// Over 60 lines: what is worked out for the triangle stays in registers through its rows and columns.
void drawTriangle(const MapTriangle& triangle, int edge, int low, int high, std::uint16_t* map) {
    const float *x = triangle.x, *y = triangle.y, *depth = triangle.depth;
    const Range columns(smaller(smaller(x[0], x[1]), x[2]) - 0.002F, larger(larger(x[0], x[1]), x[2]) + 0.002F - 1.0F,
                        0, edge - 1);
    const Range rows(smaller(smaller(y[0], y[1]), y[2]) - 0.002F, larger(larger(y[0], y[1]), y[2]) + 0.002F - 1.0F, low,
                     high);
    if (columns.first > columns.last || rows.first > rows.last) return;

    // From a place nearby on: numbers stay small.
    const auto middleX = static_cast<float>(static_cast<int>(x[0])),
               middleY = static_cast<float>(static_cast<int>(y[0]));
    const float ax = x[0] - middleX, ay = y[0] - middleY, bx = x[1] - middleX, by = y[1] - middleY;
    const float cx = x[2] - middleX, cy = y[2] - middleY;
    const float area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    if (area == 0.0F) return;
    const bool isTurned = area < 0.0F;
    const Side sides[3]{isTurned ? Side(ax, ay, cx, cy) : Side(ax, ay, bx, by),
                        isTurned ? Side(cx, cy, bx, by) : Side(bx, by, cx, cy),
                        isTurned ? Side(bx, by, ax, ay) : Side(cx, cy, ax, ay)};
    const float rise = depth[1] - depth[0], riseOther = depth[2] - depth[0];
    const float depthAlong = 65535.0F * ((rise * (cy - ay) - riseOther * (by - ay)) / area);
    const float depthUp = 65535.0F * ((riseOther * (bx - ax) - rise * (cx - ax)) / area);
    const float near = 65535.0F * smaller(smaller(depth[0], depth[1]), depth[2]) + 0.5F;
    const float far = 65535.0F * larger(larger(depth[0], depth[1]), depth[2]) + 0.5F;
    const Floats nearest = near - Floats{}, farthest = far - Floats{};
    Floats steps;
    for (int i = 0; i < lanes; ++i) steps[i] = static_cast<float>(i);
    const bool isWide = columns.last - columns.first >= 2 * lanes;
    float inverse[3];
    for (int i = 0; i < 3; ++i) inverse[i] = sides[i].along == 0.0F ? 0.0F : -1.0F / sides[i].along;

    for (int row = rows.first; row <= rows.last; ++row) {
        const float up = static_cast<float>(row) + 0.5F - middleY;
        int from = columns.first, to = columns.last;
        float starts[3];
        for (int i = 0; i < 3; ++i) starts[i] = sides[i].start + sides[i].up * up;
        if (isWide) {
            // Where each side is crossed, and a texel to spare.
            float left = static_cast<float>(from), right = static_cast<float>(to);
            for (int i = 0; i < 3; ++i) {
                const float crossing = starts[i] * inverse[i] + middleX;
                if (sides[i].along > 0.0F) left = larger(left, smaller(crossing - 1.5F, right + 1.0F));
                if (sides[i].along < 0.0F) right = smaller(right, larger(crossing + 0.5F, left - 1.0F));
            }
            from = static_cast<int>(left);
            to = static_cast<int>(right);
        }
        const float depthStart = 65535.0F * depth[0] + 0.5F + depthUp * (up - ay);
        std::uint16_t* texels = map + static_cast<long>(row) * edge;
        for (int column = from; column <= to; column += lanes) {
            const int first = column < edge - lanes ? column : edge - lanes;
            const Floats along = (static_cast<float>(first) + 0.5F - middleX) + steps;
            const Ints outside = (Ints)(starts[0] + sides[0].along * along) |
                                 (Ints)(starts[1] + sides[1].along * along) |
                                 (Ints)(starts[2] + sides[2].along * along);
            const Floats value = smaller(larger(depthStart + depthAlong * (along - ax), nearest), farthest);
            const Ints whole = __builtin_convertvector(value, Ints) | (outside >> 31);
            const Depths here = __builtin_convertvector(whole & 0xffff, Depths);
            store(texels + first, smaller(here, load<Depths>(texels + first)));
        }
    }
}

void drawTriangles(const MapTriangle* triangles, int count, int edge, int low, int high, std::uint16_t* map) {
    for (int i = 0; i < count; ++i) drawTriangle(triangles[i], edge, low, high, map);
}

void findBounds(const std::uint16_t* rows, int edge, int count, std::uint16_t* least, std::uint16_t* largest) {
    for (int x = 0; x < edge; ++x) least[x] = largest[x] = rows[x];
    for (int row = 1; row < count; ++row) {
        const std::uint16_t* here = rows + static_cast<long>(row) * edge;
        TAUT_INDEPENDENT
        for (int x = 0; x < edge; ++x) {
            least[x] = here[x] < least[x] ? here[x] : least[x];
            largest[x] = here[x] > largest[x] ? here[x] : largest[x];
        }
    }
}

void addHidden(const SkyRing (&rings)[skyRings], int count, float* hidden) {
    constexpr int most = 64;
    float from[most], to[most];
    for (int begin = 0; begin < count; begin += most) {
        const int n = count - begin < most ? count - begin : most;
        for (int i = 0; i < n; ++i) {
            from[i] = 1.0F;
            to[i] = 0.0F;
        }
        for (int ring = 0; ring < skyRings; ++ring) {
            const float *low = rings[ring].low + begin, *high = rings[ring].high + begin;
            const float away = rings[ring].away, beyond = ring == 0 ? away : 1.2F * away;
            // Nearly above, a column hides all the sky that its lower end covers.
            const float least = ring == 0 ? 1.0F : 0.0F;
            TAUT_INDEPENDENT
            for (int i = 0; i < n; ++i) {
                const float below = low[i] * low[i], above = high[i] * high[i];
                const float start = below / (below + beyond * beyond);
                float end = above / (above + away * away);
                end = end > least ? end : least;
                const bool isThere = low[i] < 1000.0F;
                const float first = isThere ? start : 1.0F, last = isThere ? end : 0.0F;
                from[i] = first < from[i] ? first : from[i];
                to[i] = last > to[i] ? last : to[i];
            }
        }
        float* sum = hidden + begin;
        for (int i = 0; i < n; ++i) {
            const float more = to[i] - from[i];
            sum[i] += more > 0.0F ? more : 0.0F;
        }
    }
}

}  // namespace

extern const DepthKernels depths{drawTriangles, findBounds, addHidden};

}  // namespace taut::render::TAUT_ISA
