// What the fuzz targets share: bytes as the readers want them, a file that is in memory only, a small scene. Each target
// gives bytes to one reader. It may refuse them with a core::Error; anything else is a mistake of the reader.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "taut/core/error.h"

// Called by libFuzzer.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed);
// Its own way of changing bytes; returns how many there are then.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace taut::fuzz {

inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

inline std::span<const std::byte> bytesOf(const std::uint8_t* data, std::size_t size) {
    return std::as_bytes(std::span(data, size));
}

// Refusals are what a reader is for.
template <class Call>
int read(const Call& call) {
    try {
        call();
    } catch (const core::Error& error) {
        if (std::string_view(error.what()).empty()) std::abort();
    }
    return 0;
}

// For readers that take a path.
class MemoryFile {
  public:
    MemoryFile(const std::uint8_t* data, std::size_t size) : descriptor_(::memfd_create("fuzz", MFD_CLOEXEC)) {
        if (::write(descriptor_, data, size) != static_cast<ssize_t>(size)) std::abort();
    }
    ~MemoryFile() { ::close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  private:
    int descriptor_;
};

// One of each kind, named as seeds.sh names what it finds in the shipped scenes; half a second without actions.
inline constexpr std::string_view smallScene = R"(schema = 1
run = { fps = 30, seconds = 0.5 }
[material.a]
stretch_N_per_m = 100
break_strain = 0.8
yield_strain = 0.3
[cloth.a]
size = [1, 1]
cells = [3, 3]
origin = [0, 2, 0]
material = "a"
hold = ["top-left"]
[rope.a]
ends = [[-1, 1, 0], [-2, 1, 0]]
segments = 4
stretch_N = 100
[block.a]
size = [0.3, 0.3, 0.3]
cells = [1, 2, 1]
position = [2, 1, 0]
young_Pa = 2000
bulk_Pa = 1000
[net.a]
points = [{ name = "p", position = [0, 3, 1] }, { name = "q", position = [0, 4, 1], hold = true }]
springs = [{ a = "p", b = "q", stiffness_N_per_m = 10 }]
[wind.a]
velocity = [1, 0, 2]
gust = { amplitude = 1, period_s = 0.5, seed = 3 }
[collider.a]
shape = "sphere"
position = [0.5, 1, 0]
radius = 0.2
[collider.ground]
shape = "plane"
[camera.main]
eye = [0, 1, 5]
)";

}  // namespace taut::fuzz
