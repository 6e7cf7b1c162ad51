// The JSON half of a glTF 2.0 file, as far as it grows with the frames: views and accessors of the binary half. It
// knows no frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

#include "taut/geometry/private/scratch_file.h"

namespace taut::geometry {

// "\"text\"", escaped.
std::string jsonText(std::string_view text);

// The items of a JSON array.
class JsonItems {
  public:
    // Returns its number.
    std::size_t add(std::string_view item);
    std::size_t count() const { return count_; }
    const std::string& text() const { return text_; }  // without brackets

  private:
    std::string text_;
    std::size_t count_ = 0;
};

// Numbers of accessors that were added to the binary half.
class GltfData {
  public:
    explicit GltfData(const std::filesystem::path& path) : bytes(path) {}

    std::size_t addIndices(std::span<const std::uint32_t> indices);
    std::size_t addScalars(std::span<const float> values, bool hasBounds);
    std::size_t addVectors(std::span<const glm::vec2> values);
    std::size_t addVectors(std::span<const glm::vec4> values);
    // Of the attributes of vertices; several may share a view, of which `view` is the number.
    std::size_t addVectors(std::span<const glm::vec3> values, bool hasBounds, std::size_t view);
    std::size_t addVectors(std::span<const glm::vec3> values);  // of animations

    // A view of attributes of one kind that follow: openView(), accessors, closeView(bytes of a vector).
    std::size_t openView();
    void closeView(std::size_t stride);

    // A file as it is, such as a picture; returns the view.
    std::size_t addBytes(std::span<const std::byte> content);

    ScratchFile bytes;
    JsonItems views, accessors;

  private:
    std::size_t addView(std::span<const std::byte> content, std::string_view more);
    void addPadding();
    std::size_t addAccessor(std::size_t view, std::uint64_t offset, int component, std::size_t count,
                            std::string_view type, std::string_view bounds);
    std::uint64_t viewStart_ = 0;
};

}  // namespace taut::geometry
