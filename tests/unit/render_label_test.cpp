// Text in pictures: where it stands, that it can be read on anything, and the behaviour without a font.
#include <gtest/gtest.h>

#include <optional>

#include <fstream>
#include <limits>

#include "taut/core/error.h"
#include "taut/render/private/label_pass.h"
#include "taut/render/private/text_picture.h"
#include "unit/image_support.h"
#include "unit/render_support.h"

namespace taut::render {
namespace {

using namespace render::test;

// A picture of one colour.
image::Image sheet(int width, int height, std::uint8_t grey) {
    image::Image picture{width, height, {}};
    picture.rgb.assign(3 * width * height, grey);
    return picture;
}

view::Label labelOf(const std::string& text, glm::vec2 screen = {0.5F, 0.5F}) {
    view::Label label;
    label.text = text;
    label.screen = screen;
    label.size = 0.1F;
    return label;
}

image::Image withLabel(image::Image picture, const view::Label& label, const view::Camera& camera = {}) {
    view::FrameView view;
    view.labels = {label};
    const glm::mat4 projection =
        glm::perspective(camera.fieldOfView, static_cast<float>(picture.width) / static_cast<float>(picture.height),
                         camera.nearPlane, camera.farPlane) *
        glm::lookAt(camera.eye, camera.target, camera.up);
    LabelPass("").draw(view, projection, picture);
    return picture;
}

struct Box {
    int left = std::numeric_limits<int>::max(), top = left, right = -1, bottom = -1;  // included
    int count = 0;
};

// The pixels that differ from the colour of the sheet.
Box inkOf(const image::Image& picture, int grey) {
    Box box;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const Pixel pixel = pixelAt(picture, x, y);
            if (pixel == Pixel{grey, grey, grey}) continue;
            ++box.count;
            box.left = std::min(box.left, x);
            box.right = std::max(box.right, x);
            box.top = std::min(box.top, y);
            box.bottom = std::max(box.bottom, y);
        }
    return box;
}

constexpr int rim = 3;  // [px] at a type of 20: its reach of a tenth, and a pixel for rounding

// DejaVu Sans: capitals are 0.729 of the size high (its OS/2 table), an H stands on the base line.
TEST(Label, StandsOnItsBaseLineInTheMiddleOfItsPlace) {
    const Box ink = inkOf(withLabel(sheet(320, 200, 128), labelOf("HOH")), 128);
    ASSERT_GT(ink.count, 100);
    EXPECT_NEAR(ink.bottom, 100 - 1, rim);
    EXPECT_NEAR(ink.top, 100 - 0.729 * 20, rim);
    EXPECT_NEAR(0.5 * (ink.left + ink.right), 159.5, 1.0);  // the pen is rounded to pixels
}

TEST(Label, HangsOnTheSideThatWasAsked) {
    view::Label label = labelOf("HOH");
    label.align = view::Align::left;
    EXPECT_NEAR(inkOf(withLabel(sheet(320, 200, 128), label), 128).left, 160, rim + 2);  // and the letter's own bearing
    label.align = view::Align::right;
    EXPECT_NEAR(inkOf(withLabel(sheet(320, 200, 128), label), 128).right, 159, rim + 2);
}

TEST(Label, StandsWhereItsPlaceIsSeen) {
    view::Camera camera;
    camera.eye = {0.0F, 1.0F, 5.0F};
    camera.target = {0.0F, 1.0F, 0.0F};
    view::Label label = labelOf("o");
    label.at = glm::vec3(1.0F, 1.5F, 0.0F);
    const Box ink = inkOf(withLabel(sheet(320, 200, 128), label, camera), 128);
    // Half the picture's height is seen at 5 m under half the field of view.
    const double scale = 100.0 / (5.0 * std::tan(0.5 * static_cast<double>(camera.fieldOfView)));
    EXPECT_NEAR(0.5 * (ink.left + ink.right), 160.0 + 1.0 * scale, 2.0);
    EXPECT_NEAR(ink.bottom, 100.0 - 0.5 * scale, rim + 1.0);
    label.shift = {0.0F, -0.1F};
    EXPECT_NEAR(inkOf(withLabel(sheet(320, 200, 128), label, camera), 128).bottom, ink.bottom - 20, 1);
}

TEST(Label, NothingIsDrawnForNoTextOrBlanks) {
    for (const char* text : {"", " ", "   "})
        EXPECT_EQ(inkOf(withLabel(sheet(64, 64, 90), labelOf(text)), 90).count, 0) << '"' << text << '"';
}

// Letters are lighter than half grey on black, the rim darker than it on white: either way the two are far apart.
TEST(Label, WhiteLettersAreSeenOnBlackAndOnWhite) {
    for (const int grey : {0, 255}) {
        const image::Image picture = withLabel(sheet(320, 200, static_cast<std::uint8_t>(grey)), labelOf("HOH"));
        int darkest = 765, lightest = 0;
        for (int y = 85; y < 105; ++y)
            for (int x = 130; x < 190; ++x) {
                darkest = std::min(darkest, brightness(pixelAt(picture, x, y)));
                lightest = std::max(lightest, brightness(pixelAt(picture, x, y)));
            }
        EXPECT_GT(lightest - darkest, 300) << grey;
    }
}

// Light adds, not bytes: half a pixel of white over black is 188, not 128.
TEST(Label, CoverageIsBlendedAsLight) {
    TextPainter painter{Font("")};
    const TextPicture text = painter.picture("S", 20.0F);
    view::Label label = labelOf("S");
    label.align = view::Align::left;
    const image::Image picture = withLabel(sheet(200, 200, 0), label);
    int seen = 0;
    for (int y = 0; y < text.height; ++y)
        for (int x = 0; x < text.width; ++x) {
            const auto i = static_cast<std::size_t>(y * text.width + x);
            const float part = static_cast<float>(text.letters[i]) / 255.0F;
            if (text.letters[i] == 0) continue;
            const int byte = pixelAt(picture, 100 + text.left + x, 100 + text.top + y)[1];
            // The rim below the letter adds at most its own light, 0.006 of white, and a byte is rounded.
            EXPECT_GE(static_cast<float>(byte), srgb(part) - 1.0F);
            EXPECT_LE(static_cast<float>(byte), srgb(part + 0.006F * (1.0F - part)) + 1.0F);
            if (part > 0.2F && part < 0.8F) ++seen;
        }
    EXPECT_GT(seen, 10);  // of the half covered pixels that make the test
}

TEST(Label, APlateDarkensWhatIsBehindTheText) {
    view::Label label = labelOf("i i");
    const image::Image without = withLabel(sheet(320, 200, 200), label);
    label.plate = 0.5F;
    const image::Image with = withLabel(sheet(320, 200, 200), label);
    EXPECT_EQ(pixelAt(without, 160 + 20, 100 - 8)[0], 200);
    EXPECT_LT(pixelAt(with, 160, 100 - 8)[0], 170);
    EXPECT_EQ(pixelAt(with, 10, 10)[0], 200);
}

TEST(Label, PlacesThatCannotBeSeenDrawNothingAndDoNoHarm) {
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    constexpr float far = std::numeric_limits<float>::infinity();
    for (const glm::vec3 at : {glm::vec3(0, 1, 50), glm::vec3(0, 1.5, 5), glm::vec3(none), glm::vec3(far, 0, 0),
                               glm::vec3(1e30F, 0, -1), glm::vec3(300, 0, 0)}) {
        view::Label label = labelOf("text");
        label.at = at;
        label.plate = 1.0F;
        EXPECT_EQ(inkOf(withLabel(sheet(64, 64, 90), label), 90).count, 0) << at.x << ' ' << at.z;
    }
    for (const glm::vec2 screen : {glm::vec2(-5, 0.5), glm::vec2(0.5, 9), glm::vec2(none), glm::vec2(far)})
        EXPECT_EQ(inkOf(withLabel(sheet(64, 64, 90), labelOf("text", screen)), 90).count, 0) << screen.x;
}

TEST(Label, ATextThatLeavesThePictureIsCutOff) {
    for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0.05), glm::vec2(0, 1), glm::vec2(1, 1)}) {
        view::Label label = labelOf(std::string(300, 'W'), corner);
        label.plate = 0.5F;
        EXPECT_GT(inkOf(withLabel(sheet(64, 64, 90), label), 90).count, 10);
    }
}

