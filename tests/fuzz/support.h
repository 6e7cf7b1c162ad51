// Common code of the targets: bytes as the readers want them, a file in memory, a small scene.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "fuzz/targets.h"
#include "taut/core/error.h"
#include "taut/scene/load.h"

namespace taut::fuzz {

inline std::string_view textOf(View bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

inline Bytes copyOf(std::span<const std::byte> bytes) {
    const auto* from = reinterpret_cast<const std::uint8_t*>(bytes.data());
    return {from, from + bytes.size()};
}

// For readers that take a path.
class MemoryFile {
  public:
    explicit MemoryFile(View bytes) : descriptor_(::memfd_create("fuzz", MFD_CLOEXEC)) {
        TAUT_EXPECTS(::write(descriptor_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
    }
    ~MemoryFile() { ::close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  private:
    int descriptor_;
};

// Reads no other files but the small ones of the tests, and refuses the same on every machine.
inline scene::LoadOptions alone() {
    scene::LoadOptions options;
    options.isConfined = true;
    options.memoryLimit = 16e9;
    options.assetFolders = {TAUT_SOURCE_DIR "/tests/support"};
    return options;
}

// One of each kind, named as seeds.sh names the parts of the shipped scenes; half a second without actions.
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
