#include "taut/geometry/private/gltf_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace taut::geometry {
namespace {

constexpr int componentUnsigned = 5125, componentFloat = 5126;
constexpr int targetVertices = 34962, targetIndices = 34963;

// glTF is little-endian, as is every processor that this is compiled for.
template <class T>
std::span<const std::byte> bytesOf(std::span<const T> values) {
    return std::as_bytes(values);
}

std::string boundsOf(std::span<const glm::vec3> values) {
    glm::vec3 least = values.front(), most = values.front();
    for (const glm::vec3& value : values) {
        least = glm::min(least, value);
        most = glm::max(most, value);
    }
    return fmt::format(R"(,"min":[{},{},{}],"max":[{},{},{}])", least.x, least.y, least.z, most.x, most.y, most.z);
}

}  // namespace

std::string jsonText(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        if (static_cast<unsigned char>(c) < 0x20)
            out += fmt::format("\\u{:04x}", static_cast<int>(c));
        else
            out += c;
    }
    return out + '"';
}

std::size_t JsonItems::add(std::string_view item) {
    if (count_ > 0) text_ += ',';
    text_ += item;
    return count_++;
}

std::size_t GltfData::addView(std::span<const std::byte> content, std::string_view more) {
    const ScratchFile::Piece piece = bytes.add(content);
    addPadding();
    return views.add(
        fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{}{}}})", piece.offset, piece.size, more));
}

// Accessors begin at multiples of four.
void GltfData::addPadding() {
    static constexpr std::byte padding[4] = {};
    bytes.add(std::span(padding).first((4 - bytes.size() % 4) % 4));
}

std::size_t GltfData::addAccessor(std::size_t view, std::uint64_t offset, int component, std::size_t count,
                                  std::string_view type, std::string_view bounds) {
    return accessors.add(
        fmt::format(R"({{"bufferView":{},"byteOffset":{},"componentType":{},"count":{},"type":"{}"{}}})", view, offset,
                    component, count, type, bounds));
}

std::size_t GltfData::addIndices(std::span<const std::uint32_t> indices) {
    const std::size_t view = addView(bytesOf(indices), fmt::format(R"(,"target":{})", targetIndices));
    return addAccessor(view, 0, componentUnsigned, indices.size(), "SCALAR", "");
}

std::size_t GltfData::addScalars(std::span<const float> values, bool hasBounds) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return addAccessor(addView(bytesOf(values), ""), 0, componentFloat, values.size(), "SCALAR",
                       hasBounds ? fmt::format(R"(,"min":[{}],"max":[{}])", *least, *most) : "");
}

std::size_t GltfData::addVectors(std::span<const glm::vec2> values) {
    const std::size_t view = addView(bytesOf(values), fmt::format(R"(,"target":{})", targetVertices));
    return addAccessor(view, 0, componentFloat, values.size(), "VEC2", "");
}

std::size_t GltfData::addVectors(std::span<const glm::vec3> values) {
    return addAccessor(addView(bytesOf(values), ""), 0, componentFloat, values.size(), "VEC3", "");
}

std::size_t GltfData::addVectors(std::span<const glm::vec4> values) {
    return addAccessor(addView(bytesOf(values), ""), 0, componentFloat, values.size(), "VEC4", "");
}

std::size_t GltfData::openView() {
    viewStart_ = bytes.size();
    return views.count();
}

std::size_t GltfData::addVectors(std::span<const glm::vec3> values, bool hasBounds, std::size_t view) {
    const ScratchFile::Piece piece = bytes.add(bytesOf(values));
    return addAccessor(view, piece.offset - viewStart_, componentFloat, values.size(), "VEC3",
                       hasBounds ? boundsOf(values) : "");
}

void GltfData::closeView(std::size_t stride) {
    views.add(fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{},"byteStride":{},"target":{}}})", viewStart_,
                          bytes.size() - viewStart_, stride, targetVertices));
    addPadding();
}

std::size_t GltfData::addBytes(std::span<const std::byte> content) {
    return addView(content, "");
}

}  // namespace taut::geometry
