// A format of geometry from outside the engine: its row, and the help, files and messages of `taut export`.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "image_support.h"
#include "program_support.h"
#include "taut/core/whole_file.h"

namespace taut::test::own_format {
namespace {

// The last frame as text.
class PlyWriter : public geometry::GeometrySink {
  public:
    PlyWriter(std::filesystem::path path, const geometry::GeometryOptions& options)
        : path_(std::move(path)), options_(options) {}

    void write(const view::FrameView& view) override { last_ = view; }

    void finish() override {
        std::string vertices, faces;
        std::size_t vertexCount = 0, faceCount = 0;
        for (const view::Surface& surface : last_.surfaces) {
            if (options_.isWanted && !options_.isWanted(surface.name)) continue;
            const std::vector<std::uint32_t>& corners = surface.topology->triangles;
            for (std::size_t i = 0; i < corners.size(); i += 3, ++faceCount)
                faces += fmt::format("3 {} {} {}\n", corners[i] + vertexCount, corners[i + 1] + vertexCount,
                                     corners[i + 2] + vertexCount);
            for (const glm::vec3 local : surface.geometry->positions) {
                const glm::vec3 x = surface.transform * glm::vec4(local, 1.0F);
                vertices += fmt::format("{0:.{3}f} {1:.{3}f} {2:.{3}f}\n", x.x, x.y, x.z, options_.digits);
            }
            vertexCount += surface.geometry->positions.size();
        }
        core::writeWholeFile(path_, fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\n"
                                                "property float y\nproperty float z\nelement face {}\n"
                                                "property list uchar uint vertex_indices\nend_header\n{}{}",
                                                vertexCount, faceCount, vertices, faces));
    }

  private:
    std::filesystem::path path_;
    geometry::GeometryOptions options_;
    view::FrameView last_;
};

Outcome exportWithPly(std::vector<std::string> arguments) {
    game::Tables tables;
    geometry::Format ply{.name = "PLY", .endings = {".ply"}, .readers = "MeshLab"};
    ply.makeSink = [](const std::filesystem::path& path, const geometry::GeometryOptions& options) {
        return std::make_unique<PlyWriter>(path, options);
    };
    ply.mayTear = true;
    ply.hasDigits = true;
    tables.formats.add(ply);
    arguments.insert(arguments.begin(), "export");
    return run(arguments, game::builtInCommands(tables));
}

// A cell that is held at all corners; beside it another cloth, which is cut after a tenth of a second.
std::string sceneIn(const TemporaryFolder& folder) {
    const auto path = folder / "cells.toml";
    writeText(path, R"(schema = 1
[run]
fps = 20
seconds = 0.2
[material.silk]
density_kg_per_m2 = 0.1
stretch_N_per_m = 200.0
[cloth.cell]
material = "silk"
size = [1.0, 1.0]
cells = [1, 1]
origin = [0, 2, 0]
hold = ["left", "right"]
[cloth.other]
material = "silk"
size = [1.0, 1.0]
cells = [2, 1]
origin = [2, 2, 0]
hold = ["left", "right"]
[[at]]
t = 0.1
do = "cut"
target = "cloth.other"
segment = [[0.25, 1.0], [0.25, 0.0]]
)");
    return path.string();
}

TEST(OwnFormat, IsChosenByTheEndingOfTheFile) {
    const TemporaryFolder folder;
    const std::string file = (folder / "cell.ply").string();
    const Outcome outcome =
        exportWithPly({sceneIn(folder), "-o", file, "--only", "cloth.cell", "--digits", "1", "--quiet"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    // The corners are where they are held.
    EXPECT_EQ(core::fileContent(file),
              "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
              "element face 2\nproperty list uchar uint vertex_indices\nend_header\n"
              "0.0 2.0 0.0\n0.0 1.0 0.0\n1.0 1.0 0.0\n1.0 2.0 0.0\n3 0 1 2\n3 0 2 3\n");
}

TEST(OwnFormat, StandsInTheHelpAndInWhatIsSaidOfOthers) {
    const TemporaryFolder folder;
    const std::string scene = sceneIn(folder);
    EXPECT_TRUE(has(exportWithPly({"--help"}).out, "Geometry: out.usda, out.glb, or out.ply\n"));
    EXPECT_TRUE(has(exportWithPly({scene, "-o", "a.obj"}).err,
                    "a.obj: geometry goes to .usda (Houdini, Omniverse, Unreal, Blender; may tear), .glb (the web, "
                    "Blender, VTK) or .ply (MeshLab; may tear)\n"));
    const std::string torn = exportWithPly({scene, "-o", (folder / "a.glb").string(), "--quiet"}).err;
    EXPECT_TRUE(has(torn, "): write .usda or .ply, where they may change, or end before it with --frames 0-")) << torn;
    EXPECT_TRUE(has(exportWithPly({scene, "-o", "a.glb", "--digits", "3"}).err, "--digits applies to .usda and .ply;"));
    EXPECT_FALSE(has(run({"export", "--help"}).out, "ply"));
}

// The program's texts with its own formats alone, word for word.
TEST(OwnFormat, WithoutItTheOthersAreNamed) {
    const auto said = [](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"export", "flag"});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.code, 2);
        return outcome.err.substr(0, outcome.err.find('\n'));
    };
    EXPECT_EQ(said({}),
              "taut: name an output for the geometry: -o out.usda, -o out.glb, --web out.html, or --points out.npz");
    EXPECT_EQ(said({"-o", "a.html"}),
              "taut: a.html: geometry goes to .usda (Houdini, Omniverse, Unreal, Blender; may tear) or .glb (the web, "
              "Blender, VTK); a page that shows it is --web a.html");
    EXPECT_EQ(said({"--web", "a.glb"}), "taut: a.glb: --web writes a page, .html");
    EXPECT_EQ(said({"--web", "a.htm", "--no-normals"}), "taut: --no-normals: a page needs its normals");
    EXPECT_EQ(said({"--points", "a.txt"}), "taut: a.txt: points go to .npz (numpy.load) or .csv");
    EXPECT_EQ(said({"-o", "a.glb", "--digits", "3"}),
              "taut: --digits applies to .usda; other formats have full precision");
}

}  // namespace
}  // namespace taut::test::own_format
