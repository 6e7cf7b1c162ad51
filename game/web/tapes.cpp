#include "game/web/tapes.h"

#include "game/web/scene_source.h"
#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/regression/tape.h"
#include "taut/regression/tape_compare.h"
#include "taut/world/world.h"

namespace taut::web {
namespace {

constexpr const char* tapeFile = "/taut/run.tape";
constexpr std::uint64_t mostTape = std::uint64_t{1} << 30U;  // [bytes]

regression::Tape played(const SceneSource& source, std::int64_t ticks) {
    const world::SceneSpec spec = read(source).spec;
    regression::Tape tape = regression::blankTape();
    tape.origin.scene = source.file;
    tape.origin.text = source.text;
    tape.origin.overrides = source.overrides;
    tape.origin.files = scene::usedFiles(spec);
    world::World world(spec, {.threads = 1});
    regression::addTick(tape, world, true);
    while (world.tick() < ticks) {
        if (const auto divergence = world.advance()) throw core::Error(core::ErrorKind::diverged, divergence->message);
        regression::addTick(tape, world, true);
    }
    return tape;
}

}  // namespace

Json recordedTape(const Json& with) {
    static std::string bytes;
    regression::writeTape(tapeFile, played(sourceIn(with), with.at("ticks")));
    bytes = core::fileContent(tapeFile, mostTape);
    return bytesOf(std::as_bytes(std::span<const char>(bytes)));
}

Json replayedTape(const Json& with) {
    const std::span<const std::byte> bytes = bytesIn(with);
    core::writeWholeFile(tapeFile, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    const regression::Tape tape = regression::readTape(tapeFile);
    SceneSource source;
    source.isText = true;
    source.text = tape.origin.text;
    source.file = tape.origin.scene;
    source.overrides = tape.origin.overrides;
    const auto difference = regression::firstDifference(tape, played(source, tape.ticks()));
    return {{"ticks", tape.ticks()}, {"difference", difference ? Json(regression::describe(*difference)) : Json()}};
}

}  // namespace taut::web
