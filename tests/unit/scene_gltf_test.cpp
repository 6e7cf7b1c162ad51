// Figures from glTF files. support/arm.gltf is a strip of two joints, one unit apart, with a morph target.
#include <sys/resource.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "taut/drawing/collider_figure.h"
#include "taut/figure/figure.h"
#include "taut/scene/private/gltf_file.h"
#include "taut/world/world.h"
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

using glm::dvec3;

std::string armText() {
    std::ifstream file(std::string(TAUT_SOURCE_DIR) + "/tests/support/arm.gltf", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string armWith(const std::string& before, const std::string& after) {
    std::string text = armText();
    const std::size_t at = text.find(before);
    EXPECT_NE(at, std::string::npos) << before;
    return text.replace(at, before.size(), after);
}

std::vector<dvec3> placesAt(const figure::Figure& figure, const char* animation, double seconds) {
    std::vector<dvec3> places(figure.vertexCount());
    figure::placeVertices(figure, figure::postureAt(figure, figure.find(animation), seconds), places);
    return places;
}

TEST(SceneGltf, AVertexFollowsItsJointsByTheirWeights) {
    const world::MeshData mesh = gltfMeshText(armText(), "arm.gltf", {});
    EXPECT_EQ(mesh.positions.size(), 10U);
    EXPECT_EQ(mesh.triangles.size(), 8U);
    EXPECT_EQ(mesh.positions[9], dvec3(0.25, 2, 0));
    EXPECT_EQ(mesh.notes, (std::vector<std::string>{"1 camera(s)"}));
    // A third of a quarter turn of the upper joint: 30 degrees about (0, 1, 0).
    const std::vector<dvec3> x = placesAt(*mesh.figure, "bend", 1.0 / 3.0);
    const double c = std::sqrt(0.75), s = 0.5;
    const auto turned = [&](const dvec3& p) {
        return dvec3(c * p.x - s * (p.y - 1), 1 + s * p.x + c * (p.y - 1), 0.0);
    };
    const auto expectNear = [](const dvec3& a, const dvec3& b) {
        EXPECT_LT(glm::length(a - b), 1e-7) << a.x << " " << a.y;
    };
    expectNear(x[3], {0.25, 0.5, 0});        // the lower joint's
    expectNear(x[9], turned({0.25, 2, 0}));  // the upper one's
    const double w = 128.0 / 255.0;          // between both
    expectNear(x[5], w * dvec3(0.25, 1, 0) + (1 - w) * turned({0.25, 1, 0}));
    // Beyond its ends the animation stays.
    EXPECT_EQ(placesAt(*mesh.figure, "bend", 7.0), placesAt(*mesh.figure, "bend", 1.0));
}

TEST(SceneGltf, AMorphTargetMovesItsVerticesByItsWeight) {
    const world::MeshData mesh = gltfMeshText(armText(), "arm.gltf", {});
    const std::vector<dvec3> x = placesAt(*mesh.figure, "grow", 0.25);
    EXPECT_EQ(x[8], dvec3(-0.25, 2.125, 0));
    EXPECT_EQ(x[7], dvec3(0.25, 1.5, 0));
}

TEST(SceneGltf, SaysWhatIsWrong) {
    const auto messageOf = [](const std::string& text) -> std::string {
        try {
            gltfMeshText(text, "arm.gltf", {});
        } catch (const core::Error& error) {
            EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
            return error.what();
        }
        return "";
    };
    const auto wrong = [&](const std::string& before, const std::string& after) {
        return messageOf(armWith(before, after));
    };
    const std::string intro = "arm.gltf: error: ";
    EXPECT_EQ(wrong("\"version\": \"2.0\"", "\"version\": \"1.0\""), intro + "only glTF 2.0 is read");
    EXPECT_EQ(wrong("\"children\": [1]", "\"children\": [0]"), intro + "nodes are parents of their parents");
    EXPECT_EQ(wrong("\"children\": [1]", "\"children\": [1, 7]"), intro + "there is no node 7: the file has 3");
    EXPECT_EQ(wrong("\"joints\": [0, 1]", "\"joints\": [0]"), intro + "mesh \"strip\" follows joint 1: its skin has 1");
    EXPECT_EQ(wrong("\"count\": 24", "\"count\": 23"), intro + "mesh \"strip\" has 23 corners of triangles");
    EXPECT_EQ(wrong("\"count\": 24", "\"count\": 400"), intro + "an accessor leaves its bufferView");
    EXPECT_EQ(wrong("\"mesh\": 0, \"skin\": 0", "\"skin\": 0"), intro + "there are no triangles");
    EXPECT_EQ(wrong("\"path\": \"weights\"", "\"path\": \"scale\""),
              intro + "accessor 7: a key needs 3 numbers an element");
    EXPECT_EQ(wrong("base64,A", "base64,*"), intro + "a data URI of it is not base64");
    EXPECT_EQ(wrong("\"indices\": 3", "\"indices\": 8"), intro + "accessor[8] invalid bufferView");
    // Compressed parts have accessors without one.
    for (const std::string where : {"extensionsRequired", "extensionsUsed"})
        EXPECT_EQ(wrong("\"indices\": 3", "\"indices\": 8}]}],\n\"" + where +
                                              "\": [\"KHR_draco_mesh_compression\"],\n\"extras\": [{\"a\": [{\"a\": 0"),
                  intro + "it cannot be read without KHR_draco_mesh_compression: export it without that extension");
    EXPECT_EQ(wrong("{\n", "{\n\"extensionsRequired\": [\"KHR_draco_mesh_compression\"],\n"),
              intro + "it cannot be read without KHR_draco_mesh_compression: export it without that extension");
    EXPECT_NE(wrong("{\n", "{\n{").find(intro), std::string::npos);
}

std::string binary(const std::string& text) {
    const auto number = [](std::size_t value) {
        const auto n = static_cast<std::uint32_t>(value);
        return std::string(reinterpret_cast<const char*>(&n), 4);
    };
    return "glTF" + number(2) + number(20 + text.size()) + number(text.size()) + "JSON" + text;
}

TEST(SceneGltf, TextIsRefusedBeforeItIsTooDeepForTheStack) {
    const auto deep = [](int levels) {
        const auto count = static_cast<std::size_t>(levels - 1);  // the whole is one
        return armWith("{\n",
                       "{\n\"extras\": " + std::string(count, '[') + "\"]]{\\\"[\"" + std::string(count, ']') + ",\n");
    };
    EXPECT_EQ(gltfMeshText(deep(64), "arm.gltf", {}).positions.size(), 10U);
    for (const int levels : {65, 1'000'000})
        for (const std::string& text : {deep(levels), binary(deep(levels))}) try {
                gltfMeshText(text, "arm.gltf", {});
                FAIL();
            } catch (const core::Error& error) {
                EXPECT_STREQ(error.what(), "arm.gltf: error: its JSON is nested more than 64 deep: export it again");
            }
}

// JSON may write \/ for /.
TEST(SceneGltf, BytesInTheTextAreThoseOfTheStandard) {
    std::string text = armText();
    for (std::size_t at = text.find('/', text.find("data:")); at != std::string::npos; at = text.find('/', at + 2))
        text.replace(at, 1, "\\/");
    const auto expected = gltfMeshText(armText(), "arm.gltf", {}).positions;
    EXPECT_EQ(gltfMeshText(text, "arm.gltf", {}).positions, expected);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    EXPECT_EQ(gltfMeshText(binary(text), "arm.glb", {}).positions, expected);
}

// The text itself is the first; 3/4 of it are its bytes.
TEST(SceneGltf, BytesInTheTextTakeAtMostTwiceItsMemory) {
    const auto run = [] {
        constexpr std::size_t groups = 5U << 20U;
        std::string letters(4 * groups, 'A');
        std::string text =
            armWith("\"buffers\": [", "\"buffers\": [\n{\"byteLength\": " + std::to_string(3 * groups) +
                                          ", \"uri\": \"data:application/gltf-buffer;base64," + letters + "\"},");
        for (std::size_t at = 0; (at = text.find("\"buffer\": 0", at)) != std::string::npos; ++at) text[at + 10] = '1';
        letters = {};
        std::size_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        const rlimit limit{pages * 4096 + 4 * groups, RLIM_INFINITY};
        ::setrlimit(RLIMIT_AS, &limit);
        std::_Exit(gltfMeshText(std::move(text), "arm.gltf", {}).positions.size() == 10 ? 0 : 1);
    };
    EXPECT_EXIT(run(), testing::ExitedWithCode(0), "");
}

TEST(SceneGltf, AFileThatItNamesHasToBeAllowed) {
    const AssetFolder folder;
    std::filesystem::create_directory(folder / "inner");
    const std::string text = armText();
    const std::size_t first = text.find("data:"), last = text.find('"', first);
    folder.write("inner/arm.gltf", std::string(text).replace(first, last - first, "../secret.bin"));
    folder.write("secret.bin", std::string(1000, '\0'));
    const std::string scene = "schema = 1\n[collider.f]\nshape = \"figure\"\nmesh = \"inner/arm.gltf\"\n";
    LoadOptions options;
    options.isConfined = true;
    EXPECT_EQ(folder.messageOf(scene, options).find("lies outside"), std::string::npos);  // of the scene's folder
    options.assetFolders = {};
    const Confinement confinement{{folder / "inner"}};
    EXPECT_THROW(gltfMesh(folder / "inner/arm.gltf", confinement), core::Error);
}

// Before 0 too, where it begins again and again.
TEST(SceneGltf, AFigureWaitsForTheStartOfItsAnimation) {
    const AssetFolder folder;
    folder.write("arm.gltf", armText());
    const auto placesAt = [&](const std::string& start, double seconds) {
        const world::SceneSpec scene = folder
                                           .load(
                                               "schema = 1\n[collider.f]\nshape = \"figure\"\nmesh = \"arm.gltf\"\n"
                                               "animation = \"bend\"\nstart_s = " +
                                               start + "\n")
                                           .spec;
        return world::ColliderFigure(scene.colliders[0]).at(seconds, {}).places();
    };
    EXPECT_EQ(placesAt("-1.0", 0.75), placesAt("0.0", 0.0));
    EXPECT_EQ(placesAt("-1.0", 1.25), placesAt("0.0", 0.25));
    EXPECT_NE(placesAt("-1.0", 1.25), placesAt("0.0", 0.0));
}

TEST(SceneGltf, AnAnimationOrJointThatIsNotThereIsNamed) {
    const AssetFolder folder;
    folder.write("arm.gltf", armText());
    const std::string scene = "schema = 1\n[collider.f]\nshape = \"figure\"\nmesh = \"arm.gltf\"\n";
    EXPECT_EQ(folder.messageOf(scene), "");
    EXPECT_EQ(folder.messageOf(scene + "[rope.r]\nends = [[0, 0, 0], [1, 0, 0]]\nhold = [\"start\"]\n"
                                       "hold_on = 'collider.f.\"uper\"'\n"),
              "s.toml:8:11: error: collider.f has no joint \"uper\"\n  hold_on = 'collider.f.\"uper\"'\n"
              "            ^ did you mean \"upper\"?");
    try {
        const world::World world(folder.load(scene + "animation = \"walk\"\n").spec);
        FAIL();
    } catch (const core::Error& error) {
        EXPECT_NE(std::string(error.what()).find("arm.gltf has no animation \"walk\"; it has \"bend\", \"grow\""),
                  std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace taut::scene
