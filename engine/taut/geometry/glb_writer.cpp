#include "taut/geometry/glb_writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "taut/core/file_part.h"
#include "taut/core/whole_file.h"
#include "taut/geometry/private/far_lights.h"
#include "taut/geometry/private/format_table.h"
#include "taut/geometry/private/gltf_text.h"
#include "taut/geometry/private/parts.h"
#include "taut/geometry/private/poses.h"
#include "taut/view/camera_axes.h"

namespace taut::geometry {
namespace {

template <class T>
bool isConstant(const std::vector<T>& values) {
    return std::all_of(
        values.begin(), values.end(), [&](const T& value) { return value == values.front(); });
}

std::string endingOf(const std::string& name) {
    std::string ending = name.substr(std::min(name.rfind('.'), name.size()));
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending;
}

std::string joinedNumbers(std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += fmt::format("{}{}", i > 0 ? "," : "", i);
    return text;
}

std::string vectorText(const glm::vec3& v) {
    return fmt::format("[{},{},{}]", v.x, v.y, v.z);
}

// Whether it looks otherwise at other texture coordinates.
bool isMapped(const view::Finish& finish) {
    return finish.pattern != view::Pattern::plain || finish.weave > 0 || finish.slub > 0 || finish.fuzz > 0 ||
           finish.anisotropy > 0;
}

// The fields of view::Finish that glTF's materials do not have.
std::string finishExtras(const view::Finish& finish) {
    constexpr std::array<const char*, 5> patterns = {"plain", "checker", "stripes", "tartan", "image"};
    return fmt::format(
        R"({{"taut":{{"back":{},"accent":{},"pattern":"{}","repeat":{},"weave":{},"binding":{},"thread":{},"slub":{},"fuzz":{},"sheen":{},"translucency":{},"anisotropy":{}}}}})",
        vectorText(finish.back), vectorText(finish.accent), patterns.at(static_cast<std::size_t>(finish.pattern)),
        finish.repeat, finish.weave, static_cast<int>(finish.binding), finish.thread, finish.slub, finish.fuzz,
        finish.sheen, finish.translucency, finish.anisotropy);
}

}  // namespace

struct GlbWriter::Impl {
    // A part through all frames.
    struct Track {
        Part part;  // as it was at first
        std::string attributes;
        std::size_t indices = 0;
        JsonItems targets;
        std::size_t targetCount = 0;
        std::vector<ScratchFile::Piece> moves;  // (targets) in `shapes`, compact: as vectors
        float farthest = 0.0F;                  // [m] along an axis, of all moves
        std::shared_ptr<const view::Geometry> last;
        std::vector<std::size_t> targetOf;  // (keys) 0: the shape at first, else the number of the target, from 1
        std::vector<glm::mat4> transforms;  // (keys)
        std::vector<bool> isThere;          // (keys)
    };

    Impl(std::filesystem::path file, GeometryOptions given)
        : path(std::move(file)),
          options(std::move(given)),
          finder(options.isWanted),
          data(path),
          shapes(path.string() + ".moves") {}

    std::filesystem::path path;
    GeometryOptions options;
    PartFinder finder;
    GltfData data;
    ScratchFile shapes;  // until the farthest move of all frames is known
    std::vector<Track> tracks;
    std::map<std::string, std::size_t> trackOf;  // by identifier
    std::vector<float> times;                    // (keys) [s]
    double start = 0.0;                          // [s]
    std::vector<glm::mat4> cameras;              // (keys)
    std::vector<FarLight> lights;
    std::vector<glm::vec3> cameraTargets;  // (keys) [m]
    std::vector<float> fieldsOfView;       // (keys) [rad]
    view::Camera camera;                   // as it was at first, like the light and the background
    view::Light light;
    view::Background background;
    std::optional<view::Ground> ground;

    JsonItems nodes, meshes, materials, images, channels, samplers;
    std::map<std::pair<std::shared_ptr<const view::Finish>, bool>, std::size_t> materialOf;
    std::map<std::vector<std::size_t>, std::size_t> weightsOf;
    std::optional<std::size_t> timesAccessor;

    void addTrack(const Part& part);
    void addTarget(Track& track, const view::Geometry& now, std::size_t view);
    std::size_t addMoves(const Track& track, float step);
    void checkSize() const;

