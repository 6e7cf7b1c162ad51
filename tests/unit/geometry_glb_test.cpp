// GLB files read back by a reader that knows the glTF 2.0 specification and nothing of the writer.
#include <cstring>
#include <nlohmann/json.hpp>

#include "taut/geometry/glb_writer.h"
#include "unit/geometry_support.h"

namespace taut {
namespace {

using nlohmann::json;

struct Glb {
    explicit Glb(const std::filesystem::path& path) {
        const std::string bytes = test::bytesOf(path);
        EXPECT_EQ(bytes.substr(0, 4), "glTF");
        EXPECT_EQ(word(bytes, 4), 2U);
        EXPECT_EQ(word(bytes, 8), bytes.size());
        const std::uint32_t length = word(bytes, 12);
        EXPECT_EQ(bytes.substr(16, 4), "JSON");
        text = json::parse(bytes.substr(20, length));
        EXPECT_EQ(length % 4, 0U);
        EXPECT_EQ(word(bytes, 20 + length), text["buffers"][0]["byteLength"]);
        EXPECT_EQ(bytes.substr(24 + length, 4), std::string("BIN\0", 4));
        binary = bytes.substr(28 + length);
        EXPECT_EQ(binary.size(), text["buffers"][0]["byteLength"]);
    }

    static std::uint32_t word(const std::string& bytes, std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, 4);
        return value;
    }

