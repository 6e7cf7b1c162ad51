#include "taut/pipeline/overlay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "taut/pipeline/energy_graph.h"

namespace taut::pipeline {
namespace {

image::Image grey(int width, int height) {
    return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width * height) * 3, 120)};
}

std::array<int, 3> pixel(const image::Image& image, int x, int y) {
    const auto at =
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) * 3;
    return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

render::TextPainter letters() {
    return render::TextPainter(render::Font({}));
}

// Kinetic energy rises evenly from 0 to 4 J in four seconds; the rest stays.
Moment rising(int tick) {
    Moment moment;
    moment.tick = tick;
    moment.time = tick / 60.0;
    moment.kinetic = moment.time;
    moment.gravitational = 35.0;
    return moment;
}

TEST(EnergyScale, HoldsTheRangeAndZeroWithFewLines) {
    for (const auto& [least, most] : {std::pair{-0.37, 1.18}, {2.0, 5.0}, {-800.0, -3.0}, {0.0, 0.0}, {-1e-5, 4e-5}}) {
        const EnergyScale scale = energyScale(least, most);
        EXPECT_LE(scale.low, std::min(least, 0.0) + 1e-6 * scale.spacing);
        EXPECT_GE(scale.high, std::max(most, 0.0) - 1e-6 * scale.spacing);
        const double lines = (scale.high - scale.low) / scale.spacing;
        EXPECT_NEAR(lines, std::round(lines), 1e-9);  // whole: both ends are lines
        EXPECT_GE(lines, 1.0);
        EXPECT_LE(lines, 5.0);
    }
}

TEST(EnergyScale, ChoosesTheUnitThatReadsShort) {
    EXPECT_STREQ(energyScale(0.0, 3.0).unitName, "J");
    EXPECT_STREQ(energyScale(0.0, 0.03).unitName, "mJ");
    EXPECT_STREQ(energyScale(-2e4, 0.0).unitName, "kJ");
    EXPECT_EQ(numberText(-0.25, 2), "\u22120.25");
    EXPECT_EQ(numberText(-0.001, 2), "0.00");  // nothing is no less than nothing
}

TEST(Painting, ALineCoversItsWidth) {
    image::Image picture = grey(40, 20);
    auto painter = letters();
    Painting painting(picture, painter);
    const std::array ends{glm::vec2(5.0F, 10.5F), glm::vec2(35.0F, 10.5F)};
    painting.line(ends, 1.0F, {255, 0, 0});
    EXPECT_EQ(pixel(picture, 20, 10), (std::array{255, 0, 0}));
    EXPECT_EQ(pixel(picture, 20, 9), (std::array{120, 120, 120}));
    EXPECT_EQ(pixel(picture, 20, 11), (std::array{120, 120, 120}));
    EXPECT_EQ(pixel(picture, 2, 10), (std::array{120, 120, 120}));
}

TEST(Painting, MarksOutsideAreLeftOut) {
    image::Image picture = grey(8, 8);
    const image::Image before = picture;
    auto painter = letters();
    Painting painting(picture, painter);
    const std::array ends{glm::vec2(-50.0F, -3.0F), glm::vec2(90.0F, -3.0F)};
    painting.line(ends, 2.0F, {255, 0, 0});
    painting.plate({{20.0F, 20.0F}, {30.0F, 30.0F}}, 2.0F, {0, 0, 0}, 1.0F);
    painting.text({-400.0F, 4.0F}, Side::left, "far", 12.0F, {});
    EXPECT_EQ(picture.rgb, before.rgb);
}

// The value's letters are the same with and without a name, however long that is.
TEST(Painting, ANameGivesWayToItsValue) {
    image::Image alone = grey(120, 20), both = alone;
    auto painter = letters();
    Painting(alone, painter).pair(5.0F, 115.0F, 14.0F, "", {}, "123456.7 ms", {255, 0, 0}, 11.0F);
    Painting(both, painter)
        .pair(5.0F, 115.0F, 14.0F, "cloth.längster-vorhang", {0, 0, 255}, "123456.7 ms", {255, 0, 0}, 11.0F);
    int named = 0;
    for (int x = 0; x < 120; ++x)
        for (int y = 0; y < 20; ++y)
            if (pixel(alone, x, y) != std::array{120, 120, 120})
                EXPECT_EQ(pixel(both, x, y), pixel(alone, x, y)) << x << " " << y;
            else if (pixel(both, x, y) != std::array{120, 120, 120})
                ++named;
    EXPECT_GT(named, 20);
}

// The curve's own colour is looked for where its energy belongs: a quarter, half and three quarters of the way.
TEST(Overlay, TheCurveRunsThroughItsEnergies) {
    image::Image picture = grey(400, 200);
    auto painter = letters();
    Painting painting(picture, painter);
    std::vector<Moment> moments;
    for (int tick = 0; tick <= 240; ++tick) {
        Moment moment = rising(tick);
        moment.gravitational = 0.0;
        moments.push_back(moment);
    }
    const PictureBox box{{10.0F, 10.0F}, {390.0F, 150.0F}};
    paintEnergies(painting, box, 14.0F, moments, 4.0);
    const EnergyScale scale = energyScale(0.0, 4.0);
    for (const double t : {1.0, 2.0, 3.0}) {
        const glm::vec2 place = placeOf(t, t, 4.0, scale, box);
        // The total lies over the kinetic energy, as nothing else changes.
        const auto [red, green, blue] = pixel(picture, static_cast<int>(place.x), static_cast<int>(place.y));
        EXPECT_GT(red, 200) << t;
        EXPECT_GT(green, 200) << t;
        EXPECT_GT(blue, 200) << t;
    }
    EXPECT_EQ(pixel(picture, 100, 30), (std::array{120, 120, 120}));  // nothing where no energy was
}