TEST(Label, EveryGlDrawsTheSame) {
    view::FrameView view;
    view.labels = {labelOf("ω h = 0.34")};
    RendererOptions options = smallOptions();
    const image::Image first = pictureOf(view, options);
    options.backend = Backend::egl;
    EXPECT_EQ(first.rgb, pictureOf(view, options).rgb);
    view.labels.clear();
    EXPECT_NE(first.rgb, pictureOf(view, options).rgb);
}

TEST(Text, LettersOfOtherAlphabetsAreLettersOfTheirOwn) {
    TextPainter painter{Font("")};
    std::vector<std::vector<std::uint8_t>> seen;
    for (const char* letter : {"e", "é", "ζ", "ω", "–", "\U0010FFFD"}) {
        seen.push_back(painter.picture(letter, 40.0F).letters);
        EXPECT_FALSE(seen.back().empty()) << letter;
    }
    for (std::size_t i = 0; i < seen.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) EXPECT_NE(seen[i], seen[j]) << i << ' ' << j;
}

TEST(Text, CharactersThatTheFontLacksAreBoxes) {
    const Font font("");
    EXPECT_EQ(font.glyphOf(U'\U0010FFFD'), 0);
    TextPainter painter{Font("")};
    const TextPicture box = painter.picture("\U0010FFFD", 20.0F);
    EXPECT_EQ(box.letters, painter.picture("\U0010FFFC", 20.0F).letters);
    EXPECT_GT(std::count_if(box.letters.begin(), box.letters.end(), [](int ink) { return ink > 128; }), 20);
}