    std::size_t material(const Part& part);
    std::string texture(const view::Finish& finish);
    std::string sceneExtras() const;
    std::size_t weights(const Track& track);
    void animate(std::size_t node, const char* path, std::size_t output, const char* interpolation);
    std::string pose(const std::vector<glm::mat4>& matrices, std::size_t node);
    void addNode(const Track& track);
    std::string json();
};

void GlbWriter::Impl::addTrack(const Part& part) {
    const view::Geometry& shape = *part.geometry;
    Track track;
    track.part = part;
    track.last = part.geometry;
    const std::size_t view = data.openView();
    track.attributes = fmt::format(R"("POSITION":{})", data.addVectors(shape.positions, true, view));
    if (options.normals)
        track.attributes += fmt::format(R"(,"NORMAL":{})", data.addVectors(shape.normals, false, view));
    data.closeView(sizeof(glm::vec3));
    if (isMapped(*part.finish)) {
        std::vector<glm::vec2> uv;
        for (const glm::vec2& at : part.topology->uv)
            uv.push_back(glm::vec2(at.x, -at.y) / std::max(part.finish->repeat, 1e-6F));  // v runs down
        track.attributes += fmt::format(R"(,"TEXCOORD_0":{})", data.addVectors(uv));
    }
    track.indices = data.addIndices(part.topology->triangles);
    // Later parts are hidden until then.
    track.targetOf.assign(times.size() - 1, 0);
    track.transforms.assign(times.size() - 1, part.transform);
    track.isThere.assign(times.size() - 1, false);
    trackOf[part.identifier] = tracks.size();
    tracks.push_back(std::move(track));
}

// How far every vertex is from where it was at first.
void GlbWriter::Impl::addTarget(Track& track, const view::Geometry& now, std::size_t view) {
    const auto differences = [](const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
        std::vector<glm::vec3> out(a.size());
        for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] - b[i];
        return out;
    };
    const view::Geometry& first = *track.part.geometry;
    const std::vector<glm::vec3> moves = differences(now.positions, first.positions);
    track.targetOf.push_back(++track.targetCount);
    if (options.isCompact) {
        for (const glm::vec3& move : moves)
            for (int axis = 0; axis < 3; ++axis) track.farthest = std::max(track.farthest, std::abs(move[axis]));
        track.moves.push_back(shapes.add(std::as_bytes(std::span(moves))));
        return;
    }
    std::string target = fmt::format(R"({{"POSITION":{})", data.addVectors(moves, true, view));
    if (options.normals)
        target += fmt::format(R"(,"NORMAL":{})", data.addVectors(differences(now.normals, first.normals), false, view));
    track.targets.add(target + "}");
}

// The moves of all targets as whole numbers of steps, in a form that packs well; movesIn() of film.js reads it. Of each
// number there are 16 bits of its change since the target before, less that of the vertex before, with the sign in the
// lowest bit: all low bytes of a target, then all high ones.
std::size_t GlbWriter::Impl::addMoves(const Track& track, float step) {
    const std::size_t count = 3 * track.part.geometry->positions.size();
    std::vector<float> moves(count);
    std::vector<std::uint16_t> before(count), changes(count);
    std::vector<std::byte> content;
    for (const ScratchFile::Piece& piece : track.moves) {
        auto to = std::as_writable_bytes(std::span(moves));
        shapes.visit(piece, [&](std::span<const std::byte> bytes) {
            std::copy(bytes.begin(), bytes.end(), to.begin());
            to = to.subspan(bytes.size());
        });
        const std::size_t low = content.size(), high = low + count;
        content.resize(high + count);
        for (std::size_t i = 0; i < count; ++i) {
            const auto now = static_cast<std::uint16_t>(std::lround(moves[i] / step));
            changes[i] = static_cast<std::uint16_t>(now - before[i]);
            before[i] = now;
            const int more = static_cast<std::int16_t>(changes[i] - (i < 3 ? 0 : changes[i - 3]));
            const auto kept = static_cast<std::uint16_t>(more < 0 ? -2 * more - 1 : 2 * more);
            content[low + i] = static_cast<std::byte>(kept & 255U);
            content[high + i] = static_cast<std::byte>(kept >> 8U);
        }
    }
    return data.addBytes(content);
}

void GlbWriter::Impl::checkSize() const {
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    // The JSON half, and weights: a number a key and target.
    const std::uint64_t rest = data.views.text().size() + data.accessors.text().size() +
                               4 * times.size() * times.size() + (std::uint64_t{1} << 20U);
    if (data.bytes.size() + shapes.size() / 2 + rest * 2 < most) return;
    throw core::Error(core::ErrorKind::badContent,
                      fmt::format("{}: more than 4 GB, the most that GLB holds, at {} frames: leave frames out with "
                                  "--every, take some of them with --frames or some bodies with --only, or write .usda",
                                  path.string(), times.size()));
}

