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

// A spawned or torn body has no way from one kept frame to the next.
TEST(LostMotion, OfWhatChangesItsTrianglesIsNotMeasuredButNamed) {
    test::Film film;
    Frames kept;
    geometry::EveryNth every(kept, 0, 4, 2, nullptr);
    for (std::int64_t k = 0; k <= 4; ++k) {
        view::FrameView view = film.frame(k, 0.0F);
        view::Surface late = view.surfaces[1];
        late.name = "cloth.late";
        if (k >= 1) view.surfaces.push_back(late);
        if (k == 3) {
            auto torn = std::make_shared<view::Topology>(*view.surfaces[1].topology);
            torn->triangles.clear();
            view.surfaces[1].topology = torn;
        }
        every.write(view);
    }
    const geometry::LostMotion lost = every.lost();
    EXPECT_EQ(lost.frames, 2);
    EXPECT_EQ(lost.unmeasured, 2);
    EXPECT_EQ(lost.changes, (std::set<std::string>{"cloth.flag tears or is cut", "cloth.late appears"}));
}

}  // namespace
}  // namespace taut
