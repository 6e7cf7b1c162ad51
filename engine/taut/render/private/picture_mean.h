// The mean of pictures, in light as lights add. It knows no GL.
#pragma once

#include <cstdint>
#include <vector>

namespace taut::render {

// A picture as it comes from drawing: rows from below.
struct Drawn {
    std::vector<std::uint32_t> colours;  // (pixels) bytes red, green, blue from the lowest on
    std::vector<std::uint8_t> alpha;     // (pixels) straight; empty: opaque
};

class PictureMean {
  public:
    void add(const Drawn& drawn);  // all of the same size, all with alpha or all without
    Drawn mean() const;            // of at least one

  private:
    int count_ = 0;
    std::vector<float> sums_;   // (pixels × 3) light times coverage
    std::vector<float> cover_;  // (pixels) 0 … 1 of each; empty: opaque
};

}  // namespace taut::render
