#include <cmath>

#include "taut/geometry/every_nth.h"
#include "unit/geometry_support.h"

namespace taut {
namespace {

class Frames : public geometry::GeometrySink {
  public:
    void write(const view::FrameView& view) override { frames.push_back(view.frame); }
    void finish() override {}
    std::vector<std::int64_t> frames;
};

// A chord over two frames leaves the parabola a k² by a in its middle. One corner of three moves so.
TEST(LostMotion, OfAParabolaIsWhatTheChordLeaves) {
    test::Film film;
    Frames kept;
    geometry::EveryNth every(kept, 0, 7, 2, [](const std::string& name) { return name == "cloth.flag"; });
    for (std::int64_t k = 0; k <= 7; ++k) every.write(film.frame(k, 0.25F * static_cast<float>(k * k)));
    EXPECT_EQ(kept.frames, (std::vector<std::int64_t>{0, 2, 4, 6, 7}));  // the last too
    const geometry::LostMotion lost = every.lost();
    EXPECT_EQ(lost.frames, 3);
    EXPECT_EQ(lost.unmeasured, 0);
    EXPECT_DOUBLE_EQ(lost.worst, 0.25);
    EXPECT_NEAR(lost.rms, 0.25 / std::sqrt(3.0), 1e-12);  // one corner of three
    EXPECT_EQ(lost.worstName, "cloth.flag");
}

}  // namespace
}  // namespace taut
