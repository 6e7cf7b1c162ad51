#include "taut/pipeline/saved_state.h"

#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/pipeline/sealed_file.h"
#include "taut/scene/private/body_size.h"

namespace taut::pipeline {
namespace {

const SealedKind stateKind{.mark = "tautpyst", .version = 1, .title = "state"};

}  // namespace

void visit(core::Bytes& bytes, SavedState& state) {
    bytes(state.bits);
    bytes.require(world::areBits(state.bits));
    if (bytes.isReading() && state.bits != world::resultBits)
        throw core::Error(core::ErrorKind::badContent, "this state was " + world::recordedBy(state.bits));
    SceneSource& source = state.source;
    bytes(source.isText, source.file, source.text, source.overrides, source.isConfined, state.key, state.tick,
          state.ramps, state.files, state.world);
    bytes.require(state.tick >= 0);
}

std::string toBytes(const SavedState& state) {
    const std::vector<std::byte> bytes = sealed(stateKind, core::bytesOf(state));
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

SavedState fromBytes(std::string_view text) {
    SealedKind kind = stateKind;
    kind.maxContent = static_cast<std::uint64_t>(scene::memoryLimit());
    return core::valueIn<SavedState>(unsealed(kind, std::as_bytes(std::span(text.data(), text.size())), "these bytes"));
}

world::StartState stateIn(const std::filesystem::path& file) {
    SavedState state = fromBytes(core::fileContent(file, static_cast<std::uint64_t>(scene::memoryLimit())));
    return {state.tick, std::move(state.world)};
}

}  // namespace taut::pipeline