TEST(Overlay, StaysInItsPanelAndDependsOnWhatItWasToldOnly) {
    const SmallestStep step{4e-4, 5e-4};
    Overlay once({}, step), ahead({}, step);
    for (int tick = 0; tick <= 300; ++tick) once.add(rising(tick));
    for (int tick = 0; tick <= 330; ++tick) ahead.add(rising(tick));  // the simulation is ahead of the pictures
    image::Image a = grey(640, 360), b = a;
    const image::Image before = a;
    once.paint(a, 5.0);
    ahead.paint(b, 5.0);
    EXPECT_EQ(a.rgb, b.rgb);
    EXPECT_NE(a.rgb, before.rgb);
    for (int y = 0; y < 360; ++y)
        for (int x = 0; x < 640; ++x) {
            if (x < 320 && y < 180) continue;
            ASSERT_EQ(pixel(a, x, y), pixel(before, x, y)) << x << " " << y;
        }
}

// The same values as in metrics.csv: a gravitational energy that stays is shown, not taken for nothing.
TEST(Overlay, EnergiesCountFromTheSameZeroAsTheMetrics) {
    image::Image high = grey(640, 360), low = high;
    for (auto [picture, gravitational] : {std::pair{&high, 35.0}, std::pair{&low, 0.0}}) {
        Overlay overlay({}, {4e-4, 5e-4});
        for (int tick = 0; tick < 3; ++tick) {
            Moment moment = rising(tick);
            moment.gravitational = gravitational;
            overlay.add(moment);
        }
        overlay.paint(*picture, 0.1);
    }
    EXPECT_NE(high.rgb, low.rgb);
}

TEST(Overlay, LeavesMostOfASmallPictureFree) {
    image::Image picture = grey(320, 180);
    Overlay overlay({}, {4e-4, 5e-4});
    overlay.add(rising(100));
    overlay.paint(picture, 5.0);
    int covered = 0;
    for (int y = 0; y < 180; ++y)
        for (int x = 0; x < 320; ++x) covered += pixel(picture, x, y) == std::array{120, 120, 120} ? 0 : 1;
    EXPECT_LT(covered, 320 * 180 / 4);
    EXPECT_EQ(pixel(picture, 319, 100), (std::array{120, 120, 120}));
    EXPECT_EQ(pixel(picture, 10, 100), (std::array{120, 120, 120}));
}

// A panel as wide as its longest line; where the picture is narrower the name is cut.
TEST(Overlay, APanelIsAsWideAsItsLines) {
    const std::string name = "a body of a very long name that goes on for a while";
    const std::vector<OverlayLine> above = {{name, "12345.678 m/s"}};
    const auto rightEdge = [&](int width, std::span<const OverlayLine> lines) {
        image::Image picture = grey(width, 360);
        Overlay overlay({}, {4e-4, 5e-4});
        overlay.add(rising(100));
        overlay.paint(picture, 5.0, lines);
        int edge = 0;
        for (int x = 0; x < width; ++x)
            if (pixel(picture, x, 50) != std::array{120, 120, 120}) edge = x;
        return edge;
    };
    EXPECT_LT(rightEdge(640, {}), 230);
    EXPECT_GT(rightEdge(640, above), 350);
    EXPECT_LT(rightEdge(320, above), 315);
}

// The same panel moved, for plates and lines do not know where they are; half seen, each byte is between.
TEST(Overlay, LooksTheSameAtTheRightAndShinesThroughEvenly) {
    Overlay overlay({}, {4e-4, 5e-4});
    overlay.add(rising(100));
    image::Image left = grey(640, 360), right = left, half = left;
    const PictureBox at = overlay.paint(left, 5.0), other = overlay.paint(right, 5.0, {}, {.isAtRight = true});
    overlay.paint(half, 5.0, {}, {.opacity = 0.5F});
    EXPECT_EQ(other.high - other.low, at.high - at.low);
    EXPECT_NEAR(640.0F - other.high.x, at.low.x, 1.0F);  // whole pixels
    const int shift = static_cast<int>(other.low.x - at.low.x);
    for (int y = 0; y < 360; ++y)
        for (int x = 0; x < 640 - shift; ++x) {
            ASSERT_EQ(pixel(right, x + shift, y), pixel(left, x, y)) << x << " " << y;
            for (const std::size_t c : {0U, 1U, 2U})
                ASSERT_NEAR(pixel(half, x, y)[c], 0.5 * (120 + pixel(left, x, y)[c]), 0.51);  // rounding
        }
}

TEST(Overlay, TypeGrowsWithTheDensityOfTheScreen) {
    EXPECT_EQ(typeSize(576, 2.0F), 2.0F * typeSize(288));
}

TEST(Overlay, NothingIsPaintedBeforeTheFirstMoment) {
    Overlay overlay({}, {4e-4, 5e-4});
    image::Image picture = grey(64, 64);
    const image::Image before = picture;
    overlay.paint(picture, 1.0);
    EXPECT_EQ(picture.rgb, before.rgb);
}

}  // namespace
}  // namespace taut::pipeline
