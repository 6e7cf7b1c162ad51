#include "taut/report/contact_sheet.h"

#include <gtest/gtest.h>

#include <numeric>

#include "image_support.h"
#include "program_support.h"
#include "taut/image/png.h"
#include "taut/image/private/resize.h"

namespace taut::report {
namespace {

using test::TemporaryFolder;

image::Image plain(int width, int height, std::uint8_t level) {
    return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width * height * 3), level)};
}

TEST(ContactSheet, ChoosesFirstAndLastAndSpacesTheRestEvenly) {
    std::vector<std::int64_t> numbers(31);
    std::iota(numbers.begin(), numbers.end(), 100);
    EXPECT_EQ(evenlySpaced(numbers, 4), (std::vector<std::int64_t>{100, 110, 120, 130}));
    EXPECT_EQ(evenlySpaced(numbers, 1), (std::vector<std::int64_t>{100}));
    EXPECT_EQ(evenlySpaced(numbers, 99), numbers);
    EXPECT_TRUE(evenlySpaced({}, 3).empty());
}

// 40 pixels: two columns of 16 with gaps of 2, 17 left over by rounding down; pictures 8 x 4 become 17 x 8.
TEST(ContactSheet, PutsFramesRowByRow) {
    const TemporaryFolder folder;
    const image::FramePattern pattern(folder / "f_###.png");
    for (int i = 0; i < 3; ++i)
        image::writePng(pattern.pathOf(10 * i), plain(8, 4, static_cast<std::uint8_t>(60 * (i + 1))));
    test::writeText(folder / "f_xxx.png", "not a frame");
    const image::Image sheet = contactSheet(pattern, {.pictures = 9, .columns = 2, .width = 40, .gap = 2});
    EXPECT_EQ(sheet.width, 40);
    EXPECT_EQ(sheet.height, 2 * (8 + 2) + 2);
    const auto level = [&](int x, int y) { return sheet.rgb[(y * sheet.width + x) * 3]; };
    EXPECT_EQ(level(0, 0), 24);
    EXPECT_EQ(level(10, 5), 60);
    EXPECT_EQ(level(30, 5), 120);
    EXPECT_EQ(level(10, 15), 180);
    EXPECT_EQ(level(30, 15), 24);
}

// Black and white pixels in turn are half the light of white: 188 on the sRGB curve (IEC 61966-2-1), not 128.
TEST(Resize, AveragesLight) {
    image::Image board = plain(64, 64, 0);
    for (int y = 0; y < 64; ++y)
        for (int x = y % 2; x < 64; x += 2)
            for (int c = 0; c < 3; ++c) board.rgb[(y * 64 + x) * 3 + c] = 255;
    const image::Image small = image::resized(board, 8, 8);
    EXPECT_NEAR(small.rgb[(4 * 8 + 4) * 3], 188, 3);  // ripple of the cubic filter
}

TEST(SheetCommand, WritesASheetAndExplainsWhatIsMissing) {
    const TemporaryFolder folder;
    const test::Outcome none = test::run({"sheet", folder.path().string()});
    EXPECT_EQ(none.code, 6);
    EXPECT_TRUE(test::has(none.err, "frame_000000.png")) << none.err;
    for (int i = 0; i < 5; ++i)
        image::writePng(image::FramePattern(folder.path()).pathOf(i), test::testPicture(32, 18));
    const test::Outcome made = test::run({"sheet", folder.path().string(), "--pictures", "4", "--width", "200"});
    EXPECT_EQ(made.code, 0) << made.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "sheet.png"));
    EXPECT_EQ(test::run({"sheet", folder.path().string(), "-o", "sheet.jpg"}).code, 2);
    const test::Outcome narrow = test::run({"sheet", folder.path().string(), "--columns", "5", "--width", "64"});
    EXPECT_EQ(narrow.code, 3);
    EXPECT_TRUE(test::has(narrow.err, "5 columns do not fit into 64 pixels")) << narrow.err;
    image::writePng(folder / "frame_000002.png", test::testPicture(16, 9));
    const test::Outcome mixed = test::run({"sheet", folder.path().string()});
    EXPECT_EQ(mixed.code, 3);
    EXPECT_TRUE(test::has(mixed.err, "frame_000002.png: 16x9 pixels, but the first frame has 32x18")) << mixed.err;
}

}  // namespace
}  // namespace taut::report
