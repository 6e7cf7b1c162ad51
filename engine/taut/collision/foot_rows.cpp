#include "taut/collision/private/foot_rows.h"

#include <algorithm>

#include "taut/collision/private/foot_finder.h"

namespace taut::collision {

void findFeet(const FeetArgs& args, double thickness, int n, ContactLanes& lanes) {
    const FootFinder& finder = *args.finder;
    FootRows& rows = *args.rows;
    for (int i = 0; i < n; ++i) {
        if (lanes.outcome[i] != isLost) continue;
        const int at = args.first + i;
        const dvec3 p(lanes.localEnd[0][i], lanes.localEnd[1][i], lanes.localEnd[2][i]);
        const auto take = [&](const Foot& foot) {
            for (int k = 0; k < 3; ++k) lanes.foot[k][i] = foot.point[k];
            lanes.triangle[i] = foot.triangle;
            lanes.outcome[i] = hasFoot;
        };

        // At an edge it is one of few triangles; at the middle of one it is time to note that.
        const dvec3 off = p - dvec3(rows.anchor[0][at], rows.anchor[1][at], rows.anchor[2][at]);
        if (rows.finder[at] == &finder && std::sqrt(glm::dot(off, off)) <= rows.fewRadius[at]) {
            const Foot foot = finder.footAmong(p, {rows.few[at], rows.fewCount[at]});
            if (foot.square - foot.facing * foot.facing > 1e-6 * foot.square) {
                take(foot);
                continue;
            }
        }

        const double reach = std::sqrt(lanes.way[i]) + (thickness + lanes.skin[i]);
        const FootFinder::Around known = finder.know(p, reach);
        for (int k = 0; k < 3; ++k) rows.anchor[k][at] = p[k];
        rows.clear[at] = known.clear;
        rows.radius[at] = known.radius;
        rows.triangle[at] = known.foot.triangle;
        rows.fewRadius[at] = known.fewRadius;
        std::copy(known.few.begin(), known.few.end(), rows.few[at]);
        rows.fewCount[at] = known.fewCount;
        rows.finder[at] = &finder;
        if (known.clear >= reach)
            lanes.outcome[i] = 0;
        else if (known.foot.triangle < 0)
            lanes.outcome[i] = anyLeft;
        else
            take(known.foot);
    }
}

}  // namespace taut::collision
