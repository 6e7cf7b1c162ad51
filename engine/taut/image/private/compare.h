// Compares two pictures with the tolerance that golden frames have, and shows where they differ.
// It knows nothing of files.
#pragma once

#include <string>

#include "taut/image/image.h"

namespace taut::image {

// Three rules, all of which must hold. Two count pixels. The first tolerates a few pixels where rounding decides the
// visible surface: at edges, where two surfaces touch, in a shadow's rim; the size of such a difference has no meaning,
// because the pixel shows another surface. The second finds a weak change of a large area, which the first would miss.
// A difference of 1 counts in neither: a processor with other approximate reciprocals shifts entire bands of a gradient
// by 1. The third finds a change of nearly every pixel by less than 1, such as 1 % less sun: rounding up and down
// cancels in the mean of a channel, a change of light does not.
//
// The shares are twice the largest noise between processors that `taut test --calibrate` measured on the goldens of
// this repository, rounded up: 0.050 % of a picture and 10.9 % of a tile, between SSE and AVX. Twice, because tens of
// pixels flip and another picture may have somewhat more. The mean of a channel differs by 0.0102 of 255 at most
// between processors, and by at least 0.038 with 1 % less sun. The deliberate errors of the calibration leave room for
// that: the weakest for the first rule changes 1.8 % of a picture, the weakest for the second 70 % of a tile.
struct Tolerance {
    int channel = 2;          // [1/255] a pixel is different when any channel is off by more
    double share = 1.1e-3;    // of all pixels may be different
    int tileChannel = 1;      // [1/255] the same for the second rule
    double tileShare = 0.22;  // of the pixels of any one tile may be different
    double offset = 0.025;    // [1/255] by which the mean of a channel may be off
    bool operator==(const Tolerance&) const = default;
};

// For pictures of another renderer than that of the golden: derivatives, filters and the rounding of every pixel may
// differ. Twice the difference between Mesa's llvmpipe and its softpipe on the goldens of this repository, rounded up:
// 0.97 % of a picture and 26.6 % of a tile differ by more than 12. (Measured with a surface.frag that ignores the back
// of cloth, where softpipe 22.3 is wrong. No graphics card has been measured.) It still finds a camera that is off by a
// pixel and a missing shadow, but not a light that is dimmer by 2 %: rounding of each pixel may shift a mean by 1.
inline constexpr Tolerance betweenRenderers{12, 0.02, 12, 0.54, 1.0};

inline constexpr int tileSize = 16;  // [px]; tiles at the right and lower edge are smaller

struct Comparison {
    bool sameSize = true;
    bool within = true;                  // all rules hold
    double share = 0.0;                  // of pixels that are different
    double worstTileShare = 0.0;         // of the pixels of one tile that are different
    int worstTileX = 0, worstTileY = 0;  // [px] its top left corner
    double offset = 0.0;                 // [1/255] of the mean of that channel that is most off, with its sign
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
