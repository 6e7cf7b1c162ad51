#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>

#include "image_support.h"
#include "taut/core/error.h"
#include "taut/pipeline/self_test.h"

namespace taut::pipeline {
namespace {

const std::filesystem::path shaders = std::filesystem::path(TAUT_SOURCE_DIR) / "shaders";

render::RendererOptions optionsWith(const std::filesystem::path& folder) {
    render::RendererOptions options;
    options.width = 64;
    options.height = 48;
    options.shaders = folder;
    return options;
}

TEST(SelfTest, BothLibrariesPass) {
    for (render::Backend backend : render::backends())
        EXPECT_EQ(workingRenderer(optionsWith(shaders), {backend})->info().backend, nameOf(backend));
}

// Why there is no renderer with a surface shader that throws every fragment away, as with a broken driver.
std::string messageOfBlankPicture() {
    const test::TemporaryFolder folder;
    std::filesystem::copy(shaders, folder.path(), std::filesystem::copy_options::recursive);
    std::string text = test::contentOf(folder / "surface.frag");
    const std::size_t body = text.find('{', text.find("void main("));
    EXPECT_NE(body, std::string::npos);
    text.insert(body + 1, " if (gl_FragCoord.x > -1.0) discard; ");
    test::writeText(folder / "surface.frag", text);
    try {
        workingRenderer(optionsWith(folder.path()), render::backends());
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::noRenderer) << error.what();
        return error.what();
    }
    return "a blank picture passed";
}

TEST(SelfTest, ABlankPictureIsNoRendererAndSaysWhatWasTried) {
    const std::string message = messageOfBlankPicture();
    EXPECT_NE(message.find("llvmpipe"), std::string::npos) << message;
    for (const render::Backend backend : render::backends())
        EXPECT_NE(message.find(nameOf(backend)), std::string::npos) << message;
}

// There is memory for the blank picture, but not for a renderer.
TEST(SelfTest, TooLittleMemoryIsWhyNothingDraws) {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit before{};
    ::getrlimit(RLIMIT_AS, &before);
    const rlimit limit{pages * 4096 + (400U << 20U), before.rlim_max};
    ::setrlimit(RLIMIT_AS, &limit);
    const std::string message = messageOfBlankPicture(), ofThree = memoryShortage(3);
    ::setrlimit(RLIMIT_AS, &before);
    EXPECT_EQ(message,
              "nothing here can draw: a renderer takes 500 MB of memory, and there is less; raise the limit (ulimit "
              "-v)");
    EXPECT_EQ(ofThree,
              "a renderer with 3 threads takes 1300 MB of memory, and there is less; raise the limit (ulimit -v) or "
              "take fewer --threads");
}

}  // namespace
}  // namespace taut::pipeline
