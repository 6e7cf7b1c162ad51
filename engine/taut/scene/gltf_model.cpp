#include "taut/scene/private/gltf_model.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>

#include "taut/core/error.h"
#include "taut/core/file_part.h"
#include "taut/core/private/base64.h"
#include "taut/core/whole_file.h"

namespace taut::scene {

namespace {

constexpr int maxDepth = 64;  // of arrays and objects in its text: tinygltf recurses
constexpr std::string_view embedded = "data:";

// Extensions that change nothing that is read here, so that a file may require them.
constexpr std::string_view harmless[] = {"KHR_mesh_quantization", "KHR_lights_punctual", "KHR_texture_transform",
                                         "KHR_materials_"};

}  // namespace

GltfModel::GltfModel(std::string bytes, std::filesystem::path path, const Confinement& confinement)
    : path_(std::move(path)), confinement_(confinement) {
    parse(bytes);
}

void GltfModel::fail(const std::string& message) const {
    throw core::Error(core::ErrorKind::badContent, core::at({path_.string()}) + message);
}

// ---- the file and the files that it names ----

// A template, so that `requires` finds the callback that tinygltf has only since 2.9.
template <class Callbacks>
Callbacks GltfModel::fileCallbacks() {
    Callbacks all{};
    all.FileExists = [](const std::string& name, void* self) {
        return static_cast<GltfModel*>(self)->takenAs(name) != nullptr || core::isThere(name);
    };
    all.ExpandFilePath = [](const std::string& name, void*) { return name; };
    all.ReadWholeFile = [](std::vector<unsigned char>* content, std::string* error, const std::string& name,
                           void* self) { return static_cast<GltfModel*>(self)->readNamed(name, *content, *error); };
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

void GltfModel::parse(std::string& bytes) {
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
        for (const std::string_view packed : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"})
            if (bytes.find(packed) != std::string::npos)  // tinygltf stops before the extensions that are only used
                fail(fmt::format("it cannot be read without {}: export it without that extension", packed));
        std::string why = errors.empty() ? warnings : errors;
        why.erase(std::find(why.begin(), why.end(), '\n'), why.end());
        fail(why.empty() ? "this is not a glTF file" : why);
    }
    if (!model_.asset.version.starts_with("2.")) fail("only glTF 2.0 is read");
    hash_ = hash;
}

// Refuses text from `first` to `last` that is nested too deep. Replaces its base64, which tinygltf would copy
// several times, by names for takenAs(). The replaced length is a multiple of four.
void GltfModel::prepare(std::string& bytes, std::size_t first, std::size_t last) {
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
std::string GltfModel::takenBase64(std::span<char> string) {
    constexpr std::string_view mark = ";base64,";
    const std::string_view whole(string.data(), string.size());
    const std::size_t at = whole.substr(0, 100).find(mark);
    if (!whole.substr(1).starts_with(embedded) || at == std::string_view::npos || !whole.ends_with('"')) return "";
    const std::span<char> letters = string.subspan(at + mark.size(), whole.size() - at - mark.size() - 1);
    // JSON may write \/ for /.
    const auto length = std::remove(letters.begin(), letters.end(), '\\') - letters.begin();
    base64_.emplace_back();
    if (!core::fromBase64(whole.substr(at + mark.size(), length), base64_.back()))
        fail("a data URI of it is not base64");
    return fmt::format("\"{}{}\"", embedded, base64_.size() - 1);
}

// The bytes for which takenBase64() gave this name in a folder; null: none.
std::vector<unsigned char>* GltfModel::takenAs(const std::string& name) {
    const std::string file = std::filesystem::path(name).filename().string();
    std::size_t number = base64_.size();
    if (file.starts_with(embedded)) std::from_chars(file.data() + embedded.size(), file.data() + file.size(), number);
    return number < base64_.size() ? &base64_[number] : nullptr;
}

bool GltfModel::readNamed(const std::string& name, std::vector<unsigned char>& content, std::string& error) {
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
        files_.push_back(name);
        return true;
    } catch (const core::Error& fault) {
        error += fault.what();
        return false;
    }
}

std::string GltfModel::pictureFile(const tinygltf::Image& image) const {
    if (image.bufferView < 0 && !image.uri.empty() && !image.uri.starts_with(embedded))
        return (path_.parent_path() / tinygltf::dlib::urldecode(image.uri)).string();
    if (image.bufferView < 0 || binaryStart_ == 0) return "";
    const tinygltf::BufferView& view = at(model_.bufferViews, image.bufferView, "bufferView");
    if (view.buffer != 0) return "";
    return core::filePartName(path_, binaryStart_ + view.byteOffset, viewed(image.bufferView).size(),
                              image.mimeType == "image/png" ? ".png" : ".jpg");
}

// ---- numbers ----

std::span<const unsigned char> GltfModel::viewed(int number) const {
    const tinygltf::BufferView& view = at(model_.bufferViews, number, "bufferView");
    const std::vector<unsigned char>& bytes = at(model_.buffers, view.buffer, "buffer").data;
    if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset)
        fail(fmt::format("bufferView {} leaves buffer {}", number, view.buffer));
    return std::span(bytes).subspan(view.byteOffset, view.byteLength);
}

// Elements of `width` components from `offset` of a view on, `stride` bytes apart (0: without gaps).
template <class Take>
void GltfModel::unpack(std::span<const unsigned char> bytes, std::size_t offset, std::size_t stride, std::size_t count,
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

GltfNumbers GltfModel::numbers(int accessorNumber, std::size_t width, const char* what) const {
    const tinygltf::Accessor& accessor = at(model_.accessors, accessorNumber, "accessor");
    const int own = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (own != static_cast<int>(width))
        fail(fmt::format("accessor {}: {} needs {} numbers an element", accessorNumber, what, width));
    if (accessor.count > maxElements)
        fail(fmt::format("accessor {} has {} elements; {} at most", accessorNumber, accessor.count, maxElements));
    GltfNumbers all{width, std::vector<double>(accessor.count * width)};
    const auto store = [&](std::size_t i, std::size_t k, double v) { all.values[i * width + k] = v; };
    if (accessor.bufferView >= 0) {
        const std::size_t stride = at(model_.bufferViews, accessor.bufferView, "bufferView").byteStride;
        unpack(viewed(accessor.bufferView), accessor.byteOffset, stride, accessor.count, width, accessor.componentType,
               accessor.normalized, store);
    }
    if (!accessor.sparse.isSparse) return all;
    const auto& sparse = accessor.sparse;
    // Offsets are signed in older versions of tinygltf.
    if (!std::in_range<std::size_t>(sparse.count) || static_cast<std::size_t>(sparse.count) > accessor.count ||
        !std::in_range<std::size_t>(sparse.indices.byteOffset) || !std::in_range<std::size_t>(sparse.values.byteOffset))
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

}  // namespace taut::scene