std::string GlbWriter::Impl::texture(const view::Finish& finish) {
    if (finish.pattern != view::Pattern::image || finish.texture.empty()) return "";
    const std::string ending = endingOf(finish.texture);
    if (ending != ".png" && ending != ".jpg" && ending != ".jpeg") return "";
    const std::string content = core::filePartContent(finish.texture);
    const std::size_t view = data.addBytes(std::as_bytes(std::span(content)));
    const std::size_t image = images.add(
        fmt::format(R"({{"bufferView":{},"mimeType":"image/{}"}})", view, ending == ".png" ? "png" : "jpeg"));
    return fmt::format(R"(,"baseColorTexture":{{"index":{}}})", image);
}

std::size_t GlbWriter::Impl::material(const Part& part) {
    const auto [entry, isNew] = materialOf.try_emplace({part.finish, part.isTwoSided}, materials.count());
    if (!isNew) return entry->second;
    const view::Finish& finish = *part.finish;
    const std::string image = texture(finish);
    const glm::vec3 colour = image.empty() ? glm::clamp(finish.front, 0.0F, 1.0F) : glm::vec3(1.0F);
    return materials.add(fmt::format(
        R"({{"name":{},"doubleSided":{},"pbrMetallicRoughness":{{"baseColorFactor":[{},{},{},1],"metallicFactor":0,"roughnessFactor":{}{}}},"extras":{}}})",
        jsonText(part.identifier), part.isTwoSided, colour.x, colour.y, colour.z,
        std::clamp(finish.roughness, 0.0F, 1.0F), image, finishExtras(finish)));
}

// At each key one target counts whole, or none.
std::size_t GlbWriter::Impl::weights(const Track& track) {
    const auto [entry, isNew] = weightsOf.try_emplace(track.targetOf, 0);
    if (!isNew) return entry->second;
    std::vector<float> values(track.targetOf.size() * track.targetCount, 0.0F);
    for (std::size_t key = 0; key < track.targetOf.size(); ++key)
        if (track.targetOf[key] > 0) values[key * track.targetCount + track.targetOf[key] - 1] = 1.0F;
    return entry->second = data.addScalars(values, false);
}

void GlbWriter::Impl::animate(std::size_t node, const char* what, std::size_t output, const char* interpolation) {
    if (!timesAccessor) timesAccessor = data.addScalars(times, true);
    const std::size_t sampler = samplers.add(
        fmt::format(R"({{"input":{},"output":{},"interpolation":"{}"}})", *timesAccessor, output, interpolation));
    channels.add(fmt::format(R"({{"sampler":{},"target":{{"node":{},"path":"{}"}}}})", sampler, node, what));
}

std::string GlbWriter::Impl::pose(const std::vector<glm::mat4>& matrices, std::size_t node) {
    std::vector<glm::vec3> shifts;
    std::vector<glm::vec4> rotations;
    glm::quat q(1.0F, 0.0F, 0.0F, 0.0F);
    for (const glm::mat4& matrix : matrices) {
        q = rotationIn(matrix, q);
        shifts.emplace_back(matrix[3]);
        rotations.emplace_back(q.x, q.y, q.z, q.w);
    }
    if (!isConstant(shifts)) animate(node, "translation", data.addVectors(shifts), "LINEAR");
    if (!isConstant(rotations)) animate(node, "rotation", data.addVectors(rotations), "LINEAR");
    const glm::vec3 shift = shifts.front();
    const glm::vec4 turn = rotations.front();
    return fmt::format(R"("translation":[{},{},{}],"rotation":[{},{},{},{}])", shift.x, shift.y, shift.z, turn.x,
                       turn.y, turn.z, turn.w);
}

