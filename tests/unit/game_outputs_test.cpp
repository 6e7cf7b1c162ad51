#include "game/outputs.h"
#include "game/render_flags.h"

#include <gtest/gtest.h>

#include "game/scene_file.h"
#include "image_support.h"
#include "taut/bodies/block.h"
#include "taut/image/frame_sequence.h"
#include "taut/image/private/video_writer.h"

namespace taut::game {
namespace {

using core::ErrorKind;
using test::messageOf;
using test::TemporaryFolder;

// The tests have no terminal to ask on, or must not ask: standard input is replaced by an empty file.
class WithoutTerminal {
  public:
    WithoutTerminal() : kept_(::dup(STDIN_FILENO)) {
        if (std::freopen("/dev/null", "r", stdin) == nullptr) throw std::runtime_error("no /dev/null");
    }
    ~WithoutTerminal() {
        ::dup2(kept_, STDIN_FILENO);
        ::close(kept_);
    }

  private:
    int kept_;
};

TEST(Outputs, ExistingFrameInTheRangeIsNotOverwrittenUnasked) {
    const WithoutTerminal noTerminal;
    const TemporaryFolder folder;
    const std::vector pattern{image::FramePattern(folder / "f_##.png")};
    test::writeText(folder / "f_05.png", "old");
    const std::string message =
        messageOf(ErrorKind::inputOutput, [&] { permitOverwriting(pattern, 0, 9, Overwrite::ask); });
    EXPECT_NE(message.find("f_05.png exists already; -y overwrites it"), std::string::npos) << message;
    messageOf(ErrorKind::inputOutput, [&] { permitOverwriting(pattern, 5, 5, Overwrite::no); });
    EXPECT_NO_THROW(permitOverwriting(pattern, 0, 9, Overwrite::yes));
    EXPECT_NO_THROW(permitOverwriting(pattern, 6, 9, Overwrite::no));
    EXPECT_NO_THROW(permitOverwriting({image::FramePattern(folder / "new")}, 0, 9, Overwrite::no));
}

// The folder is listed once: a lookup for each of these would take days.
TEST(Outputs, VeryManyPicturesAreSaidAndLookedForAtOnce) {
    const TemporaryFolder folder;
    test::writeText(folder / "frame_000007.png", "");
    const std::vector frames{image::FramePattern(folder.path())};
    permitOverwriting(frames, 8, std::int64_t{1} << 40U, Overwrite::no);
    messageOf(ErrorKind::inputOutput, [&] { permitOverwriting(frames, 7, std::int64_t{1} << 40U, Overwrite::no); });
    EXPECT_EQ(largeRunText(1000, 640, 360), "");
    EXPECT_EQ(largeRunText(360000, 1000, 1000),
              "360000 pictures of 1000 x 1000 pixels: about 180 GB of PNG files, and 1 hours at 100 pictures a second");
}

TEST(Outputs, CollidersAndBlocksThatTakeLongToPrepareAreSaid) {
    const auto meshOf = [](std::size_t triangles) {
        world::MeshData data;
        data.triangles.resize(triangles);
        world::ColliderSpec collider;
        collider.meshData = std::make_shared<world::MeshData>(data);
        return collider;
    };
    world::SceneSpec scene;
    scene.colliders = {meshOf(39'999)};
    EXPECT_EQ(preparationText(scene), "");
    scene.colliders.push_back({});
    scene.colliders.back().name = "hares";
    scene.colliders.back().parts = {meshOf(70'000), meshOf(12), meshOf(40'000)};
    world::BlockSpec block;
    block.name = "jelly";
    block.cells = {99, 99, 4};
    scene.bodies.add(block);
    EXPECT_EQ(preparationText(scene),
              "preparing collider.hares: 70000 triangles, collider.hares: 40000 triangles, block.jelly: 50000 points");
}

TEST(Outputs, ExistingVideoIsNotOverwrittenUnasked) {
    const WithoutTerminal noTerminal;
    const TemporaryFolder folder;
    test::writeText(folder / "a.mp4", "old");
    messageOf(ErrorKind::inputOutput, [&] { permitOverwritingFile(folder / "a.mp4", Overwrite::ask); });
    EXPECT_NO_THROW(permitOverwritingFile(folder / "b.mp4", Overwrite::ask));
}

TEST(Outputs, OnePictureNeedsNoPlaceForItsNumber) {
    RenderFlags flags;
    flags.output = "out/still.png";
    messageOf(ErrorKind::usage, [&] { framePattern(flags); });
    flags.frames = "120";
    EXPECT_EQ(framePattern(flags).pathOf(120), "out/still.png");
    flags.frames = "120-121";
    messageOf(ErrorKind::usage, [&] { framePattern(flags); });
    flags.frames.clear();
    flags.at = {"2.5"};
    EXPECT_EQ(framePattern(flags).pathOf(0), "out/still.png");
    flags.at = {"1", "2.5"};
    messageOf(ErrorKind::usage, [&] { framePattern(flags); });
    flags.output = "out/still_#.png";
    EXPECT_EQ(framePattern(flags).pathOf(1), "out/still_1.png");
}

TEST(Outputs, ARunWithoutANameIsAVideoOfTheScenesName) {
    RenderFlags flags;
    flags.scene = "scenes/my.toml";
    completeFlags(flags);
    EXPECT_EQ(flags.output, "my.mp4");
    flags.output = "out/show";
    completeFlags(flags);
    EXPECT_EQ(flags.output, "out/show");
    flags.output.clear();
    flags.noPictures = true;
    completeFlags(flags);
    EXPECT_EQ(flags.output, "");
}

}  // namespace
}  // namespace taut::game
