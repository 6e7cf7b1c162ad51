// The manifest of the goldens: the recorded pictures and state chains, the reason of each, and the machine that made
// it. One file for all scenarios of a folder of goldens. Independent of playing scenarios and comparing goldens.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "taut/image/private/compare.h"
#include "taut/world/result_bits.h"

namespace taut::regression {

// A picture; its name is made by keyOf() in goldens.h: "000120", "000060-debug".
struct GoldenPicture {
    std::string why;
    std::string stateHash;  // of the chain where it was drawn, 16 hexadecimal digits
    std::string renderer;   // its renderer, as Drawer::renderer()
};

// The chain of state hashes of a whole run.
struct GoldenState {
    std::string why;
    std::string lastHash;  // 16 hexadecimal digits
    std::int64_t ticks = 0;
    std::string program, compiler, simd;  // its program
};

struct GoldenScenario {
    int bits = world::resultBits;  // generation of results that its goldens were recorded by
    std::optional<GoldenState> state;
    std::map<std::string, GoldenPicture> pictures;
};

struct Manifest {
    image::Tolerance tolerance;                                // of pictures by the renderer that drew the golden
    image::Tolerance otherRenderer = image::betweenRenderers;  // of those by another
    std::map<std::string, GoldenScenario> scenarios;
};

// Whether two pictures come from one and the same renderer, by Drawer::renderer(): its version, the library that gave
// the context and the features of the processor change no more than rounding.
bool isSameRenderer(const std::string& a, const std::string& b);
std::string nameOfRenderer(const std::string& renderer);  // "llvmpipe"

// How a picture of that renderer is held against this golden.
const image::Tolerance& toleranceFor(const Manifest& manifest, const GoldenPicture& golden,
                                     const std::string& renderer);

// Where things lie in a folder of goldens.
struct GoldenFolder {
    std::filesystem::path path;
    std::filesystem::path manifest() const { return path / "manifest.json"; }
    std::filesystem::path picture(const std::string& scenario, const std::string& key) const;  // NAME/000120.png
    std::filesystem::path stored(const std::string& scenario, const std::string& key) const;   // NAME/000120.state
    std::filesystem::path tape(const std::string& scenario) const;                             // NAME/state.tape
    std::filesystem::path text(const std::string& scenario) const;                             // NAME/scenario.toml
};

// Without a file an empty manifest; throws core::Error: inputOutput if it cannot be read, badContent with the fault if
// it is no manifest.
Manifest readManifest(const GoldenFolder& folder);

// The same for a text; file is used in messages.
Manifest readManifestText(const std::string& content, const std::string& file);

// Throws core::Error(inputOutput).
void writeManifest(const std::filesystem::path& file, const Manifest& manifest);

}  // namespace taut::regression
