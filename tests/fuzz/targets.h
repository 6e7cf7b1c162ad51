// The readers of files and texts that others may have made, each as one function of bytes. A reader may refuse them
// with a core::Error; anything else is a mistake of the reader. libFuzzer calls them (fuzzer.cpp), and the unit tests.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace taut::fuzz {

using View = std::span<const std::uint8_t>;
using Bytes = std::vector<std::uint8_t>;
using Change = std::function<void(Bytes&)>;

struct Target {
    std::string_view name;
    void (*read)(View bytes);
    // How to change them so that the content below checksums is reached; null: as they are. Equal numbers, equal
    // results.
    Bytes (*changed)(const Bytes& bytes, const Change& change, unsigned number) = nullptr;
};

std::span<const Target> targets();

// The result of a target for bytes: refused or taken.
void give(const Target& target, View bytes);

// The bytes, a little different.
Bytes changed(const Target& target, Bytes bytes, const Change& change, unsigned number);

void readCheck(View bytes);
void readGltf(View bytes);
void readImage(View bytes);
void readLightImage(View bytes);
void readManifest(View bytes);
void readObj(View bytes);
void readOverrides(View bytes);
void readPlay(View bytes);
void readScene(View bytes);
void readTape(View bytes);
void readTimeline(View bytes);
void readWorld(View bytes);

Bytes changedImage(const Bytes& bytes, const Change& change, unsigned number);
Bytes changedTape(const Bytes& bytes, const Change& change, unsigned number);
Bytes changedWorld(const Bytes& bytes, const Change& change, unsigned number);

}  // namespace taut::fuzz
