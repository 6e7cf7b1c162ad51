#include <cstdlib>

#include "taut/geometry/private/number_text.h"
#include "taut/geometry/usda_writer.h"
#include "unit/geometry_support.h"

namespace taut {
namespace {

// The lines of a prim's attribute, from its declaration to the next: without the indent.
std::string attribute(const std::string& text, const std::string& prim, const std::string& declaration) {
    const std::size_t start = text.find(declaration, text.find("\"" + prim + "\""));
    if (start == std::string::npos) return "";
    std::string lines;
    for (std::size_t at = start;;) {
        const std::size_t end = text.find('\n', at);
        const std::string line = text.substr(at, end - at);
        lines += line.substr(line.find_first_not_of(' ')) + "\n";
        at = end + 1;
        if (line.back() == '}' || (lines.find("{\n") == std::string::npos && line.back() != '(')) return lines;
    }
}

TEST(Usda, SamplesWhatChangesWhereItChanges) {
    const auto path = test::emptyFolder("usda") / "film.usda";
    geometry::GeometryOptions options;
    options.fps = 10.0;
    geometry::UsdaWriter writer(path, options);
    test::Film film;
    writer.write(film.frame(5, 1.0F));
    writer.write(film.frame(6, 1.0F));
    writer.write(film.frame(7, 1.0F));
    writer.write(film.frame(8, 2.0F));
    film.flag.topology = std::make_shared<view::Topology>(view::Topology{{0, 2, 1}, {{0, 0}, {1, 0}, {0, 1}}});
    writer.write(film.frame(9, 2.0F));
    writer.finish();
    const std::string text = test::bytesOf(path);
    EXPECT_EQ(text.substr(0, 10), "#usda 1.0\n");
    for (const char* fact : {"startTimeCode = 5\n", "endTimeCode = 9\n", "timeCodesPerSecond = 10\n",
                             "metersPerUnit = 1\n", "upAxis = \"Y\"\n", "defaultPrim = \"scene\"\n"})
        EXPECT_NE(text.find(fact), std::string::npos) << fact;
    // Still until frame 7, from where it moves evenly; where triangles change there is a sample of the points too.
    EXPECT_EQ(attribute(text, "cloth_flag", "point3f[] points"),
              "point3f[] points.timeSamples = {\n"
              "5: [(0,0,0),(1,0,0),(0,1,0)],\n"
              "7: [(0,0,0),(1,0,0),(0,1,0)],\n"
              "8: [(0,0,0),(1,0,0),(0,2,0)],\n"
              "9: [(0,0,0),(1,0,0),(0,2,0)],\n"
              "}\n");
    EXPECT_EQ(attribute(text, "cloth_flag", "float3[] extent"),
              "float3[] extent.timeSamples = {\n"
              "5: [(0,0,0),(1,1,0)],\n"
              "7: [(0,0,0),(1,1,0)],\n"
              "8: [(0,0,0),(1,2,0)],\n"
              "9: [(0,0,0),(1,2,0)],\n"
              "}\n");
    EXPECT_EQ(attribute(text, "cloth_flag", "int[] faceVertexIndices"),
              "int[] faceVertexIndices.timeSamples = {\n5: [0,1,2],\n9: [0,2,1],\n}\n");
    // Some readers do not find metadata on a line with samples.
    EXPECT_NE(text.find("normal3f[] normals (\n            interpolation = \"vertex\"\n        )\n"
                        "        normal3f[] normals.timeSamples = {\n"),
              std::string::npos);
    // A rigid body has one shape and moves.
    EXPECT_EQ(attribute(text, "collider_ball", "point3f[] points"), "point3f[] points = [(0,0,0),(1,0,0),(0,1,0)]\n");
    EXPECT_NE(attribute(text, "collider_ball", "matrix4d xformOp:transform")
                  .find("6: ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (6, 0, 0, 1)),\n"),
              std::string::npos);
    EXPECT_EQ(test::filesIn(path.parent_path()), 1U);
}

// One that throws no shadows says so.
TEST(Usda, HasEveryLight) {
    const auto path = test::emptyFolder("usda_lights") / "film.usda";
    geometry::UsdaWriter writer(path, {});
    view::FrameView view = test::Film().frame(0, 1.0F);
    view.lamps = {{"a-b", {0.0F, -1.0F, 0.0F}, {1.0F, 2.0F, 0.0F}, 0.5F, true},
                  {"a_b", {0.0F, -1.0F, 0.0F}, {1.0F, 1.0F, 1.0F}, 0.5F, false}};
    writer.write(view);
    writer.finish();
    const std::string text = test::bytesOf(path);
    EXPECT_EQ(attribute(text, "lamp_a_b", "color3f inputs:color"), "color3f inputs:color = (0.5, 1, 0)\n");
    EXPECT_EQ(attribute(text, "lamp_a_b", "float inputs:intensity"), "float inputs:intensity = 2\n");
    EXPECT_EQ(attribute(text, "lamp_a_b_2", "bool inputs:shadow:enable"), "bool inputs:shadow:enable = 0\n");
    EXPECT_NE(text.find("\"sun\""), std::string::npos);
}

TEST(Usda, LeavesNothingWithoutItsEnd) {
    const auto folder = test::emptyFolder("usda_left");
    {
        geometry::UsdaWriter writer(folder / "film.usda", {});
        writer.write(test::Film().frame(0, 1.0F));
    }
    EXPECT_EQ(test::filesIn(folder), 0U);
}

// Against the C library's printf of the same number.
TEST(NumberText, IsRoundedAndReadsBack) {
    for (const double value : {0.0, -0.0, 0.5, -1.0, 12.345678, -0.000004, 0.000005001, 99.999996, 1e-9, -123456.789,
                               3.0e10, 1.0 / 3.0, 1e17, -2.5e30}) {
        std::string text;
        geometry::appendNumber(text, value, 5);
        EXPECT_NEAR(std::strtod(text.c_str(), nullptr), value, 0.5000001e-5 + 1e-15 * std::abs(value)) << text;
        EXPECT_NE(text, "-0");
        EXPECT_TRUE(text.find('e') != std::string::npos || text.find('.') == std::string::npos || text.back() != '0')
            << text;
    }
    std::string text;
    geometry::appendNumber(text, -1.250004, 5);
    EXPECT_EQ(text, "-1.25");
}

}  // namespace
}  // namespace taut
