#include "taut/regression/goldens.h"

#include <fmt/format.h>

#include <utility>

#include "taut/core/error.h"
#include "taut/core/private/file_batch.h"
#include "taut/core/whole_file.h"
#include "taut/image/png.h"
#include "taut/image/read.h"
#include "taut/pipeline/run_parts.h"
#include "taut/pipeline/sealed_file.h"
#include "taut/regression/judging.h"
#include "taut/regression/scenario_text.h"
#include "taut/regression/tape_compare.h"

namespace taut::regression {
namespace {

const pipeline::SealedKind storedKind{"tautgold", 1, "stored state of a golden picture"};

// The bits of the tape there, where its chain is the same.
std::optional<int> bitsOfSameChain(const std::filesystem::path& file, const Tape& tape) {
    try {
        if (!core::isThere(file)) return std::nullopt;
        const Tape golden = readTape(file);
        if (firstDifference(golden, tape)) return std::nullopt;
        return golden.origin.bits;
    } catch (const core::Error& error) {
        if (error.kind() == core::ErrorKind::inputOutput) throw;
        return std::nullopt;  // damaged: written anew
    }
}

bool hasSamePicture(const std::filesystem::path& file, const image::Image& picture, const image::Tolerance& tolerance) {
    try {
        return core::isThere(file) &&
               image::compare(
                   image::readImage(file, std::max(image::mostPixels, std::int64_t{picture.width} * picture.height)),
                   picture, tolerance)
                   .within;
    } catch (const core::Error& error) {
        if (error.kind() == core::ErrorKind::inputOutput) throw;
        return false;
    }
}

// The parts of the golden that had to change; empty: none.
std::string updateState(const Scenario& scenario, const Played& played, const GoldenFolder& folder,
                        GoldenScenario& goldens, const std::string& why, core::FileBatch& files) {
    const std::filesystem::path file = folder.tape(scenario.name);
    const std::string last = pipeline::hexadecimal(played.tape.chain.back());
    const TapeOrigin& origin = played.tape.origin;
    std::optional<int> known;
    if (goldens.state && goldens.state->lastHash == last) known = bitsOfSameChain(file, played.tape);
    if (known == origin.bits && goldens.bits == origin.bits) return "";
    if (known != origin.bits) writeTape(files.replace(file), played.tape);
    if (known) return fmt::format("the same state, now of bits {}", origin.bits);
    goldens.state = {why, last, played.tape.ticks(), origin.program, origin.compiler, origin.simd};
    return fmt::format("state, {} ticks", played.tape.ticks());
}

bool updatePicture(const Scenario& scenario, const PlayedPicture& played, const GoldenFolder& folder,
                   const Manifest& manifest, GoldenScenario& goldens, const std::string& why,
                   const std::string& renderer, core::FileBatch& files) {
    const std::string key = played.request.key();
    const std::filesystem::path file = folder.picture(scenario.name, key), stored = folder.stored(scenario.name, key);
    const auto known = goldens.pictures.find(key);
    const std::string hash = pipeline::hexadecimal(played.stateHash);
    const auto writeStored = [&] {
        if (!played.request.restart) return;
        TAUT_EXPECTS(!played.savedState.empty());
        pipeline::writeSealed(files.replace(stored), storedKind, played.savedState);
    };
    const bool isKnown = known != goldens.pictures.end();
    const bool hasState =
        !played.request.restart || (isKnown && core::isThere(stored) && known->second.stateHash == hash);
    if (isKnown && hasState && hasSamePicture(file, played.picture, toleranceFor(manifest, known->second, renderer))) {
        known->second.stateHash = hash;  // the picture stays and so does its reason; its state may have changed unseen
        if (goldens.bits != world::resultBits) writeStored();
        return false;
    }
    writeStored();
    image::writePng(files.replace(file), played.picture);
    goldens.pictures[key] = {why, hash, renderer};
    return true;
}

}  // namespace

std::vector<std::string> updateGoldens(const Scenario& scenario, const Played& played, const GoldenFolder& folder,
                                       Manifest& manifest, const std::string& why) {
    TAUT_EXPECTS(!played.divergence && !played.interrupted);
    std::vector<std::string> changes;
    core::FileBatch files(folder.path);
    Manifest updated = manifest;
    const std::vector<std::string> dropped = leftOver(scenario, manifest);
    GoldenScenario& goldens = updated.scenarios[scenario.name];
    if (const std::string change = updateState(scenario, played, folder, goldens, why, files); !change.empty())
        changes.push_back(fmt::format("{}: {}", folder.tape(scenario.name).string(), change));
    for (const PlayedPicture& picture : played.pictures)
        if (updatePicture(scenario, picture, folder, manifest, goldens, why, played.renderer, files))
            changes.push_back(
                fmt::format("{}: picture", folder.picture(scenario.name, picture.request.key()).string()));
    if (keepText(scenario, folder, files))
        changes.push_back(fmt::format("{}: text", folder.text(scenario.name).string()));
    for (const std::string& key : dropped) {
        goldens.pictures.erase(key);
        files.remove(folder.picture(scenario.name, key));
        files.remove(folder.stored(scenario.name, key));
        changes.push_back(fmt::format("{}: dropped", folder.picture(scenario.name, key).string()));
    }
    goldens.bits = world::resultBits;
    writeManifest(files.replace(folder.manifest()), updated);
    files.commit();
    manifest = std::move(updated);
    return changes;
}

std::optional<std::vector<std::byte>> storedState(const GoldenFolder& folder, const std::string& scenario,
                                                  const std::string& key) {
    const std::filesystem::path file = folder.stored(scenario, key);
    if (!core::isThere(file)) return std::nullopt;
    return pipeline::readSealed(file, storedKind);
}

}  // namespace taut::regression