void GlbWriter::Impl::addNode(const Track& track) {
    const std::string name = jsonText(track.part.identifier);
    const std::size_t targets = track.targetCount;
    std::string morphs, more;
    if (targets > 0 && options.isCompact) {
        const float step = std::max(track.farthest, 1e-30F) / 32767.0F;  // [m]
        more = fmt::format(R"(,"extras":{{"taut":{{"step":{},"moves":{},"targetOf":[{}]}}}})", step,
                           addMoves(track, step), fmt::join(track.targetOf, ","));
    } else if (targets > 0) {
        morphs = ",\"targets\":[" + track.targets.text() + "]";
        for (std::size_t i = 0; i < targets; ++i) more += i > 0 ? ",0" : "0";
        more = ",\"weights\":[" + more + "]";  // the default, without which some readers fail
    }
    const std::size_t mesh =
        meshes.add(fmt::format(R"({{"name":{},"primitives":[{{"attributes":{{{}}},"indices":{},"material":{}{}}}]{}}})",
                               name, track.attributes, track.indices, material(track.part), morphs, more));
    const std::size_t node = nodes.count();
    if (targets > 0 && !options.isCompact) animate(node, "weights", weights(track), "LINEAR");
    const std::string placed = pose(track.transforms, node);
    if (!isConstant(track.isThere)) {
        std::vector<glm::vec3> scales;
        for (const bool isThere : track.isThere) scales.emplace_back(isThere ? 1.0F : 0.0F);
        animate(node, "scale", data.addVectors(scales), "STEP");
    }
    nodes.add(fmt::format(R"({{"name":{},"mesh":{},{}}})", name, mesh, placed));
}

// The fields of view::FrameView that glTF's scenes do not have. Of the camera there is one value a key, or one
// for all.
std::string GlbWriter::Impl::sceneExtras() const {
    const std::size_t keys = isConstant(cameraTargets) && isConstant(fieldsOfView) ? 1 : cameraTargets.size();
    JsonItems lookedAt, angles;
    for (std::size_t key = 0; key < keys; ++key) {
        lookedAt.add(vectorText(cameraTargets[key]));
        angles.add(fmt::format("{}", fieldsOfView[key]));
    }
    std::string text =
        fmt::format(R"({{"taut":{{"camera":{{"target":[{}],"fieldOfView":[{}]}})", lookedAt.text(), angles.text());
    text += fmt::format(R"(,"light":{{"direction":{},"colour":{},"sky":{},"ground":{},"softness":{}}})",
                        vectorText(light.direction), vectorText(light.colour), vectorText(light.sky),
                        vectorText(light.ground), light.softness);
    text += fmt::format(R"(,"background":{{"top":{},"horizon":{},"fadeStart":{},"fadeEnd":{},"fadesWithCamera":{}}})",
                        vectorText(background.top), vectorText(background.horizon), background.fadeStart,
                        background.fadeEnd, background.fadesWithCamera);
    if (ground)
        text += fmt::format(R"(,"ground":{{"height":{},"colour":{},"gridSpacing":{}}})", ground->height,
                            vectorText(ground->colour), ground->gridSpacing);
    if (options.isCompact) text += fmt::format(R"(,"times":[{}])", fmt::join(times, ","));
    return text + "}}";
}

std::string GlbWriter::Impl::json() {
    for (const Track& track : tracks) addNode(track);
    nodes.add(fmt::format(R"({{"name":"camera","camera":0,{}}})", pose(cameras, nodes.count())));
    JsonItems shining;
    for (const FarLight& one : lights) {
        const std::size_t number =
            shining.add(fmt::format(R"({{"type":"directional","name":{},"color":[{},{},{}],"intensity":{}}})",
                                    jsonText(one.name), one.colour.x, one.colour.y, one.colour.z, one.brightness));
        nodes.add(fmt::format(R"({{"name":{},"extensions":{{"KHR_lights_punctual":{{"light":{}}}}},{}}})",
                              jsonText(one.name), number, pose({one.pose}, nodes.count())));
    }
    std::string text = fmt::format(
        R"({{"asset":{{"version":"2.0","generator":{}}},"extensionsUsed":["KHR_lights_punctual"],"extensions":{{"KHR_lights_punctual":{{"lights":[{}]}}}},"scene":0,"scenes":[{{"nodes":[{}],"extras":{}}}],"nodes":[{}])",
        jsonText(options.generator), shining.text(), joinedNumbers(nodes.count()), sceneExtras(), nodes.text());
    text += fmt::format(
        R"(,"cameras":[{{"type":"perspective","perspective":{{"aspectRatio":{},"yfov":{},"znear":{},"zfar":{}}}}}])",
        options.aspect, verticalField(camera, static_cast<float>(options.aspect)), camera.nearPlane, camera.farPlane);
    const auto add = [&](const char* key, const JsonItems& items) {
        if (items.count() > 0) text += fmt::format(R"(,"{}":[{}])", key, items.text());
    };
    add("meshes", meshes);
    add("materials", materials);
    if (images.count() > 0) {
        add("images", images);
        JsonItems textures;
        for (std::size_t i = 0; i < images.count(); ++i) textures.add(fmt::format(R"({{"source":{}}})", i));
        add("textures", textures);
    }
    if (channels.count() > 0)
        text += fmt::format(R"(,"animations":[{{"name":"motion","channels":[{}],"samplers":[{}]}}])", channels.text(),
                            samplers.text());
    add("accessors", data.accessors);
    add("bufferViews", data.views);
    if (data.bytes.size() > 0) text += fmt::format(R"(,"buffers":[{{"byteLength":{}}}])", data.bytes.size());
    return text + "}";
}

