// A layer of pictures from outside the engine: normals in the axes of the camera, with shaders and a row of their own.
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "image_support.h"
#include "program_support.h"
#include "taut/core/whole_file.h"
#include "taut/image/read.h"
#include "taut/pipeline/run_parts.h"
#include "taut/render/private/layer_pass.h"
#include "taut/view/camera_axes.h"

namespace taut::test::own_layer {
namespace {

constexpr const char* vertexShader = R"(#include "frame.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 transform;
uniform mat3 toView;
out vec3 seen;

void main() {
    seen = toView * mat3(transform) * normal;
    gl_Position = viewProjection * transform * vec4(position, 1.0);
}
)";

constexpr const char* fragmentShader = R"(in vec3 seen;
out vec4 colour;

void main() {
    colour = vec4(0.5 + 0.5 * normalize(seen), 1.0);
}
)";

class NormalsPass : public render::FlatPass {
  public:
    using FlatPass::FlatPass;

  private:
    void begin(render::Program& program, const render::LayerScene& scene, const view::Surface&) const override {
        const view::CameraAxes axes = view::axesOf(scene.view.camera);
        program.set("toView", glm::transpose(glm::mat3(axes.right, axes.up, -axes.forward)));
    }
};

class NormalsLayer : public render::Layer {
  public:
    explicit NormalsLayer(const TemporaryFolder& shaders)
        : vertexFile_((shaders / "normals.vert").string()), fragmentFile_((shaders / "normals.frag").string()) {
        writeText(vertexFile_, vertexShader);
        writeText(fragmentFile_, fragmentShader);
    }
    std::string name() const override { return "own-normals"; }
    render::LayerFacts facts() const override { return {{"axes", "right, up, back"}}; }
    std::unique_ptr<render::LayerPass> pass(const render::Gl& gl, const render::ShaderFolder& shaders,
                                            glm::ivec2 size) const override {
        return std::make_unique<NormalsPass>(gl, shaders.program(vertexFile_, fragmentFile_), size);
    }

  private:
    std::string vertexFile_, fragmentFile_;
};

Outcome runWithNormals(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
    game::Tables tables;
    render::LayerKind normals{"own-normals", "Write a NAME.own-normals.png beside each frame: normals of surfaces"};
    normals.ask = [&](double, const view::FrameView&) { return std::make_shared<NormalsLayer>(folder); };
    tables.layers.add(normals);
    return run(arguments, game::builtInCommands(tables));
}

// A box of a metre whose edge points to the camera: its sides are seen at 45 degrees.
std::string boxScene(const TemporaryFolder& folder) {
    const auto path = folder / "box.toml";
    writeText(path, R"(schema = 1
[run]
fps = 20
seconds = 0.05
[picture]
size = [64, 48]
[collider.box]
shape = "box"
size = [1.0, 1.0, 1.0]
position = [0.0, 0.5, 0.0]
rotation_deg = [0.0, 45.0, 0.0]
[camera.main]
eye = [0.0, 0.5, 3.0]
target = [0.0, 0.5, 0.0]
)");
    return path.string();
}

TEST(OwnLayer, IsDrawnIntoFilesOfItsNameAndStandsInTheRecord) {
    const TemporaryFolder folder;
    const std::string output = (folder / "out").string();
    const Outcome outcome =
        runWithNormals(folder, {"render", boxScene(folder), "-o", output, "--own-normals", "--mask", "--quiet"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const image::Image picture = image::readImage(folder / "out" / "frame_000000.own-normals.png");
    const auto at = [&](int x) {
        const auto* first = &picture.rgb[3 * static_cast<std::size_t>(24 * 64 + x)];
        return std::array<int, 3>{first[0], first[1], first[2]};
    };
    // (∓√½, 0, √½): 127.5 ± 90.2, 127.5, 217.7, rounded; black where nothing is.
    const auto expectNear = [](const std::array<int, 3>& pixel, const std::array<double, 3>& expected) {
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], expected[c], 1.0) << c;
    };
    expectNear(at(26), {37.3, 127.5, 217.7});
    expectNear(at(38), {217.7, 127.5, 217.7});
    expectNear(at(2), {0.0, 0.0, 0.0});

    const auto record = nlohmann::json::parse(core::fileContent(folder / "out" / "run.json"));
    EXPECT_EQ(
        record["layers"].dump(),
        R"({"albedo":null,"alpha":null,"depth":null,"flow":null,"mask":{"collider.box":"#800000"},"normals":null,)"
        R"("own-normals":{"axes":"right, up, back"}})");
    EXPECT_EQ(pipeline::readPartRecord(folder / "out" / "run.json").besides,
              (std::vector<std::string>{"mask", "own-normals"}));
}

TEST(OwnLayer, HasAFlagAsTheOthersHave) {
    const TemporaryFolder folder;
    EXPECT_TRUE(has(runWithNormals(folder, {"render", "--help"}).out,
                    "\n  --own-normals               Write a NAME.own-normals.png"));
    EXPECT_FALSE(has(run({"render", "--help"}).out, "own-normals"));
    EXPECT_TRUE(has(runWithNormals(folder, {"render", "flag", "-o", "a.mp4", "--own-normals"}).err,
                    "--own-normals writes files beside frames: add -o out/frame_######.png;"));
}

// The program's texts about its own layers, word for word.
TEST(OwnLayer, WithoutItTheOthersAreAsTheyWere) {
    EXPECT_TRUE(has(run({"render", "flag", "-o", "out", "--depth-range", "10"}).err,
                    "--depth-range sets the numbers of --depth: add both"));
    EXPECT_TRUE(has(run({"render", "flag", "-o", "a.mp4", "--mask", "--depth"}).err,
                    "--depth writes files beside frames: add -o out/frame_######.png; --video adds a "
                    "video"));
}

}  // namespace
}  // namespace taut::test::own_layer
