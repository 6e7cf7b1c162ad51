// Compares two pictures with the tolerance that golden frames have, and shows where they differ.
// It knows nothing of files.
#pragma once

#include <string>

#include "taut/image/image.h"

namespace taut::image {

// Two rules, both of which must hold. The first lets a few pixels flip at edges, where rounding decides about
// coverage; the second finds a weak change of a whole area, which the first would let pass.
struct Tolerance {
    int channel = 2;         // [1/255] a pixel counts as different when any channel is off by more
    double share = 1e-4;     // of all pixels may be different
    double tileMean = 0.25;  // [1/255] mean difference of the worst tile, over its pixels and channels
};

inline constexpr int tileSize = 16;  // [px]

struct Comparison {
    bool sameSize = true;
    bool within = true;                  // both rules hold
    double share = 0.0;                  // of pixels that are different
    double worstTileMean = 0.0;          // [1/255]
    int worstTileX = 0, worstTileY = 0;  // [px] its top left corner
    int largest = 0;                     // [1/255] largest difference of a channel
    double mean = 0.0;                   // [1/255] over all pixels and channels
};

// Expects whole images. With different sizes only sameSize and within are filled.
Comparison compare(const Image& a, const Image& b, const Tolerance& tolerance = {});

// The figures in one line, for a person.
std::string describe(const Comparison& comparison, const Tolerance& tolerance = {});

// |a - b| times 16, cut off at white; expects whole images of the same size.
Image differencePicture(const Image& a, const Image& b);

}  // namespace taut::image
