// Passes every n-th frame on and measures the loss between them: the error of linear interpolation of vertices.
// Independent of formats.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "taut/geometry/geometry_sink.h"

namespace taut::geometry {

struct LostMotion {
    std::int64_t frames = 0;        // that were left out
    std::int64_t unmeasured = 0;    // of them, where triangles had changed before the next frame that was not left out
    std::set<std::string> changes;  // those: "cloth.flag tears or is cut", "rope.line appears"
    double rms = 0.0;               // [m] over all vertices that moved, in all frames left out
    double worst = 0.0;             // [m]
    std::int64_t worstFrame = 0;
    std::string worstName;  // "cloth.flag"; empty: nothing moved
};

class EveryNth : public GeometrySink {
  public:
    // The frames `first`, first + every, … and `last` go on to the sink, which has to live as long. isWanted as in
    // GeometryOptions. Expects every >= 1.
    EveryNth(GeometrySink& sink, std::int64_t first, std::int64_t last, std::int64_t every,
             std::function<bool(const std::string&)> isWanted);

    void write(const view::FrameView& view) override;
    void finish() override { sink_.finish(); }

    LostMotion lost() const;

  private:
    void measure(const view::FrameView& to);
    void measure(const view::FrameView& at, const view::FrameView& to);

    GeometrySink& sink_;
    std::int64_t first_, last_, every_;
    std::function<bool(const std::string&)> isWanted_;
    view::FrameView from_;                  // the last that went on
    std::vector<view::FrameView> between_;  // since
    LostMotion lost_;
    double sum_ = 0.0;        // of squares [m²]
    std::int64_t count_ = 0;  // number of summands
};

}  // namespace taut::geometry
