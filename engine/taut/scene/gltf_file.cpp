#include "taut/scene/private/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>  // tinygltf forgets it
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

#include "taut/core/error.h"
#include "taut/core/file_part.h"
#include "taut/core/private/base64.h"
#include "taut/core/private/hash.h"
#include "taut/core/whole_file.h"
#include "taut/figure/figure.h"

namespace taut::scene {

namespace {

using figure::Figure;
using glm::dmat4;
using world::dvec2;
using world::dvec3;

constexpr std::uint64_t maxFileSize = 256U << 20U;  // [bytes] of the file, and of each that it names
constexpr std::size_t maxElements = 5'000'000;      // of one accessor; vertices and corners of all parts
constexpr std::size_t maxNodes = 100'000;
constexpr double maxPlace = 1e12;
constexpr int maxDepth = 64;  // of arrays and objects in its text: tinygltf recurses
constexpr std::string_view embedded = "data:";

// Extensions that change nothing that is read here, so that a file may require them.
constexpr std::string_view harmless[] = {"KHR_mesh_quantization", "KHR_lights_punctual", "KHR_texture_transform",
                                         "KHR_materials_"};

// Numbers of an accessor, element after element.
struct Numbers {
    std::size_t width = 0;  // of an element
    std::vector<double> values;
    std::size_t count() const { return values.size() / width; }
    std::span<const double> operator[](std::size_t i) const { return std::span(values).subspan(i * width, width); }
    dvec3 place(std::size_t i) const { return {values[i * width], values[i * width + 1], values[i * width + 2]}; }
};

class GltfReader {
  public:
    GltfReader(const std::filesystem::path& path, const Confinement& confinement)
        : path_(path), confinement_(confinement), figure_(std::make_shared<Figure>()) {}

    world::MeshData read(std::string bytes) {
        parse(bytes);
        bytes = {};
        readNodes();
        for (const tinygltf::Skin& skin : model_.skins) readSkin(skin);
        for (std::size_t n = 0; n < model_.nodes.size(); ++n)
            if (isDrawn_[n] && model_.nodes[n].mesh >= 0) readPart(static_cast<int>(n));
        if (figure_->triangles.empty()) fail("there are no triangles");
        for (const tinygltf::Animation& animation : model_.animations) readAnimation(animation);
        tellWhatIsLeft();
        return finished();
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw core::Error(core::ErrorKind::badContent, core::at({path_.string()}) + message);
    }
    // Numbers in the file must name something.
    template <class T>
    const T& at(const std::vector<T>& all, int number, const char* what) const {
        if (number < 0 || static_cast<std::size_t>(number) >= all.size())
            fail(fmt::format("there is no {} {}: the file has {}", what, number, all.size()));
        return all[static_cast<std::size_t>(number)];
    }

    // ---- the file and those that it names ----

    void parse(std::string& bytes) {
        core::Hash hash;
        hash.add(bytes);
        tinygltf::TinyGLTF loader;
        if (bytes.starts_with("glTF") && bytes.size() > 28) {
            std::uint32_t length = 0, textLength = 0;
            std::memcpy(&length, bytes.data() + 8, sizeof length);
            std::memcpy(&textLength, bytes.data() + 12, sizeof textLength);
            binaryStart_ = std::size_t{28} + textLength;  // behind a head, the text, and the head of each chunk
            const std::size_t before = bytes.size();
            prepare(bytes, 20, std::min(before, std::size_t{20} + textLength));
            const auto lost = static_cast<std::uint32_t>(before - bytes.size());
            length -= lost;
            textLength -= lost;
            std::memcpy(bytes.data() + 8, &length, sizeof length);
            std::memcpy(bytes.data() + 12, &textLength, sizeof textLength);
        } else {
            prepare(bytes, 0, bytes.size());
        }
        loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int,
                                 void*) { return true; },
                              nullptr);
        loader.SetFsCallbacks(fileCallbacks<tinygltf::FsCallbacks>());
        std::string errors, warnings;
        const std::string folder = path_.parent_path().empty() ? "." : path_.parent_path().string();
        bool isRead = false;
        try {
            isRead = bytes.starts_with("glTF")
                         ? loader.LoadBinaryFromMemory(&model_, &errors, &warnings,
                                                       reinterpret_cast<const unsigned char*>(bytes.data()),
                                                       static_cast<unsigned>(bytes.size()), folder)
                         : loader.LoadASCIIFromString(&model_, &errors, &warnings, bytes.data(),
                                                      static_cast<unsigned>(bytes.size()), folder);
        } catch (const std::exception& error) {  // of its JSON reader
            errors += error.what();
        }
        // An extension may be why it could not be read.
        for (const std::string& extension : model_.extensionsRequired)
            if (std::none_of(std::begin(harmless), std::end(harmless),
                             [&](std::string_view known) { return extension.starts_with(known); }))
                fail(fmt::format("it cannot be read without {}: export it without that extension", extension));
        if (!isRead) {
            std::string why = errors.empty() ? warnings : errors;
            why.erase(std::find(why.begin(), why.end(), '\n'), why.end());
            fail(why.empty() ? "this is not a glTF file" : why);
        }
        if (!model_.asset.version.starts_with("2.")) fail("only glTF 2.0 is read");
        hash_ = hash;
    }

