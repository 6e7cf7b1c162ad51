#include <glm/glm.hpp>

#include "taut/mechanics/private/rope_elements.h"

namespace taut::mechanics {

// E = ½ EI (|x''| - κ)² a length: the least that keeps a rest curvature without frames along the rope. It holds how
// much the rope is bent, not which way. See clamped() in bending.h for held directions.
std::vector<BendingElement> ropeElements(const Model& model, const std::vector<bool>& isHeld,
                                         const std::vector<bool>& isClamped,
                                         const std::function<bool(int, int)>& isSevered) {
    const FreeformBending& of = model.freeform;
    const int n = static_cast<int>(of.rest.size());
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    const double a = model.uv[1].x - model.uv[0].x;  // [m]
    std::vector<BendingElement> elements;
    const auto add = [&](std::vector<int> points, std::vector<double> weights, double length) -> BendingElement& {
        BendingElement element;
        element.points = std::move(points);
        for (const double w : weights) element.weights.emplace_back(w / (a * a), 0, 0);
        element.isOfRope = true;
        element.modulus[0][0] = of.rigidity.along * length;
        return elements.emplace_back(std::move(element));
    };
    for (int i = 0; i < n; ++i) {
        const bool hasBefore = of.isClosed || i > 0, hasAfter = of.isClosed || i + 1 < n;
        const int before = (i + n - 1) % n, after = (i + 1) % n;
        const bool isFreeBefore = hasBefore && !isHeld[at(before)], isFreeAfter = hasAfter && !isHeld[at(after)];
        if (isClamped[at(i)]) {
            for (const int to : {before, after}) {
                if (!(to == before ? isFreeBefore : isFreeAfter) || isSevered(i, to)) continue;
                BendingElement& half = add({i, to}, {-2, 2}, 0.5 * a);
                half.held[0] = -2.0 / (a * a) * (of.rest[at(to)] - of.rest[at(i)]);
            }
            continue;
        }
        if (!hasBefore || !hasAfter || isSevered(before, i) || isSevered(i, after)) continue;
        const bool isHalf = isHeld[at(i)] && isFreeBefore != isFreeAfter;
        BendingElement& fold = add({before, i, after}, {1, -2, 1}, isHalf ? 2 * a : a);
        if (of.isCurved)
            fold.rest[0] =
                glm::length((of.rest[at(before)] - of.rest[at(i)]) + (of.rest[at(after)] - of.rest[at(i)])) / (a * a);
    }
    return elements;
}

}  // namespace taut::mechanics
