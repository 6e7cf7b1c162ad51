#include "taut/live/pace.h"

#include <gtest/gtest.h>

#include "taut/live/between.h"

namespace taut::live {
namespace {

TEST(Pace, TicksAddUpToTheTimeThatPassed) {
    Pace pace(1.0 / 60.0);
    int ticks = 0;
    for (int i = 0; i < 250; ++i) ticks += pace.due(0.04, 1.0, 8);  // 25 pictures a second for ten seconds
    EXPECT_NEAR(ticks + pace.share(), 600.0, 1e-6);                 // rounding of 250 sums
}

TEST(Pace, SlowMotionIsThatManyTimesSlower) {
    Pace pace(1.0 / 60.0);
    int ticks = 0;
    for (int i = 0; i < 250; ++i) ticks += pace.due(0.04, 0.25, 8);
    EXPECT_NEAR(ticks + pace.share(), 150.0, 1e-6);
}

TEST(Pace, AStallIsForgottenInsteadOfCaughtUp) {
    Pace pace(1.0 / 60.0);
    EXPECT_EQ(pace.due(10.0, 1.0, 8), 8);
    EXPECT_EQ(pace.due(0.0, 1.0, 8), 0);
    EXPECT_LT(pace.share(), 1.0);
}

TEST(Pace, AFewTicksThatWereNotDoneAreDueOnceMore) {
    Pace pace(0.01);
    EXPECT_EQ(pace.due(0.035, 1.0, 8), 3);
    pace.owe(2);
    EXPECT_EQ(pace.due(0.016, 1.0, 8), 4);  // two of its own
    EXPECT_EQ(pace.due(0.01, 1.0, 8), 1);
    pace.owe(100);
    EXPECT_LT(pace.due(0.0, 1.0, 8), 8);
}

view::FrameView withTriangle(float x) {
    view::Geometry geometry;
    geometry.positions = {{x, 0.0F, 0.0F}, {x + 1.0F, 0.0F, 0.0F}, {x, 1.0F, 0.0F}};
    geometry.normals.assign(3, {0.0F, 0.0F, 1.0F});
    view::Surface surface;
    surface.name = "cloth.flag";
    surface.geometry = std::make_shared<const view::Geometry>(std::move(geometry));
    surface.transform[3].x = 2.0F * x;
    view::FrameView view;
    view.time = x;
    view.surfaces.push_back(std::move(surface));
    return view;
}

TEST(Between, MovesEvenlyFromOneTickToTheNext) {
    const view::FrameView before = withTriangle(0.0F), now = withTriangle(1.0F);
    const view::FrameView middle = between(before, now, 0.25);
    EXPECT_DOUBLE_EQ(middle.time, 0.25);
    EXPECT_FLOAT_EQ(middle.surfaces[0].geometry->positions[1].x, 1.25F);
    EXPECT_FLOAT_EQ(middle.surfaces[0].transform[3].x, 0.5F);
    EXPECT_FLOAT_EQ(middle.surfaces[0].transform[0].x, 1.0F);
    EXPECT_EQ(between(before, now, 1.0).surfaces[0].geometry, now.surfaces[0].geometry);
}

TEST(Between, NewPartsAreShownAsTheyAre) {
    const view::FrameView before, now = withTriangle(1.0F);
    EXPECT_EQ(between(before, now, 0.5).surfaces[0].geometry, now.surfaces[0].geometry);
}

}  // namespace
}  // namespace taut::live
