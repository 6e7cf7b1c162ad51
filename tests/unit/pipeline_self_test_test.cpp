#include <gtest/gtest.h>

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

// A surface shader that throws every fragment away: what a broken driver would show.
TEST(SelfTest, ABlankPictureIsNoRendererAndSaysWhatWasTried) {
    const test::TemporaryFolder folder;
    std::filesystem::copy(shaders, folder.path(), std::filesystem::copy_options::recursive);
    std::string text = test::contentOf(folder / "surface.frag");
    const std::size_t body = text.find('{', text.find("void main("));
    ASSERT_NE(body, std::string::npos);
    text.insert(body + 1, " if (gl_FragCoord.x > -1.0) discard; ");
    test::writeText(folder / "surface.frag", text);
    try {
        workingRenderer(optionsWith(folder.path()), render::backends());
        FAIL() << "a blank picture passed";
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::noRenderer) << error.what();
        EXPECT_NE(std::string(error.what()).find("llvmpipe"), std::string::npos) << error.what();
        for (const render::Backend backend : render::backends())
            EXPECT_NE(std::string(error.what()).find(nameOf(backend)), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace taut::pipeline
