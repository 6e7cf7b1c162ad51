// Parts of a target such as "cloth.flag@top-left": bodies, and points of them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "taut/core/glob.h"
#include "taut/mechanics/model.h"

namespace taut::world {

struct Target {
    std::string kind;      // "cloth"
    std::string name;      // "flag"; may contain the wildcard *
    std::string selector;  // "top-left"; empty: all points
};

// Splits KIND.NAME@SELECTOR. Parts may be empty if the text is malformed; the loader has checked it.
Target parseTarget(std::string_view text);

// A collider or, of a figure, a part that can carry points: a joint (collider.hero.Hand, collider.hero."Right hand") or
// the face of a number (collider.hero#12), as hold_on makes it of collider.hero.
struct ColliderTarget {
    std::string collider;  // "collider.hero"
    std::string joint;     // empty: none
    int face = -1;         // -1: none
};
ColliderTarget parseCollider(std::string_view text);

// KIND.NAME of it.
std::string_view withoutSelector(std::string_view target);

using core::matches;

// A place on a cloth grid, as a selector says it: "(u,v)" or "(u,v,r)".
struct GridPlace {
    double u, v;        // 0 … 1, of width and height, from the top left
    double radius = 0;  // [m]
};
// None if the selector is no such place.
std::optional<GridPlace> gridPlace(std::string_view selector);
std::optional<double> ropePlace(std::string_view selector);    // "50%": 0.5
std::optional<double> pointNumber(std::string_view selector);  // "#12": 12; not negative, but may be too large

// The groups that have the points of "front-top-left" in common; of a compound's part its own, "part0-front-top". Empty
// if it has not all of them.
std::vector<std::string> commonGroups(std::string_view selector,
                                      const std::function<bool(const std::string&)>& isGroup);

// The points of a selector, ascending, or of a group in its own order: a group of the model ("left", "corners", "all"
// …), "#12" (by index), "(u,v)" (the grid point nearest to that fraction of width and height, from the top left),
// "(u,v,r)" (besides all within r [m] of that place of the flat cloth), "50%" (along a rope), or the points that
// several groups have in common, "front-top-left". Empty if it names none.
std::vector<int> selectPoints(const mechanics::Model& model, std::string_view selector);

}  // namespace taut::world
