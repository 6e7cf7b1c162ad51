// Triangle meshes from OBJ files.
#include <clocale>

#include "taut/scene/private/obj_file.h"
#include "taut/scene/private/polygon.h"
#include "taut/world/world.h"
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

using glm::dvec2;
using glm::dvec3;
using Triangle = std::array<int, 3>;

std::string messageOf(const std::string& text) {
    try {
        objMeshText(text, "m.obj");
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
        return error.what();
    }
    return "";
}

const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(SceneObj, ReadsPositionsAndFacesInTheirOrder) {
    const world::MeshData mesh = objMeshText(corners + "f 1 2 3\nf 1 3 4\n", "m.obj");
    EXPECT_EQ(mesh.positions, (std::vector<dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_TRUE(mesh.uv.empty());
}

TEST(SceneObj, ReadsAllFormsOfACornerAndCountsBack) {
    const std::string uv = "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n";
    const world::MeshData mesh = objMeshText(corners + uv + "f 1/1/1 2/2 -2/-1/1\n", "m.obj");
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
    EXPECT_EQ(mesh.uv, (std::vector<dvec2>{{0, 0}, {1, 0}, {1, 1}}));
    EXPECT_EQ(objMeshText(corners + "vn 0 0 1\nf 1//1 2//1 3//1\n", "m.obj").positions.size(), 3U);
}

TEST(SceneObj, DropsUnusedVerticesAndWeldsSeams) {
    const world::MeshData mesh =
        objMeshText("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv -0.0 0 0\nv 1 1 0\nv 0 1 0\nf 2 3 4\nf 5 6 7\n", "m.obj");
    EXPECT_EQ(mesh.positions, (std::vector<dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(SceneObj, DropsTrianglesThatLoseTheirAreaByWelding) {
    const world::MeshData mesh = objMeshText(corners + "v 1 0 0\nf 1 2 5\nf 1 2 3\n", "m.obj");
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
    EXPECT_EQ(messageOf(corners + "f 1 1 2\n"), "m.obj:5: error: no face has an area");
}

TEST(SceneObj, ReadsNumbersExactlyInEveryLocale) {
    const char* before = std::setlocale(LC_NUMERIC, nullptr);
    const std::string saved = before;
    std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // where it is installed, 0.1 would read as 0 there
    const world::MeshData mesh = objMeshText("v +0.1 1e-3 .5\nv 2. 0 0\nv 0 3E1 0 1 0.5 0.5\nf 1 2 3\n", "m.obj");
    std::setlocale(LC_NUMERIC, saved.c_str());
    EXPECT_EQ(mesh.positions, (std::vector<dvec3>{{0.1, 1e-3, 0.5}, {2, 0, 0}, {0, 30, 0}}));
}

TEST(SceneObj, ReadsWindowsLineEndsCommentsJoinedLinesAndNoLastLineEnd) {
    const world::MeshData mesh = objMeshText(
        "\xEF\xBB\xBF# a model\r\no thing\r\nv 0 0 0\r\nv 1 0 0 # right\r\n\r\nv 1 1 0\r\nusemtl red\r\nf 1 \\\r\n2 3",
        "m.obj");
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(SceneObj, GroupsOfLinesAloneNameTheirVertices) {
    // Pieces that lie criss-cross, as modellers write them; points at no face; points with faces.
    const world::MeshData mesh = objMeshText(
        corners + "v 9 9 9\ng seam\nl 3 2\nl 1 3\ng loose\nl 1 5\ng sheet\nl 2 1\nf 1 2 3\nf 1 3 4\n", "m.obj");
    using Groups = std::map<std::string, std::vector<int>>;
    EXPECT_EQ(mesh.groups, (Groups{{"seam", {0, 1, 2}}, {"sheet", {0, 1, 2, 3}}}));
    EXPECT_EQ(messageOf(corners + "g a\nl 1\nf 1 2 3\n"), "m.obj:6: error: a line needs at least two vertices");
}

TEST(SceneObj, GroupsAndObjectsNameTheVerticesOfTheirFaces) {
    const world::MeshData mesh =
        objMeshText("o the shirt\nv 9 9 9\n" + corners + "g collar seam\nf 2 3 4\ng\nf 2 4 5\no\nf 2 3 5\n", "m.obj");
    using Groups = std::map<std::string, std::vector<int>>;
    EXPECT_EQ(mesh.groups, (Groups{{"the shirt", {0, 1, 2, 3}}, {"collar", {0, 1, 2}}, {"seam", {0, 1, 2}}}));
    EXPECT_EQ(mesh.numbers, (std::vector<int>{2, 3, 4, 5}));
    EXPECT_EQ(mesh.lines, (std::vector<int>{8, 10, 12}));
}

TEST(SceneObj, AGroupIsASelectionOfPoints) {
    const AssetFolder folder;
    folder.write("shirt.obj", corners + "v 2 0 0\ng collar\nf 1 2 3\ng left\nf 1 3 4\ng hem\nf 2 5 3\n");
    const std::string text =
        "schema = 1\n[material.m]\n[cloth.c]\nmaterial = \"m\"\nmesh = \"shirt.obj\"\nhold = [\"collar\"]\n"
        "[[at]]\nt = 0.5\ndo = \"grab\"\nid = \"h\"\ntarget = \"cloth.c@hem\"\n";
    world::World world(folder.load(text).spec);
    EXPECT_EQ(world.points("cloth.c@collar").x.size(), 3U);
    EXPECT_EQ(world.points("cloth.c@hem").x.size(), 3U);
    EXPECT_EQ(world.points("cloth.c@left").x.size(), 2U);  // taut's own names stay
    EXPECT_EQ(world.islands().front().heldPoints, 3);
    EXPECT_NE(folder.messageOf(text + "[[mass]]\ntarget = \"cloth.c@colar\"\nmass_kg = 1\n").find("\"collar\"?"),
              std::string::npos);
}

TEST(SceneObj, FacesThatMakeNoClothAreNamedByTheirLine) {
    const AssetFolder folder;
    const std::string cloth = "schema = 1\n[material.m]\n[cloth.c]\nmaterial = \"m\"\nmesh = \"shirt.obj\"\n";
    const auto faultOf = [&](const std::string& faces) -> std::string {
        folder.write("shirt.obj", "v 9 9 9\n" + corners + faces);
        try {
            const world::World world(folder.load(cloth).spec);
        } catch (const core::Error& error) {
            return folder.withoutFolder(error.what());
        }
        return "";
    };
    const std::string intro = "s.toml:3:8: error: cannot use this mesh: shirt.obj:";
    EXPECT_EQ(faultOf("f 2 3 4\nf 2 4 5\n"), "");
    EXPECT_EQ(faultOf("f 2 3 4\nf 2 5 4\n"), intro +
                                                 "7: error: this face and the other at the edge between vertices 2 "
                                                 "and 4 face opposite ways: recalculate normals");
    EXPECT_EQ(faultOf("f 2 3 4\n# twice\nf 2 3 4\n"), intro + "8: error: this face is there twice: delete one");
    EXPECT_EQ(faultOf("v 0.5 0.5 0\nf 2 3 6\nf 2 6 4\n"),
              intro + "8: error: vertices 2, 6 and 4 of this face lie on a line: merge by distance, or triangulate it");
}

TEST(SceneObj, OtherFormatsAreRefusedByName) {
    const AssetFolder folder;
    folder.write("shirt.fbx", "glTF");
    EXPECT_EQ(folder.messageOf("schema = 1\n[material.m]\n[cloth.c]\nmaterial = \"m\"\nmesh = \"shirt.fbx\"\n"),
              "s.toml:5:8: error: cannot use this mesh: shirt.fbx: error: only OBJ and glTF are read: export it as "
              "Wavefront OBJ or as GLB\n"
              "  mesh = \"shirt.fbx\"\n"
              "         ^");
}

TEST(SceneObj, FaultsAreNamedWithTheirLine) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"", "m.obj:1: error: there are no faces"},
        {corners, "m.obj:4: error: there are no faces"},
        {"v 0 0\n", "m.obj:1: error: a vertex needs three numbers"},
        {"v 0 0 zero\n", "m.obj:1: error: \"zero\" is not a number"},
        {"v 0 0 1.0x\n", "m.obj:1: error: \"1.0x\" is not a number"},
        {"v 0 0 ++1\n", "m.obj:1: error: \"++1\" is not a number"},
        {"v 0 0 nan\n", "m.obj:1: error: nan is not a finite place"},
        {"v 0 0 1e400\n", "m.obj:1: error: \"1e400\" is not a number"},
        {"v 0 inf 0\n", "m.obj:1: error: inf is not a finite place"},
        {"v 0 0 1e30\n", "m.obj:1: error: 1e30 is not a finite place"},
        {"vt\n", "m.obj:1: error: a texture coordinate needs a number"},
        {corners + "f 1 2\n", "m.obj:5: error: a face needs at least three corners"},
        {corners + "f 1 2 5\n", "m.obj:5: error: there is no vertex 5: 4 are defined so far"},
        {corners + "f 0 1 2\n", "m.obj:5: error: there is no vertex 0: 4 are defined so far"},
        {corners + "f 1 2 -5\n", "m.obj:5: error: there is no vertex -5: 4 are defined so far"},
        {"f 1 2 3\n" + corners, "m.obj:1: error: there is no vertex 1: 0 are defined so far"},
        {corners + "f 1 2 three\n", "m.obj:5: error: \"three\" is not the number of a vertex"},
        {corners + "f 1 2 99999999999999999999\n",
         "m.obj:5: error: \"99999999999999999999\" is not the number of a vertex"},
        {corners + "f 1/1 2/1 3/1\n", "m.obj:5: error: there is no texture coordinate 1: 0 are defined so far"},
        {corners + std::string("f 1 2 3\n\0", 9), "m.obj:1: error: this is not a text file: it holds a zero byte"},
    };
    for (const auto& [text, message] : cases) EXPECT_EQ(messageOf(text), message) << text;
}

TEST(SceneObj, AFaceOfTooManyCornersIsRefused) {
    std::string face = "f";
    for (int i = 0; i < 1001; ++i) face += " 1";
    EXPECT_EQ(messageOf(corners + face), "m.obj:5: error: a face has at most 1000 corners");
}

double areaOf(const std::vector<dvec3>& polygon, const std::vector<Triangle>& triangles) {
    double sum = 0;
    for (const Triangle& t : triangles) {
        const dvec3& a = polygon[t[0]];
        sum += 0.5 * glm::cross(polygon[t[1]] - a, polygon[t[2]] - a).z;
    }
    return sum;
}

TEST(ScenePolygon, AConvexOneIsAFan) {
    const std::vector<dvec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    EXPECT_EQ(polygonTriangles(square), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ScenePolygon, AConcaveOneIsCoveredOnceInItsOrientation) {
    // An L of area 3 whose fan about its first corner would leave it.
    const std::vector<dvec3> el = {{2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 0}};
    const std::vector<Triangle> triangles = polygonTriangles(el);
    EXPECT_EQ(triangles.size(), 4U);
    EXPECT_NEAR(areaOf(el, triangles), 3.0, 1e-15);
    for (const Triangle& triangle : triangles) EXPECT_GT(areaOf(el, {triangle}), 0.0);
    // From behind it runs the other way round.
    const std::vector<dvec3> behind(el.rbegin(), el.rend());
    for (const Triangle& triangle : polygonTriangles(behind)) EXPECT_LT(areaOf(behind, {triangle}), 0.0);
}

TEST(ScenePolygon, OneWithoutAreaStillGivesTriangles) {
    const std::vector<dvec3> line(7, dvec3(1.0));
    EXPECT_EQ(polygonTriangles(line).size(), 5U);
}

TEST(SceneObj, FilesOfManyProgramsAreReadOrRefusedWithAMessage) {
    const std::filesystem::path models = "/usr/share/assimp/models";
    if (!std::filesystem::exists(models)) FAIL() << "install the package assimp-testmodels; game/packages.txt lists it";
    int read = 0, refused = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(models)) {
        if (entry.path().extension() != ".obj") continue;
        try {
            const world::MeshData mesh = objMesh(entry.path());
            EXPECT_FALSE(mesh.triangles.empty()) << entry.path();
            EXPECT_TRUE(mesh.uv.empty() || mesh.uv.size() == mesh.positions.size()) << entry.path();
            ++read;
        } catch (const core::Error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with(entry.path().string() + ":")) << error.what();
            ++refused;
        }
    }
    EXPECT_GT(read, 10);
    EXPECT_GT(refused, 3);
}

}  // namespace
}  // namespace taut::scene