// Unicode 15, table 3-7, well-formed sequences. Each byte that is not becomes one replacement character.
TEST(Text, Utf8IsReadAndFaultyBytesAreReplaced) {
    EXPECT_EQ(charactersOf("aé€\U0001F600"), U"aé€\U0001F600");
    EXPECT_EQ(charactersOf("a\xC3"), U"a\uFFFD");
    EXPECT_EQ(charactersOf("\xC3z"), U"\uFFFDz");
    EXPECT_EQ(charactersOf("\xFF\x80"), U"\uFFFD\uFFFD");
    EXPECT_EQ(charactersOf("\xC0\xAF"), U"\uFFFD\uFFFD");
    EXPECT_EQ(charactersOf(""), U"");
}

TEST(Text, PairsAreKerned) {
    TextPainter painter{Font("")};
    const auto advance = [&](const char* text) { return painter.picture(text, 100.0F).advance; };
    EXPECT_LT(advance("AV"), advance("A") + advance("V") - 1.0F);
    EXPECT_NEAR(advance("HH"), 2.0F * advance("H"), 1e-3F);
}

TEST(Text, KeptLettersAreTheSameAsNewOnes) {
    TextPainter kept{Font("")};
    kept.picture("some other text, 0123456789", 23.0F);
    TextPainter fresh{Font("")};
    EXPECT_EQ(kept.picture("text 12", 23.0F).letters, fresh.picture("text 12", 23.0F).letters);
}

std::optional<core::ErrorKind> codeOf(const std::filesystem::path& file, std::string& message) {
    try {
        const Font font(file);
    } catch (const core::Error& error) {
        message = error.what();
        return error.kind();
    }
    return std::nullopt;
}

TEST(Font, OneThatIsNotThereNamesThePackage) {
    std::string message;
    EXPECT_EQ(codeOf("/nowhere/at all.ttf", message), core::ErrorKind::inputOutput);
    for (const char* word : {"/nowhere/at all.ttf", "fonts-dejavu-core", "TAUT_FONT"})
        EXPECT_NE(message.find(word), std::string::npos) << message;
}

TEST(Font, AFileThatIsNoneIsRefused) {
    const taut::test::TemporaryFolder folder;
    std::string message;
    for (const std::string& text : {std::string(), std::string("OTTO"), std::string(4000, 'x')}) {
        taut::test::writeText(folder / "f.ttf", text);
        EXPECT_EQ(codeOf(folder / "f.ttf", message), core::ErrorKind::badContent) << text.size();
    }
    EXPECT_EQ(codeOf(folder.path(), message), core::ErrorKind::inputOutput);
}

TEST(Font, OnlyAViewWithTextNeedsOne) {
    RendererOptions options = smallOptions();
    options.font = "/nowhere.ttf";
    Renderer renderer(options);
    view::FrameView view;
    EXPECT_NO_THROW(renderer.draw(view));
    view.labels = {labelOf("")};
    EXPECT_NO_THROW(renderer.draw(view));
    view.labels = {labelOf("a")};
    EXPECT_THROW(renderer.draw(view), core::Error);
}

TEST(Surface, ADulledOneTurnsRedAndAGreyedOneGrey) {
    view::FrameView view;
    view.camera.eye = {0.0F, 0.0F, 3.0F};
    view.camera.target = {0.0F, 0.0F, 0.0F};
    view.light.direction = {0.0F, 0.0F, -1.0F};
    view.surfaces = {surface(view::sphereMesh(0.5F), {0, 0, 0}, {0.1F, 0.5F, 0.2F})};
    const Pixel before = pixelOf(pictureOf(view), view.camera, {0, 0, 0.5F});
    EXPECT_GT(before[1], before[0]);
    view.surfaces[0].dulled = 1.0F;
    const Pixel after = pixelOf(pictureOf(view), view.camera, {0, 0, 0.5F});
    EXPECT_GT(after[0], 2 * after[1]);
    view.surfaces[0].dulled = 0.0F;
    view.surfaces[0].greyed = 1.0F;
    const Pixel grey = pixelOf(pictureOf(view), view.camera, {0, 0, 0.5F});
    EXPECT_NEAR(grey[0], grey[1], 12);  // of 255: the light of sky and ground has a colour
}

}  // namespace
}  // namespace taut::render