GlbWriter::GlbWriter(const std::filesystem::path& path, GeometryOptions options)
    : impl_(std::make_unique<Impl>(path, std::move(options))) {}

GlbWriter::~GlbWriter() = default;

void GlbWriter::write(const view::FrameView& view) {
    Impl& w = *impl_;
    if (w.times.empty()) {
        w.start = view.time;
        w.camera = view.camera;
        w.lights = farLightsOf(view);
        w.light = view.light;
        w.background = view.background;
        if (!w.options.isWanted || w.options.isWanted("ground")) w.ground = view.ground;
    }
    w.times.push_back(static_cast<float>(view.time - w.start));
    w.cameraTargets.push_back(view.camera.target);
    w.fieldsOfView.push_back(view.camera.fieldOfView);
    w.cameras.push_back(looking(view.camera.eye, view.camera.target - view.camera.eye, view.camera.up));
    std::vector<std::pair<std::size_t, std::shared_ptr<const view::Geometry>>> moved;
    for (const Part& part : w.finder.partsOf(view)) {
        if (part.geometry->positions.empty()) continue;
        if (!w.trackOf.contains(part.identifier)) w.addTrack(part);
        const std::size_t number = w.trackOf.at(part.identifier);
        Impl::Track& track = w.tracks[number];
        if (track.part.topology != part.topology) throw TopologyChanged(w.path.string(), part.name, view.frame);
        if (part.geometry != track.last) {
            track.last = part.geometry;
            if (part.geometry == track.part.geometry)
                track.targetOf.push_back(0);
            else
                moved.emplace_back(number, part.geometry);
        } else {
            track.targetOf.push_back(track.targetOf.empty() ? 0 : track.targetOf.back());
        }
        track.transforms.push_back(part.transform);
        track.isThere.push_back(true);
    }
    if (!moved.empty()) {
        const std::size_t shared = w.data.openView();
        for (const auto& [number, geometry] : moved) w.addTarget(w.tracks[number], *geometry, shared);
        if (!w.options.isCompact) w.data.closeView(sizeof(glm::vec3));
    }
    for (Impl::Track& track : w.tracks)
        if (track.transforms.size() < w.times.size()) {
            track.targetOf.push_back(track.targetOf.back());
            track.transforms.push_back(track.transforms.back());
            track.isThere.push_back(false);
        }
    w.checkSize();
}

void GlbWriter::finish() {
    core::WholeFile file(impl_->path);
    finish([&](std::span<const std::byte> bytes) { file.write(bytes); });
    file.commit();
}

void GlbWriter::finish(const std::function<void(std::span<const std::byte>)>& take) {
    Impl& w = *impl_;
    TAUT_EXPECTS(!w.times.empty());
    std::string json = w.json();
    json.append((4 - json.size() % 4) % 4, ' ');
    const auto put = [&](std::initializer_list<std::uint64_t> values) {
        std::vector<std::uint32_t> words;
        for (const std::uint64_t value : values) words.push_back(static_cast<std::uint32_t>(value));
        take(std::as_bytes(std::span(words)));
    };
    constexpr std::uint64_t magic = 0x46546C67, jsonChunk = 0x4E4F534A, binaryChunk = 0x004E4942;
    const std::uint64_t binary = w.data.bytes.size();
    put({magic, 2, 12 + 8 + json.size() + (binary > 0 ? 8 + binary : 0), json.size(), jsonChunk});
    take(std::as_bytes(std::span(json)));
    if (binary > 0) {
        put({binary, binaryChunk});
        w.data.bytes.visit({0, binary}, take);
    }
    impl_.reset();
}

Format glbFormat() {
    Format format{.name = "GLB", .endings = {".glb"}, .readers = "the web, Blender, VTK"};
    format.makeSink = [](const std::filesystem::path& path, const GeometryOptions& options) {
        return std::make_unique<GlbWriter>(path, options);
    };
    format.mostKeys = GlbWriter::mostWebKeys;
    format.limitingReaders = "browsers";
    return format;
}

}  // namespace taut::geometry
