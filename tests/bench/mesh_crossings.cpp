// Edges that go through triangles, in meshes of any program. beside.sh compares them besides the time.
//
//   taut_mesh_crossings play SCENE FOLDER [OVERRIDE…]   plays it, and writes cloth.sheet of every frame as OBJ
//   taut_mesh_crossings count FILE…                     how many have crossings, of how many, and the most
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/piercings.h"
#include "taut/core/error.h"
#include "taut/scene/load.h"
#include "taut/scene/private/obj_file.h"

using namespace taut;

namespace {

int play(const std::string& file, const std::filesystem::path& folder, const std::vector<std::string>& overrides) {
    const world::SceneSpec spec = scene::loadScene(file, {.overrides = overrides}).spec;
    const world::BodySpec* sheet = nullptr;
    for (const world::BodySpec& body : spec.bodies)
        if (body.fullName() == "cloth.sheet") sheet = &body;
    if (sheet == nullptr) throw core::Error(core::ErrorKind::badContent, file + ": there is no cloth.sheet");
    const std::vector<std::array<int, 3>> triangles = sheet->build(spec).triangles;
    world::World world(spec, {.threads = 1});
    for (int frame = 1; world.time() < spec.run.seconds; ++frame) {
        for (int tick = 0; tick < world.ticksPerFrame(); ++tick)
            if (const auto divergence = world.advance()) {
                std::fprintf(stderr, "%s\n", divergence->message.c_str());
                return 4;
            }
        char name[32];
        std::snprintf(name, sizeof name, "%04d.obj", frame);
        std::ofstream obj(folder / name);
        obj.precision(17);
        for (const glm::dvec3& x : world.points("cloth.sheet").x)
            obj << "v " << x.x << ' ' << x.y << ' ' << x.z << '\n';
        for (const auto& t : triangles) obj << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
    }
    return 0;
}

int count(const std::vector<std::string>& files) {
    int crossed = 0, worst = 0;
    for (const std::string& file : files) {
        const world::MeshData mesh = scene::objMesh(file);
        test::Skin skin;
        for (const auto& t : mesh.triangles) skin.addTriangle(t[0], t[1], t[2]);
        const int crossings = test::countPiercings(skin, mesh.positions);
        crossed += crossings > 0 ? 1 : 0;
        worst = std::max(worst, crossings);
    }
    std::printf("%d %zu %d\n", crossed, files.size(), worst);
    return 0;
}

}  // namespace

int main(int argc, char** argv) try {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.size() >= 3 && words[0] == "play") return play(words[1], words[2], {words.begin() + 3, words.end()});
    if (words.size() >= 2 && words[0] == "count") return count({words.begin() + 1, words.end()});
    std::fprintf(stderr, "taut_mesh_crossings play SCENE FOLDER [OVERRIDE…] | count FILE…\n");
    return 2;
} catch (const core::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
