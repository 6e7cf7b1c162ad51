// Frames of a run side by side in one picture. It knows pictures, not how they came about.
#pragma once

#include <cstdint>
#include <vector>

#include "taut/image/frame_sequence.h"
#include "taut/image/image.h"

namespace taut::report {

struct SheetLayout {
    int pictures = 12;  // at most
    int columns = 4;
    int width = 1600;  // of the sheet [pixels]
    int gap = 6;       // between pictures and around them [pixels]
};

// `count` of the numbers, evenly spaced, with the first and the last; all of them when there are no more.
std::vector<std::int64_t> evenlySpaced(const std::vector<std::int64_t>& numbers, int count);

// Evenly spaced frames of a sequence, row by row. Pictures keep their shape. Throws core::Error: inputOutput when there
// are none, badContent when a file is no picture, differs in size from the first, or the layout leaves no room.
image::Image contactSheet(const image::FramePattern& pattern, const SheetLayout& layout);

}  // namespace taut::report
