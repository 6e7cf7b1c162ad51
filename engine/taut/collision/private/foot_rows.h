// Cached feet of the points of a block on triangles (foot_finder.h): for each point an earlier place, and the radius
// around it in which the result is valid. It saves searches and changes no result: a valid result is the one of a
// search. Plain data, because the kernels read it.
#pragma once

#include <cstddef>

#include "taut/collision/private/contact_kernel.h"

namespace taut::collision {

struct FootRows {
    alignas(64) double anchor[3][contactBatch] = {};       // [m] in the frame of the triangles
    alignas(64) double clear[contactBatch] = {};           // [m] the surface is at least this far from the anchor
    alignas(64) double radius[contactBatch] = {};          // [m] so near to the anchor feet are inside of `triangle`
    alignas(64) std::int64_t triangle[contactBatch] = {};  //
    double fewRadius[contactBatch] = {};                   // [m] so near to the anchor feet are on one of `few`
    int few[contactBatch][4] = {};                         //
    std::size_t fewCount[contactBatch] = {};               //
    const FootFinder* finder[contactBatch] = {};           // whose triangles they are; nullptr: nothing is known
};

// Finds the missing feet of the points of a batch, and caches them.
void findFeet(const FeetArgs& args, double thickness, int n, ContactLanes& lanes);

}  // namespace taut::collision