    // Refuses text from `first` to `last` that is nested too deep. Replaces its base64, which tinygltf would copy
    // several times, by names for takenAs(). The replaced length is a multiple of four.
    void prepare(std::string& bytes, std::size_t first, std::size_t last) {
        std::size_t kept = first;
        int depth = 0;
        for (std::size_t i = first, end = i; i < last; i = end) {
            end = i + 1;
            if (bytes[i] == '[' || bytes[i] == '{') ++depth;
            if (bytes[i] == ']' || bytes[i] == '}') --depth;
            if (depth > maxDepth) fail(fmt::format("its JSON is nested more than {} deep: export it again", maxDepth));
            std::string name;
            if (bytes[i] == '"') {
                while (end < last && bytes[end] != '"') end += bytes[end] == '\\' ? 2 : 1;
                end = std::min(end + 1, last);
                name = takenBase64(std::span(bytes).subspan(i, end - i));
            }
            const auto to = bytes.begin() + static_cast<std::ptrdiff_t>(kept);
            const std::string_view left = name.empty() ? std::string_view(bytes).substr(i, end - i) : name;
            std::copy(left.begin(), left.end(), to);
            kept += left.size();
        }
        while ((last - kept) % 4 != 0) bytes[kept++] = ' ';
        bytes.erase(kept, last - kept);
    }

    // A name in the place of a string, with its quotation marks, that holds base64; empty: it holds none.
    std::string takenBase64(std::span<char> string) {
        constexpr std::string_view mark = ";base64,";
        const std::string_view whole(string.data(), string.size());
        const std::size_t at = whole.substr(0, 100).find(mark);
        if (!whole.substr(1).starts_with(embedded) || at == std::string_view::npos || !whole.ends_with('"')) return "";
        const std::span<char> letters = string.subspan(at + mark.size(), whole.size() - at - mark.size() - 1);
        // JSON may write \/ for /.
        const auto length = std::remove(letters.begin(), letters.end(), '\\') - letters.begin();
        base64_.emplace_back();
        if (!core::fromBase64(whole.substr(at + mark.size(), static_cast<std::size_t>(length)), base64_.back()))
            fail("a data URI of it is not base64");
        return fmt::format("\"{}{}\"", embedded, base64_.size() - 1);
    }

    // The bytes for which takenBase64() gave this name in a folder; null: none.
    std::vector<unsigned char>* takenAs(const std::string& name) {
        const std::string file = std::filesystem::path(name).filename().string();
        std::size_t number = base64_.size();
        if (file.starts_with(embedded))
            std::from_chars(file.data() + embedded.size(), file.data() + file.size(), number);
        return number < base64_.size() ? &base64_[number] : nullptr;
    }

