// The content of a glTF file and of the files that it names. Numbers in it name something, and are finite and not too
// large. It knows no figure.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <fstream>  // tinygltf forgets it
#include <glm/vec3.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

#include "taut/core/private/hash.h"
#include "taut/scene/private/text_file.h"

namespace taut::scene {

// Numbers of an accessor, element after element.
struct GltfNumbers {
    std::size_t width = 0;  // of an element
    std::vector<double> values;
    std::size_t count() const { return values.size() / width; }
    std::span<const double> operator[](std::size_t i) const { return std::span(values).subspan(i * width, width); }
    glm::dvec3 place(std::size_t i) const { return {values[i * width], values[i * width + 1], values[i * width + 2]}; }
};

class GltfModel {
  public:
    static constexpr std::uint64_t maxFileSize = 256U << 20U;  // [bytes] of the file, and of each that it names
    static constexpr std::size_t maxElements = 5'000'000;      // of one accessor; vertices and corners of all parts
    static constexpr double maxPlace = 1e12;                   // of a number

    // Throws core::Error as gltfMeshText() does.
    GltfModel(std::string bytes, std::filesystem::path path, const Confinement& confinement);

    const tinygltf::Model& content() const { return model_; }
    std::uint64_t hash() const { return hash_.value(); }              // of all bytes that were read
    const std::vector<std::string>& files() const { return files_; }  // paths of further files that were read

    [[noreturn]] void fail(const std::string& message) const;  // throws core::Error(badContent) with the file
    // Fails for a number that names nothing.
    template <class T>
    const T& at(const std::vector<T>& all, int number, const char* what) const {
        if (number < 0 || static_cast<std::size_t>(number) >= all.size())
            fail(fmt::format("there is no {} {}: the file has {}", what, number, all.size()));
        return all[number];
    }
    // The numbers of an accessor. Fails if its elements do not have `width` components.
    GltfNumbers numbers(int accessorNumber, std::size_t width, const char* what) const;
    // The file that has a picture, or a part of the file itself; empty: the picture is in its text or in other buffers.
    std::string pictureFile(const tinygltf::Image& image) const;

    // Ignored parts of the file.
    void note(const std::string& what) { notes_.insert(what); }
    const std::set<std::string>& notes() const { return notes_; }

  private:
    void parse(std::string& bytes);
    void prepare(std::string& bytes, std::size_t first, std::size_t last);
    std::string takenBase64(std::span<char> string);
    std::vector<unsigned char>* takenAs(const std::string& name);
    template <class Callbacks>
    Callbacks fileCallbacks();
    bool readNamed(const std::string& name, std::vector<unsigned char>& content, std::string& error);
    std::span<const unsigned char> viewed(int number) const;
    template <class Take>
    void unpack(std::span<const unsigned char> bytes, std::size_t offset, std::size_t stride, std::size_t count,
                std::size_t width, int type, bool isNormalised, const Take& take) const;

    std::filesystem::path path_;
    const Confinement& confinement_;
    tinygltf::Model model_;
    core::Hash hash_;
    std::vector<std::vector<unsigned char>> base64_;  // in the order of the text
    std::size_t binaryStart_ = 0;                     // of a GLB: where in the file its buffer begins
    std::vector<std::string> files_;
    std::set<std::string> notes_;
};

}  // namespace taut::scene
