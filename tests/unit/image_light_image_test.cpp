// Radiance pictures, written here byte by byte as Ward's description of the format has them ("Real Pixels", Graphics
// Gems II). The meaning of the four bytes comes from there too: m · 2^(e - 136).
#include "taut/image/private/light_image.h"

#include <gtest/gtest.h>

#include "image_support.h"
#include "taut/image/png.h"

namespace taut::image {
namespace {

using core::ErrorKind;
using test::messageOf;
using test::TemporaryFolder;

// Takes bytes above 127 as unsigned.
std::string bytes(std::initializer_list<int> values) {
    std::string text;
    for (const int value : values) text += static_cast<char>(value);
    return text;
}

const std::string head = "#?RADIANCE\n# anything\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=   2.0\n\n";
const std::string size8 = "-Y 2 +X 8\n";

// Eight pixels of 64, 0, 0 … 7 and the exponent 129: a run, a run, values, a run.
const std::string planes = bytes({2, 2, 0, 8, 136, 64, 136, 0, 8, 0, 1, 2, 3, 4, 5, 6, 7, 136, 129});
// Eight pixels: one, itself three times more, and four as they are.
const std::string pixels = bytes({128, 0, 32, 137, 1, 1, 1, 3,  //
                                  0,   0, 0,  0,   9, 9, 9, 0, 255, 255, 255, 255, 10, 20, 30, 128});

LightImage readBack(const std::string& content) {
    const TemporaryFolder folder;
    test::writeText(folder / "a.hdr", content);
    return readLightImage(folder / "a.hdr");
}

std::string messageFor(const std::string& content) {
    const TemporaryFolder folder;
    test::writeText(folder / "a.hdr", content);
    return messageOf(ErrorKind::badContent, [&] { readLightImage(folder / "a.hdr"); });
}

TEST(LightImage, ReadsEachWayToWriteALineOfRadiance) {
    const LightImage picture = readBack(head + size8 + planes + pixels);
    ASSERT_EQ(picture.width, 8);
    ASSERT_EQ(picture.height, 2);
    std::vector<float> expected;  // half of the written value, for the exposure
    for (int i = 0; i < 8; ++i) expected.insert(expected.end(), {0.25F, 0.0F, static_cast<float>(i) / 256.0F});
    for (int i = 0; i < 4; ++i) expected.insert(expected.end(), {128.0F, 0.0F, 32.0F});
    expected.insert(expected.end(), {0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, brightest, brightest, brightest});
    expected.insert(expected.end(), {10.0F / 512.0F, 20.0F / 512.0F, 30.0F / 512.0F});
    EXPECT_EQ(picture.rgb, expected);
}

// Of two repeats after one another the second counts 256 times as much: 1 + 2 + 256 pixels.
TEST(LightImage, RepeatsAfterRepeatsCountMore) {
    const LightImage picture = readBack(head + "-Y 1 +X 259\n" + bytes({128, 0, 0, 129, 1, 1, 1, 2, 1, 1, 1, 1}));
    ASSERT_EQ(picture.rgb.size(), 3U * 259U);
    EXPECT_EQ(picture.rgb[3 * 258], 0.5F);
}

// As programs on other systems write it: lines that end in \r\n, blanks at their ends, a sign.
TEST(LightImage, TakesAHeadWithOtherLineEnds) {
    const LightImage picture =
        readBack("#?RGBE\r\nFORMAT=32-bit_rle_rgbe \r\nEXPOSURE= +2.0\r\n\r\n-Y 2 +X 8\r\n" + planes + pixels);
    EXPECT_EQ(picture.rgb, readBack(head + size8 + planes + pixels).rgb);
}

TEST(LightImage, BytesOfAPngAreLightBySrgb) {
    const TemporaryFolder folder;
    writePng(folder / "a.png", {1, 1, {255, 188, 0}, {}});
    const LightImage picture = readLightImage(folder / "a.png");
    EXPECT_EQ(picture.rgb[0], 1.0F);
    EXPECT_NEAR(picture.rgb[1], 0.5029F, 1e-4F);  // ((188 / 255 + 0.055) / 1.055)^2.4
    EXPECT_EQ(picture.rgb[2], 0.0F);
}

TEST(LightImage, AnyMissingPartOfARadiancePictureIsAnError) {
    const std::string whole = head + size8 + planes + pixels;
    const TemporaryFolder folder;
    for (std::size_t length = 0; length < whole.size(); ++length) {
        test::writeText(folder / "a.hdr", whole.substr(0, length));
        messageOf(
            ErrorKind::badContent, [&] { readLightImage(folder / "a.hdr"); });
        messageOf(ErrorKind::badContent, [&] { lightImageSize(folder / "a.hdr"); });
    }
    test::writeText(folder / "a.hdr", whole);
    EXPECT_EQ(lightImageSize(folder / "a.hdr").width, 8);
}

TEST(LightImage, SaysWhatIsWrongWithARadiancePicture) {
    for (const auto& [content, part] :
         {std::pair<std::string, const char*>{"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n" + size8, "\"32-bit_rle_xyze\""},
          {"#?RGBE\nEXPOSURE=0\n\n" + size8, "EXPOSURE is \"0\""},
          {head + "+Y 2 +X 8\n" + planes + pixels, "its size is \"+Y 2 +X 8\""},
          {head + "-Y 2 +X 80000\n" + planes + pixels, "up to 16384"},
          {head + "-Y 16384 +X 16384\n" + planes + pixels, "up to 33 million"},
          {head + "-Y 1 +X 9\n" + planes, "not as long as"},
          {head + "-Y 1 +X 8\n" + bytes({2, 2, 0, 8, 137, 64}), "a run does not end"},
          {head + "-Y 1 +X 8\n" + bytes({2, 2, 0, 8, 0, 64}), "a run does not end"},
          {head + "-Y 1 +X 2\n" + bytes({1, 1, 1, 2}), "a run does not end"},
          {head + "-Y 1 +X 2\n" + bytes({0, 0, 0, 1, 1, 1, 1, 0}), "a run does not end"},
          {"P6 2 1 255", "neither as Radiance HDR nor as PNG or JPEG"}}) {
        const std::string message = messageFor(content);
        EXPECT_NE(message.find(part), std::string::npos) << message;
        EXPECT_NE(message.find("a.hdr: "), std::string::npos) << message;
    }
}

}  // namespace
}  // namespace taut::image