    // A template, so that `requires` finds the callback that tinygltf has only since 2.9.
    template <class Callbacks>
    Callbacks fileCallbacks() {
        Callbacks all{};
        all.FileExists = [](const std::string& name, void* self) {
            return static_cast<GltfReader*>(self)->takenAs(name) != nullptr || core::isThere(name);
        };
        all.ExpandFilePath = [](const std::string& name, void*) { return name; };
        all.ReadWholeFile = [](std::vector<unsigned char>* content, std::string* error, const std::string& name,
                               void* self) {
            return static_cast<GltfReader*>(self)->readNamed(name, *content, *error);
        };
        all.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
            return false;
        };
        if constexpr (requires { all.GetFileSizeInBytes; })
            all.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string&, void*) {
                *size = 0;  // readNamed() reports files that are too large
                return true;
            };
        all.user_data = this;
        return all;
    }

    bool readNamed(const std::string& name, std::vector<unsigned char>& content, std::string& error) {
        try {
            if (std::vector<unsigned char>* bytes = takenAs(name); bytes != nullptr) {
                content.swap(*bytes);
                return true;
            }
            if (!confinement_.allows(name)) {
                error += outsideMessage(name);
                return false;
            }
            const std::string bytes = core::fileContent(name, maxFileSize);
            hash_.add(bytes);
            content.assign(bytes.begin(), bytes.end());
            mesh_.files.push_back(name);
            return true;
        } catch (const core::Error& fault) {
            error += fault.what();
            return false;
        }
    }

    // ---- numbers ----

    std::span<const unsigned char> viewed(int number) const {
        const tinygltf::BufferView& view = at(model_.bufferViews, number, "bufferView");
        const std::vector<unsigned char>& bytes = at(model_.buffers, view.buffer, "buffer").data;
        if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset)
            fail(fmt::format("bufferView {} leaves buffer {}", number, view.buffer));
        return std::span(bytes).subspan(view.byteOffset, view.byteLength);
    }

    // Elements of `width` components from `offset` of a view on, `stride` bytes apart (0: without gaps).
    template <class Take>
    void unpack(std::span<const unsigned char> bytes, std::size_t offset, std::size_t stride, std::size_t count,
                std::size_t width, int type, bool isNormalised, const Take& take) const {
        const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
        if (size <= 0) fail(fmt::format("there is no component type {}", type));
        const auto bytesOfOne = static_cast<std::size_t>(size);
        if (stride == 0) stride = bytesOfOne * width;
        const std::size_t element = bytesOfOne * width;
        if (count > 0 && (offset > bytes.size() || element > bytes.size() - offset ||
                          (count - 1) > (bytes.size() - offset - element) / stride))
            fail("an accessor leaves its bufferView");
        const auto value = [&]<class T>(const unsigned char* from, T, double most) {
            T number;
            std::memcpy(&number, from, sizeof number);
            const double v = static_cast<double>(number);
            return isNormalised && most > 0 ? std::max(v / most, -1.0) : v;
        };
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < width; ++k) {
                const unsigned char* from = bytes.data() + offset + i * stride + k * bytesOfOne;
                double v = 0;
                switch (type) {
                    case TINYGLTF_COMPONENT_TYPE_BYTE: v = value(from, std::int8_t{}, 127.0); break;
                    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: v = value(from, std::uint8_t{}, 255.0); break;
                    case TINYGLTF_COMPONENT_TYPE_SHORT: v = value(from, std::int16_t{}, 32767.0); break;
                    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: v = value(from, std::uint16_t{}, 65535.0); break;
                    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: v = value(from, std::uint32_t{}, 0.0); break;
                    case TINYGLTF_COMPONENT_TYPE_FLOAT: v = value(from, float{}, 0.0); break;
                    default: fail(fmt::format("there is no component type {}", type));
                }
                if (!(std::abs(v) <= maxPlace)) fail("an accessor holds a number that is not finite");
                take(i, k, v);
            }
    }

    // Expects elements of so many components.
    Numbers numbers(int accessorNumber, std::size_t width, const char* what) const {
        const tinygltf::Accessor& accessor = at(model_.accessors, accessorNumber, "accessor");
        const int own = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
        if (own != static_cast<int>(width))
            fail(fmt::format("accessor {}: {} needs {} numbers an element", accessorNumber, what, width));
        if (accessor.count > maxElements)
            fail(fmt::format("accessor {} has {} elements; {} at most", accessorNumber, accessor.count, maxElements));
        Numbers all{width, std::vector<double>(accessor.count * width)};
        const auto store = [&](std::size_t i, std::size_t k, double v) { all.values[i * width + k] = v; };
        if (accessor.bufferView >= 0) {
            const std::size_t stride = at(model_.bufferViews, accessor.bufferView, "bufferView").byteStride;
            unpack(viewed(accessor.bufferView), accessor.byteOffset, stride, accessor.count, width,
                   accessor.componentType, accessor.normalized, store);
        }
        if (!accessor.sparse.isSparse) return all;
        const auto& sparse = accessor.sparse;
        // Offsets are signed in older versions of tinygltf.
        if (!std::in_range<std::size_t>(sparse.count) || static_cast<std::size_t>(sparse.count) > accessor.count ||
            !std::in_range<std::size_t>(sparse.indices.byteOffset) ||
            !std::in_range<std::size_t>(sparse.values.byteOffset))
            fail(fmt::format("accessor {} replaces {} of {} elements", accessorNumber, sparse.count, accessor.count));
        const auto count = static_cast<std::size_t>(sparse.count);
        std::vector<std::size_t> places(count);
        unpack(
            viewed(sparse.indices.bufferView), static_cast<std::size_t>(sparse.indices.byteOffset), 0, count, 1,
            sparse.indices.componentType, false,
            [&](std::size_t i, std::size_t, double v) {
                if (!(v >= 0 && v < static_cast<double>(accessor.count)))
                    fail(fmt::format("accessor {} replaces an element that it has not", accessorNumber));
                places[i] = static_cast<std::size_t>(v);
            });
        unpack(viewed(sparse.values.bufferView), static_cast<std::size_t>(sparse.values.byteOffset), 0, count, width,
               accessor.componentType, accessor.normalized,
               [&](std::size_t i, std::size_t k, double v) { store(places[i], k, v); });
        return all;
    }

    // ---- nodes, skins, animations ----

    // Parents before their children. Nodes outside of the scene are read, since joints may be there, but not drawn.
    void readNodes() {
        const std::size_t count = model_.nodes.size();
        if (count > maxNodes) fail(fmt::format("{} nodes; {} at most", count, maxNodes));
        std::vector<int> parent(count, -1);
        for (std::size_t n = 0; n < count; ++n)
            for (const int child : model_.nodes[n].children) {
                at(model_.nodes, child, "node");
                if (parent[static_cast<std::size_t>(child)] >= 0) fail(fmt::format("node {} has two parents", child));
                parent[static_cast<std::size_t>(child)] = static_cast<int>(n);
            }
        isDrawn_.assign(count, model_.scenes.empty());
        if (!model_.scenes.empty())
            for (const int root : at(model_.scenes, std::max(0, model_.defaultScene), "scene").nodes) {
                at(model_.nodes, root, "node");
                isDrawn_[static_cast<std::size_t>(root)] = true;
            }
        numberOf_.assign(count, -1);
        std::vector<int> order;
        for (std::size_t n = 0; n < count; ++n)
            if (parent[n] < 0) order.push_back(static_cast<int>(n));
        for (std::size_t next = 0; next < order.size(); ++next)
            for (const int child : model_.nodes[static_cast<std::size_t>(order[next])].children) order.push_back(child);
        if (order.size() < count) fail("nodes are parents of their parents");
        for (const int number : order) {
            const auto n = static_cast<std::size_t>(number);
            const tinygltf::Node& from = model_.nodes[n];
            figure::Node node;
            node.name = from.name;
            if (parent[n] >= 0) {
                node.parent = numberOf_[static_cast<std::size_t>(parent[n])];
                isDrawn_[n] = isDrawn_[n] || isDrawn_[static_cast<std::size_t>(parent[n])];
            }
            for (const auto* list : {&from.translation, &from.rotation, &from.scale, &from.matrix, &from.weights})
                for (const double v : *list)
                    if (!(std::abs(v) <= maxPlace))
                        fail(fmt::format("node {} has a number that is not finite", number));
            const auto sized = [&](const std::vector<double>& list, std::size_t size) {
                if (!list.empty() && list.size() != size)
                    fail(fmt::format("node {} has {} numbers where {} belong", number, list.size(), size));
                return !list.empty();
            };
            if (sized(from.translation, 3)) node.translation = glm::make_vec3(from.translation.data());
            if (sized(from.scale, 3)) node.scale = glm::make_vec3(from.scale.data());
            if (sized(from.matrix, 16)) node.matrix = glm::make_mat4(from.matrix.data());
            if (sized(from.rotation, 4)) {
                const glm::dquat q(from.rotation[3], from.rotation[0], from.rotation[1], from.rotation[2]);
                if (!(glm::dot(q, q) > 0)) fail(fmt::format("node {} has no rotation", number));
                node.rotation = glm::normalize(q);
            }
            node.weights = from.weights;
            numberOf_[n] = static_cast<int>(figure_->nodes.size());
            figure_->nodes.push_back(std::move(node));
        }
    }

    void readSkin(const tinygltf::Skin& from) {
        figure::Skin skin;
        for (const int joint : from.joints) {
            at(model_.nodes, joint, "node");
            skin.joints.push_back(numberOf_[static_cast<std::size_t>(joint)]);
        }
        skin.inverseBind.assign(skin.joints.size(), dmat4(1.0));
        if (from.inverseBindMatrices >= 0) {
            const Numbers matrices = numbers(from.inverseBindMatrices, 16, "an inverse bind matrix");
            if (matrices.count() < skin.joints.size()) fail("a skin has fewer matrices than joints");
            for (std::size_t j = 0; j < skin.joints.size(); ++j)
                skin.inverseBind[j] = glm::make_mat4(matrices[j].data());
        }
        figure_->skins.push_back(std::move(skin));
    }

    void readAnimation(const tinygltf::Animation& from) {
        static const std::map<std::string, figure::Path> paths{{"translation", figure::Path::translation},
                                                               {"rotation", figure::Path::rotation},
                                                               {"scale", figure::Path::scale},
                                                               {"weights", figure::Path::weights}};
        static const std::map<std::string, figure::Interpolation> ways{{"", figure::Interpolation::linear},
                                                                       {"LINEAR", figure::Interpolation::linear},
                                                                       {"STEP", figure::Interpolation::step},
                                                                       {"CUBICSPLINE", figure::Interpolation::cubic}};
        figure::Animation animation;
        animation.name = from.name.empty() ? std::to_string(figure_->animations.size()) : from.name;
        for (const tinygltf::AnimationChannel& of : from.channels) {
            const auto path = paths.find(of.target_path);
            if (path == paths.end() || of.target_node < 0) {
                note(fmt::format("animation \"{}\" moves \"{}\"", animation.name, of.target_path));
                continue;
            }
            const tinygltf::AnimationSampler& sampler = at(from.samplers, of.sampler, "sampler");
            const auto way = ways.find(sampler.interpolation);
            if (way == ways.end()) fail(fmt::format("there is no interpolation \"{}\"", sampler.interpolation));
            at(model_.nodes, of.target_node, "node");
            figure::Channel channel;
            channel.node = numberOf_[static_cast<std::size_t>(of.target_node)];
            channel.path = path->second;
            channel.interpolation = way->second;
            figure::Node& node = figure_->nodes[static_cast<std::size_t>(channel.node)];
            if (node.matrix) fail(fmt::format("animation \"{}\" moves a node that has a matrix", animation.name));
            const std::size_t width = channel.path == figure::Path::weights    ? node.weights.size()
                                      : channel.path == figure::Path::rotation ? 4
                                                                               : 3;
            channel.times = numbers(sampler.input, 1, "a time").values;
            const bool isScalar = channel.path == figure::Path::weights;
            channel.values = numbers(sampler.output, isScalar ? 1 : width, "a key").values;
            const std::size_t perKey = width * (channel.interpolation == figure::Interpolation::cubic ? 3 : 1);
            if (width == 0 || channel.times.empty() || channel.values.size() != channel.times.size() * perKey)
                fail(fmt::format("animation \"{}\" has {} times and {} numbers for {} of \"{}\"", animation.name,
                                 channel.times.size(), channel.values.size(), of.target_path, node.name));
            for (std::size_t k = 1; k < channel.times.size(); ++k)
                if (!(channel.times[k] > channel.times[k - 1]))
                    fail(fmt::format("animation \"{}\": times do not ascend", animation.name));
            animation.seconds = std::max(animation.seconds, channel.times.back());
            animation.channels.push_back(std::move(channel));
        }
        figure_->animations.push_back(std::move(animation));
    }

    // ---- meshes ----

    // A vertex of the figure for each place of the part's vertices.
    struct Weld {
        std::map<std::tuple<double, double, double>, int> known;
        int first;  // vertex of the part
    };

    void readPart(int nodeNumber) {
        const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(nodeNumber)];
        const tinygltf::Mesh& mesh = at(model_.meshes, node.mesh, "mesh");
        figure::Part part;
        part.node = numberOf_[static_cast<std::size_t>(nodeNumber)];
        if (node.skin >= 0) {
            at(figure_->skins, node.skin, "skin");
            part.skin = node.skin;
            part.firstInfluence = {0};
        }
        Weld weld{{}, vertices_};
        for (const tinygltf::Primitive& primitive : mesh.primitives) readPrimitive(primitive, mesh.name, weld, part);
        std::vector<double>& weights = figure_->nodes[static_cast<std::size_t>(part.node)].weights;
        if (weights.empty()) weights = mesh.weights;
        weights.resize(part.targets.size());
        if (part.positions.empty()) return;
        vertices_ += static_cast<int>(part.positions.size());
        figure_->parts.push_back(std::move(part));
    }

    void readPrimitive(const tinygltf::Primitive& from, const std::string& name, Weld& weld, figure::Part& part) {
        const bool isList = from.mode < 0 || from.mode == TINYGLTF_MODE_TRIANGLES;
        if (!isList && from.mode != TINYGLTF_MODE_TRIANGLE_STRIP && from.mode != TINYGLTF_MODE_TRIANGLE_FAN)
            return note(fmt::format("points or lines of mesh \"{}\"", name));
        const auto attribute = [&](const std::string& key) {
            const auto found = from.attributes.find(key);
            return found != from.attributes.end() ? found->second : -1;
        };
        if (attribute("POSITION") < 0) return note(fmt::format("a part of mesh \"{}\" without positions", name));
        const Numbers positions = numbers(attribute("POSITION"), 3, "POSITION");
        const auto optional = [&](const char* key, std::size_t width) {
            Numbers read{width, {}};
            if (attribute(key) >= 0) read = numbers(attribute(key), width, key);
            if (!read.values.empty() && read.count() != positions.count())
                fail(fmt::format("mesh \"{}\" has {} of {} for {} of POSITION", name, read.count(), key,
                                 positions.count()));
            return read;
        };
        const Numbers normals = optional("NORMAL", 3), uv = optional("TEXCOORD_0", 2);
        const std::size_t before = part.positions.size();
        const std::vector<int> vertexOf = weldVertices(positions, weld, part);
        readTargets(from, positions.count(), vertexOf, weld, before, part);
        if (part.skin >= 0) readInfluences(attribute, optional, name, vertexOf, weld, before, part);

        // Corners of triangles.
        std::vector<std::size_t> corners;
        if (from.indices >= 0) {
            for (const double v : numbers(from.indices, 1, "an index").values) {
                if (!(v >= 0 && v < static_cast<double>(positions.count())))
                    fail(fmt::format("mesh \"{}\" has no vertex {}: there are {}", name, v, positions.count()));
                corners.push_back(static_cast<std::size_t>(v));
            }
        } else {
            for (std::size_t i = 0; i < positions.count(); ++i) corners.push_back(i);
        }
        drawn_ += corners.size();
        if (drawn_ > maxElements) fail(fmt::format("more than {} corners of triangles", maxElements));
        std::vector<std::array<std::size_t, 3>> triangles;
        if (isList) {
            if (corners.size() % 3 != 0)
                fail(fmt::format("mesh \"{}\" has {} corners of triangles", name, corners.size()));
            for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
                triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
        } else {
            const bool isFan = from.mode == TINYGLTF_MODE_TRIANGLE_FAN;
            for (std::size_t i = 0; i + 2 < corners.size(); ++i)
                triangles.push_back({corners[isFan ? 0 : i], corners[i + 1 + (isFan ? 0 : i % 2)],
                                     corners[i + 2 - (isFan ? 0 : i % 2)]});
        }
        addPiece(from.material, triangles, vertexOf, normals, uv);
    }

    std::vector<int> weldVertices(const Numbers& positions, Weld& weld, figure::Part& part) const {
        std::vector<int> vertexOf;
        for (std::size_t i = 0; i < positions.count(); ++i) {
            const dvec3 p = positions.place(i) + dvec3(0.0);  // -0 becomes +0
            const auto [found, isNew] =
                weld.known.try_emplace({p.x, p.y, p.z}, weld.first + static_cast<int>(part.positions.size()));
            if (isNew) part.positions.push_back(p);
            vertexOf.push_back(found->second);
        }
        return vertexOf;
    }

    // Each new vertex of the part takes what the first of those merged into it has.
    template <class Take>
    static void eachNew(const std::vector<int>& vertexOf, const Weld& weld, std::size_t before, const Take& take) {
        std::size_t next = before;
        for (std::size_t i = 0; i < vertexOf.size(); ++i) {
            const auto own = static_cast<std::size_t>(vertexOf[i] - weld.first);
            if (own == next) {
                take(own, i);
                ++next;
            }
        }
    }

    void readTargets(const tinygltf::Primitive& from, std::size_t count, const std::vector<int>& vertexOf,
                     const Weld& weld, std::size_t before, figure::Part& part) const {
        if (part.targets.size() < from.targets.size()) part.targets.resize(from.targets.size());
        for (std::size_t t = 0; t < part.targets.size(); ++t) {
            part.targets[t].resize(part.positions.size(), dvec3(0.0));
            if (t >= from.targets.size()) continue;
            const auto found = from.targets[t].find("POSITION");
            if (found == from.targets[t].end()) continue;
            const Numbers moves = numbers(found->second, 3, "a morph target");
            if (moves.count() != count) fail("a morph target has another number of vertices than its mesh");
            eachNew(vertexOf, weld, before,
                    [&](std::size_t own, std::size_t i) { part.targets[t][own] = moves.place(i); });
        }
    }

    template <class Attribute, class Optional>
    void readInfluences(const Attribute& attribute, const Optional& optional, const std::string& name,
                        const std::vector<int>& vertexOf, const Weld& weld, std::size_t before, figure::Part& part) {
        std::vector<Numbers> joints, weights;
        for (int set = 0; attribute(fmt::format("JOINTS_{}", set)) >= 0; ++set) {
            joints.push_back(optional(fmt::format("JOINTS_{}", set).c_str(), 4));
            weights.push_back(optional(fmt::format("WEIGHTS_{}", set).c_str(), 4));
            if (weights.back().values.empty()) fail(fmt::format("mesh \"{}\" has JOINTS without WEIGHTS", name));
        }
        if (joints.empty()) fail(fmt::format("mesh \"{}\" has a skin but no JOINTS_0", name));
        const std::size_t jointCount = figure_->skins[static_cast<std::size_t>(part.skin)].joints.size();
        eachNew(vertexOf, weld, before, [&](std::size_t, std::size_t i) {
            const std::size_t first = part.influences.size();
            double sum = 0;
            for (std::size_t set = 0; set < joints.size(); ++set)
                for (std::size_t k = 0; k < 4; ++k) {
                    const double joint = joints[set][i][k], weight = weights[set][i][k];
                    if (!(weight > 0)) continue;
                    if (!(joint >= 0 && joint < static_cast<double>(jointCount)))
                        fail(fmt::format("mesh \"{}\" follows joint {}: its skin has {}", name, joint, jointCount));
                    part.influences.push_back({static_cast<int>(joint), weight});
                    sum += weight;
                }
            if (part.influences.size() == first)
                fail(fmt::format("mesh \"{}\" has a vertex that follows no joint", name));
            for (std::size_t k = first; k < part.influences.size(); ++k) part.influences[k].weight /= sum;
            part.firstInfluence.push_back(part.influences.size());
        });
    }

    // Drawn vertices are those that differ in place, normal or texture coordinates.
    void addPiece(int material, const std::vector<std::array<std::size_t, 3>>& triangles,
                  const std::vector<int>& vertexOf, const Numbers& normals, const Numbers& uv) {
        figure::Piece piece;
        readMaterial(material, piece);
        std::vector<int> smoothOf(vertexOf.size()), drawnOf(vertexOf.size(), -1);
        std::map<std::tuple<int, double, double, double>, int> smooth;
        for (std::size_t i = 0; i < vertexOf.size(); ++i) {
            const dvec3 n = normals.values.empty() ? dvec3(0.0) : normals.place(i);
            smoothOf[i] =
                smooth.try_emplace({vertexOf[i], n.x, n.y, n.z}, figure_->smoothCount + static_cast<int>(smooth.size()))
                    .first->second;
        }
        figure_->smoothCount += static_cast<int>(smooth.size());
        for (const std::array<std::size_t, 3>& corners : triangles) {
            const std::array<int, 3> t{vertexOf[corners[0]], vertexOf[corners[1]], vertexOf[corners[2]]};
            if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
                ++degenerate_;
                continue;
            }
            figure_->triangles.push_back(t);
            std::array<dvec2, 3> cornerUv{};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t i = corners[k];
                // glTF's texture coordinates begin at the upper left.
                if (!uv.values.empty()) cornerUv[k] = {uv[i][0], 1.0 - uv[i][1]};
                if (drawnOf[i] < 0) {
                    drawnOf[i] = static_cast<int>(piece.vertices.size());
                    piece.vertices.push_back(vertexOf[i]);
                    piece.smooth.push_back(smoothOf[i]);
                    piece.uv.emplace_back(cornerUv[k]);
                }
                piece.triangles.push_back(static_cast<std::uint32_t>(drawnOf[i]));
            }
            mesh_.cornerUv.push_back(cornerUv);
        }
        hasUv_ = hasUv_ && !uv.values.empty();
        if (!piece.triangles.empty()) figure_->pieces.push_back(std::move(piece));
    }

    void readMaterial(int number, figure::Piece& piece) {
        if (number < 0) return;
        const tinygltf::Material& material = at(model_.materials, number, "material");
        const tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
        if (pbr.baseColorFactor.size() == 4) piece.colour = glm::make_vec3(pbr.baseColorFactor.data());
        piece.colour = glm::clamp(piece.colour, 0.0, 1.0);
        piece.roughness = std::clamp(pbr.roughnessFactor, 0.0, 1.0);
        if (pbr.baseColorTexture.index < 0) return;
        const int source = at(model_.textures, pbr.baseColorTexture.index, "texture").source;
        if (source < 0) return;
        const tinygltf::Image& image = at(model_.images, source, "image");
        if (image.bufferView < 0 && !image.uri.empty() && !image.uri.starts_with(embedded)) {
            piece.texture = (path_.parent_path() / tinygltf::dlib::urldecode(image.uri)).string();
            return;
        }
        if (image.bufferView >= 0 && binaryStart_ > 0) {
            const tinygltf::BufferView& view = at(model_.bufferViews, image.bufferView, "bufferView");
            if (view.buffer == 0) {
                piece.texture =
                    core::filePartName(path_, binaryStart_ + view.byteOffset, viewed(image.bufferView).size(),
                                       image.mimeType == "image/png" ? ".png" : ".jpg");
                return;
            }
        }
        note("pictures in its text or in its buffers");
    }

    // ---- the end ----

    void note(const std::string& what) { notes_.insert(what); }

    void tellWhatIsLeft() {
        if (!model_.cameras.empty()) note(fmt::format("{} camera(s)", model_.cameras.size()));
        if (!model_.lights.empty()) note(fmt::format("{} light(s)", model_.lights.size()));
        for (const std::string& extension : model_.extensionsUsed)
            if (extension != "KHR_mesh_quantization") note(extension);
        if (degenerate_ > 0) note(fmt::format("{} triangle(s) without area", degenerate_));
        mesh_.notes.assign(notes_.begin(), notes_.end());
    }

    world::MeshData finished() {
        mesh_.positions.resize(static_cast<std::size_t>(vertices_));
        figure::placeVertices(*figure_, figure::postureAt(*figure_, nullptr, 0.0), mesh_.positions);
        mesh_.triangles = figure_->triangles;
        if (!hasUv_) mesh_.cornerUv.clear();
        if (hasUv_) {
            mesh_.uv.resize(mesh_.positions.size());
            for (std::size_t t = mesh_.triangles.size(); t-- > 0;)
                for (std::size_t k = 0; k < 3; ++k)
                    mesh_.uv[static_cast<std::size_t>(mesh_.triangles[t][k])] = mesh_.cornerUv[t][k];
        }
        for (int i = 0; i < vertices_; ++i) mesh_.numbers.push_back(i + 1);
        mesh_.figure = figure_;
        mesh_.hash = hash_.value();
        return std::move(mesh_);
    }

    std::filesystem::path path_;
    const Confinement& confinement_;
    tinygltf::Model model_;
    core::Hash hash_;
    std::vector<std::vector<unsigned char>> base64_;  // in the order of the text
    std::size_t binaryStart_ = 0;                     // of a GLB: where in the file its buffer begins
    std::shared_ptr<Figure> figure_;
    world::MeshData mesh_;
    std::vector<bool> isDrawn_;  // (nodes of the file) in its scene
    std::vector<int> numberOf_;  // (nodes of the file) in the figure
    int vertices_ = 0;
    std::size_t drawn_ = 0;
    int degenerate_ = 0;
    bool hasUv_ = true;
    std::set<std::string> notes_;
};

}  // namespace

world::MeshData gltfMesh(const std::filesystem::path& path, const Confinement& confinement) {
    return gltfMeshText(core::fileContent(path, maxFileSize), path, confinement);
}

world::MeshData gltfMeshText(std::string bytes, const std::filesystem::path& path, const Confinement& confinement) {
    return GltfReader(path, confinement).read(std::move(bytes));
}

}  // namespace taut::scene
