#include "taut/pipeline/saved_state.h"

#include "taut/core/bytes.h"
#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/pipeline/sealed_file.h"
#include "taut/scene/private/body_size.h"

namespace taut::pipeline {
namespace {

const SealedKind stateKind{.mark = "tautpyst", .version = 1, .title = "state"};

void addTexts(core::ByteWriter& writer, const std::vector<std::string>& texts) {
    writer.add(static_cast<std::uint64_t>(texts.size()));
    for (const std::string& text : texts) writer.add(std::string_view(text));
}

std::vector<std::string> nextTexts(core::ByteReader& reader) {
    std::vector<std::string> texts;
    const auto count = reader.number<std::uint64_t>();
    for (std::uint64_t i = 0; i < count; ++i) texts.push_back(reader.text());  // ends where the bytes do
    return texts;
}

}  // namespace

std::string toBytes(const SavedState& state) {
    core::ByteWriter writer;
    writer.add(static_cast<std::int32_t>(state.bits));
    writer.add(state.source.isText);
    writer.add(std::string_view(state.source.file));
    writer.add(std::string_view(state.source.text));
    addTexts(writer, state.source.overrides);
    writer.add(state.source.isConfined);
    writer.add(state.key);
    writer.add(state.tick);
    addTexts(writer, state.ramps);
    scene::addUsedFiles(writer, state.files);
    writer.addList(std::span<const std::byte>(state.world));
    const std::vector<std::byte> bytes = sealed(stateKind, writer.take());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

SavedState fromBytes(std::string_view text) {
    SealedKind kind = stateKind;
    kind.maxContent = static_cast<std::uint64_t>(scene::memoryLimit());
    const std::vector<std::byte> content =
        unsealed(kind, std::as_bytes(std::span(text.data(), text.size())), "these bytes");
    core::ByteReader reader(content);
    SavedState state;
    state.bits = reader.number<std::int32_t>();
    if (!world::areBits(state.bits)) core::ByteReader::fail();
    if (state.bits != world::resultBits)
        throw core::Error(core::ErrorKind::badContent, "this state was " + world::recordedBy(state.bits));
    state.source.isText = reader.number<bool>();
    state.source.file = reader.text();
    state.source.text = reader.text();
    state.source.overrides = nextTexts(reader);
    state.source.isConfined = reader.number<bool>();
    state.key = reader.number<std::uint64_t>();
    state.tick = reader.number<std::int64_t>();
    state.ramps = nextTexts(reader);
    state.files = scene::nextUsedFiles(reader);
    state.world = reader.list<std::byte>();
    if (!reader.isAtEnd() || state.tick < 0) core::ByteReader::fail();
    return state;
}

world::StartState stateIn(const std::filesystem::path& file) {
    SavedState state = fromBytes(core::fileContent(file, static_cast<std::uint64_t>(scene::memoryLimit())));
    return {state.tick, std::move(state.world)};
}

}  // namespace taut::pipeline