    // The numbers of an accessor of floats, element by element.
    std::vector<std::vector<float>> floats(const json& number) const {
        const json& accessor = text["accessors"][number.get<std::size_t>()];
        const json& view = text["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        EXPECT_EQ(accessor["componentType"], 5126);
        const std::string type = accessor["type"];
        const std::size_t width = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
        const std::size_t stride = view.value("byteStride", 4 * width);
        const std::size_t start = view["byteOffset"].get<std::size_t>() + accessor.value("byteOffset", std::size_t{0});
        std::vector<std::vector<float>> all;
        for (std::size_t i = 0; i < accessor["count"].get<std::size_t>(); ++i) {
            all.emplace_back(width);
            EXPECT_LE(start + i * stride + 4 * width, binary.size());
            std::memcpy(all.back().data(), binary.data() + start + i * stride, 4 * width);
        }
        return all;
    }

    const json& named(const char* array, const std::string& name) const {
        for (const json& item : text[array])
            if (item.value("name", "") == name) return item;
        ADD_FAILURE() << "no " << name << " in " << array;
        return text;
    }

    // The numbers that a channel of the only animation moves a node by.
    json channel(const std::string& node, const std::string& path) const {
        const json& animation = text["animations"][0];
        for (const json& that : animation["channels"]) {
            const auto target = that["target"]["node"].get<std::size_t>();
            if (text["nodes"][target]["name"] == node && that["target"]["path"] == path)
                return animation["samplers"][that["sampler"].get<std::size_t>()];
        }
        ADD_FAILURE() << "nothing moves " << path << " of " << node;
        return {};
    }

    json text;
    std::string binary;
};

TEST(Glb, HasAShapeAFrameAndPosesOfWhatIsRigid) {
    const auto path = test::emptyFolder("glb") / "film.glb";
    const std::vector<float> heights = {1.0F, 1.25F, 1.25F, 0.7F};
    geometry::GlbWriter writer(path, {});
    test::Film film;
    for (std::int64_t k = 0; k < 4; ++k) writer.write(film.frame(2 + k, heights[k]));
    EXPECT_FALSE(std::filesystem::exists(path));
    writer.finish();

    const Glb glb(path);
    const json flag = glb.named("meshes", "cloth_flag")["primitives"][0];
    const auto first = glb.floats(flag["attributes"]["POSITION"]);
    EXPECT_EQ(first[2], (std::vector<float>{0, 1, 0}));
    EXPECT_EQ(glb.text["accessors"][flag["attributes"]["POSITION"].get<std::size_t>()]["max"], json({1.0, 1.0, 0.0}));
    // A surface that does not change from a frame to the next has no shape of its own.
    ASSERT_EQ(flag["targets"].size(), 2U);
    EXPECT_TRUE(flag["targets"][0].contains("NORMAL"));

    const json sampler = glb.channel("cloth_flag", "weights");
    EXPECT_EQ(sampler["interpolation"], "LINEAR");
    const auto times = glb.floats(sampler["input"]), weights = glb.floats(sampler["output"]);
    for (std::size_t key = 0; key < 4; ++key) {
        EXPECT_FLOAT_EQ(times[key][0], 0.1F * static_cast<float>(key));  // from the first frame on
        float height = first[2][1];
        for (std::size_t target = 0; target < 2; ++target)
            height += weights[2 * key + target][0] * glb.floats(flag["targets"][target]["POSITION"])[2][1];
        EXPECT_NEAR(height, heights[key], 1e-7);  // a rounding of a difference
    }

    EXPECT_FALSE(glb.named("meshes", "collider_ball")["primitives"][0].contains("targets"));
    const auto way = glb.floats(glb.channel("collider_ball", "translation")["output"]);
    for (std::size_t key = 0; key < 4; ++key) EXPECT_EQ(way[key][0], static_cast<float>(2 + key));
    EXPECT_EQ(test::filesIn(path.parent_path()), 1U);
}

TEST(Glb, HasEveryLightOnANode) {
    const auto path = test::emptyFolder("glb_lights") / "film.glb";
    geometry::GlbWriter writer(path, {});
    view::FrameView view = test::Film().frame(0, 1.0F);
    view.lamps = {{"fill", {0.0F, -1.0F, 0.0F}, {1.0F, 2.0F, 0.0F}, 0.5F, true}};
    writer.write(view);
    writer.finish();
    const Glb glb(path);
    const json& lights = glb.text["extensions"]["KHR_lights_punctual"]["lights"];
    ASSERT_EQ(lights.size(), 2U);
    EXPECT_EQ(lights[1], json::parse(R"({"type":"directional","name":"lamp.fill","color":[0.5,1,0],"intensity":2})"));
    EXPECT_EQ(glb.named("nodes", "lamp.fill")["extensions"]["KHR_lights_punctual"]["light"], 1);
}

TEST(Glb, RefusesWhatTearsAndLeavesNothing) {
    const auto folder = test::emptyFolder("torn");
    test::Film film;
    {
        geometry::GlbWriter writer(folder / "film.glb", {});
        writer.write(film.frame(0, 1.0F));
        film.flag.topology = std::make_shared<view::Topology>(view::Topology{{0, 2, 1}, {{0, 0}, {1, 0}, {0, 1}}});
        try {
            writer.write(film.frame(1, 1.0F));
            ADD_FAILURE() << "took another topology";
        } catch (const geometry::TopologyChanged& torn) {
            EXPECT_EQ(torn.name(), "cloth.flag");
            EXPECT_EQ(torn.frame(), 1);
        }
    }
    EXPECT_EQ(test::filesIn(folder), 0U);
}

TEST(Glb, HidesWhatIsNotThere) {
    const auto path = test::emptyFolder("hidden") / "film.glb";
    test::Film film;
    geometry::GlbWriter writer(path, {});
    for (std::int64_t k = 0; k < 3; ++k) {
        view::FrameView view = film.frame(k, 1.0F);
        if (k == 0) view.surfaces.pop_back();
        writer.write(view);
    }
    writer.finish();
    const Glb glb(path);
    const json sampler = glb.channel("cloth_flag", "scale");
    EXPECT_EQ(sampler["interpolation"], "STEP");
    const auto scales = glb.floats(sampler["output"]);
    EXPECT_EQ((std::vector<float>{scales[0][1], scales[1][1], scales[2][1]}), (std::vector<float>{0, 1, 1}));
}

// Half of a step at most, of which 32767 are the largest move of the film: 3 m in the third frame. Sums over the frames
// and over the vertices before, of 16 bits, give them back.
TEST(Glb, CompactMovesAreRoundedToSixteenBits) {
    const auto path = test::emptyFolder("compact") / "film.glb";
    const std::vector<float> heights = {1.0F, 2.0F, 4.0F, 1.0F / 3.0F};
    geometry::GeometryOptions options;
    options.isCompact = true;
    geometry::GlbWriter writer(path, options);
    test::Film film;
    for (std::int64_t k = 0; k < 4; ++k) writer.write(film.frame(k, heights[k]));
    writer.finish();
    const Glb glb(path);
    EXPECT_EQ(glb.text["scenes"][0]["extras"]["taut"]["times"].size(), 4U);
    const json& mesh = glb.named("meshes", "cloth_flag");
    const json &primitive = mesh["primitives"][0], &own = mesh["extras"]["taut"];
    EXPECT_EQ(own["targetOf"], json({0, 1, 2, 3}));
    EXPECT_FALSE(primitive.contains("targets"));
    const std::size_t count = glb.floats(primitive["attributes"]["POSITION"]).size();
    const json& view = glb.text["bufferViews"][own["moves"].get<std::size_t>()];
    EXPECT_EQ(view["byteLength"], 3 * 3 * 2 * count);
    const auto byteAt = [&](std::size_t at) {
        return static_cast<unsigned char>(glb.binary[view["byteOffset"].get<std::size_t>() + at]);
    };
    const float step = own["step"];
    EXPECT_FLOAT_EQ(step, 3.0F / 32767.0F);
    std::vector<int> up(count);
    for (std::size_t key = 1; key < 4; ++key) {
        int change = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t low = (key - 1) * 6 * count + 3 * i + 1;
            const int kept = byteAt(low) + 256 * byteAt(low + 3 * count);
            change += kept % 2 == 0 ? kept / 2 : -(kept + 1) / 2;
            up[i] = static_cast<std::int16_t>(up[i] + change);
        }
        EXPECT_NEAR(static_cast<float>(up[2]) * step, heights[key] - 1.0F, 0.5F * step + 1e-7F);
    }
}

TEST(Glb, UprightPicturesAreAsWideAs16To9) {
    const auto path = test::emptyFolder("upright") / "film.glb";
    geometry::GeometryOptions options;
    options.aspect = 9.0 / 16.0;
    geometry::GlbWriter writer(path, options);
    test::Film film;
    const view::FrameView view = film.frame(0, 1.0F);
    writer.write(view);
    writer.finish();
    const double high = Glb(path).text["cameras"][0]["perspective"]["yfov"];
    const auto field = static_cast<double>(view.camera.fieldOfView);
    EXPECT_NEAR(std::tan(0.5 * high) * 9.0 / 16.0, std::tan(0.5 * field) * 16.0 / 9.0, 1e-6);  // floats
}

TEST(Glb, TextureCoordinatesAreOfWhatTheyChange) {
    const auto has = [](const auto& change) {
        view::Finish finish;
        change(finish);
        const auto path = test::emptyFolder("uv") / "film.glb";
        geometry::GlbWriter writer(path, {});
        test::Film film;
        film.flag.finish = std::make_shared<view::Finish>(finish);
        writer.write(film.frame(0, 1.0F));
        writer.finish();
        return Glb(path).named("meshes", "cloth_flag")["primitives"][0]["attributes"].contains("TEXCOORD_0");
    };
    EXPECT_FALSE(has([](view::Finish&) {}));
    EXPECT_TRUE(has([](view::Finish& finish) { finish.pattern = view::Pattern::tartan; }));
    EXPECT_TRUE(has([](view::Finish& finish) { finish.weave = 0.5F; }));
    EXPECT_TRUE(has([](view::Finish& finish) { finish.slub = 0.5F; }));
    EXPECT_TRUE(has([](view::Finish& finish) { finish.fuzz = 0.5F; }));
    EXPECT_TRUE(has([](view::Finish& finish) { finish.anisotropy = 0.5F; }));
}

}  // namespace
}  // namespace taut
