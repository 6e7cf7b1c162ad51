// The values of one attribute of a USD prim over the frames, as text: one value where it never changes, else time
// samples. It knows no prim.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "taut/geometry/private/scratch_file.h"

namespace taut::geometry {

// Text on its way to a file, in large pieces.
class UsdaText {
  public:
    UsdaText(core::WholeFile& file, ScratchFile& scratch) : file_(file), scratch_(scratch) {}

    void add(std::string_view text);
    void add(ScratchFile::Piece piece);
    void flush();

  private:
    core::WholeFile& file_;
    ScratchFile& scratch_;
    std::string text_;
};

class UsdaSamples {
  public:
    // Values between two samples are interpolated, where isHeld they are those of the sample before.
    explicit UsdaSamples(bool isHeld = false) : isHeld_(isHeld) {}

    // At frame: the same as before, or a new value. Frames ascend; the first has a value.
    void keep(std::int64_t frame) { now_ = frame; }
    void set(std::int64_t frame, std::string_view value, ScratchFile& scratch);
    // Compares first: for short values.
    void update(std::int64_t frame, std::string_view value, ScratchFile& scratch);

    bool isEmpty() const { return samples_.empty(); }

    // Of a prim in `depth` others: `declaration` is "point3f[] points", `metadata` e.g. interpolation = "vertex" or
    // empty. It never stands on a line with time samples, where some readers do not look for it.
    void write(UsdaText& to, int depth, std::string_view declaration, std::string_view metadata = {}) const;

  private:
    struct Sample {
        std::int64_t frame;
        std::string text;            // a short one
        ScratchFile::Piece piece{};  // a long one
    };
    void put(UsdaText& to, const Sample& sample) const;

    bool isHeld_;
    std::int64_t now_ = 0;
    std::vector<Sample> samples_;
};

}  // namespace taut::geometry
