#include "taut/regression/tape.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "taut/core/bytes.h"
#include "taut/core/error.h"
#include "taut/ecs/registry.h"
#include "taut/pipeline/machine.h"
#include "taut/pipeline/sealed_file.h"
#include "taut/world/components.h"
#include "taut/world/world.h"

namespace taut::regression {
namespace {

const pipeline::SealedKind kind{
    .mark = "tauttape", .version = 3, .title = "tape", .oldest = 1};  // 1: without the files used, 2: without bits

std::map<std::string, ecs::Entity> bodyEntities(world::World& world) {
    std::map<std::string, ecs::Entity> entities;
    world.registry().each<world::Identity, world::BodyPart>(
        [&](ecs::Entity entity, const world::Identity& identity, const world::BodyPart&) {
            entities.emplace(identity.fullName(), entity);
        });
    return entities;
}

std::uint32_t folded(std::uint64_t hash) {
    return static_cast<std::uint32_t>(hash ^ (hash >> 32U));
}

void addTexts(core::ByteWriter& writer, const std::vector<std::string>& texts) {
    writer.add(static_cast<std::uint64_t>(texts.size()));
    for (const std::string& text : texts) writer.add(text);
}

std::vector<std::string> texts(core::ByteReader& reader) {
    std::vector<std::string> all;
    // Not reserved: a count that is not true ends with the bytes.
    for (auto left = reader.number<std::uint64_t>(); left > 0; --left) all.push_back(reader.text());
    return all;
}

template <class Number>
void addNumbers(core::ByteWriter& writer, const std::vector<Number>& numbers) {
    writer.addList(std::span<const Number>(numbers));
}

// Finds where each tick begins, and thereby whether the lists fit each other.
void index(Tape& tape) {
    std::size_t body = 0, point = 0;
    tape.bodyAt.clear();
    tape.pointAt.clear();
    if (tape.castOf.size() != tape.chain.size() || tape.chain.empty()) core::ByteReader::fail();
    for (const std::uint32_t cast : tape.castOf) {
        if (cast >= tape.casts.size()) core::ByteReader::fail();
        tape.bodyAt.push_back(body);
        tape.pointAt.push_back(point);
        body += tape.casts[cast].names.size();
        for (const int count : tape.casts[cast].points) point += static_cast<std::size_t>(count);
    }
    if (body != tape.bodies.size() || point != tape.points.size()) core::ByteReader::fail();
}

Tape tapeIn(std::span<const std::byte> content) {
    core::ByteReader reader(content);
    Tape tape;
    for (std::string* text :
         {&tape.origin.program, &tape.origin.compiler, &tape.origin.simd, &tape.origin.scene, &tape.origin.text})
        *text = reader.text();
    tape.origin.overrides = texts(reader);
    tape.tickSeconds = reader.number<double>();
    tape.ticksPerFrame = reader.number<std::int32_t>();
    if (!(tape.tickSeconds > 0.0) || tape.ticksPerFrame < 1) core::ByteReader::fail();
    for (auto left = reader.number<std::uint64_t>(); left > 0; --left) {
        TapeBodies cast;
        cast.names = texts(reader);
        cast.points = reader.list<int>();
        if (cast.points.size() != cast.names.size() ||
            std::any_of(cast.points.begin(), cast.points.end(), [](int count) { return count < 0; }))
            core::ByteReader::fail();
        tape.casts.push_back(std::move(cast));
    }
    tape.castOf = reader.list<std::uint32_t>();
    tape.chain = reader.list<std::uint64_t>();
    tape.bodies = reader.list<std::uint64_t>();
    tape.points = reader.list<std::uint32_t>();
    if (!reader.isAtEnd()) tape.origin.files = scene::nextUsedFiles(reader);
    tape.origin.bits = reader.isAtEnd() ? 1 : reader.number<std::int32_t>();
    if (!reader.isAtEnd() || !world::areBits(tape.origin.bits)) core::ByteReader::fail();
    index(tape);
    return tape;
}

}  // namespace

Tape blankTape() {
    const pipeline::Machine machine = pipeline::machine();
    Tape tape;
    tape.origin = {machine.program, machine.compiler, machine.simd, "", "", {}};
    return tape;
}

void addTick(Tape& tape, world::World& world, bool withPoints) {
    // Ticks before a kept state are blank.
    while (static_cast<std::int64_t>(tape.chain.size()) < world.startTick()) {
        if (tape.casts.empty()) tape.casts.emplace_back();
        tape.castOf.push_back(0);
        tape.bodyAt.push_back(0);
        tape.pointAt.push_back(0);
        tape.chain.push_back(0);
    }
    TAUT_EXPECTS(world.tick() == static_cast<std::int64_t>(tape.chain.size()));
    tape.tickSeconds = world.tickSeconds();
    tape.ticksPerFrame = world.ticksPerFrame();
    tape.bodyAt.push_back(tape.bodies.size());
    tape.pointAt.push_back(tape.points.size());
    tape.chain.push_back(world.stateHash());

    TapeBodies cast;
    std::map<std::string, ecs::Entity> entities;
    if (withPoints) entities = bodyEntities(world);
    for (const world::BodyHash& body : world.bodyHashes()) {
        cast.names.push_back(body.name);
        tape.bodies.push_back(body.hash);
        std::vector<std::uint64_t> points;
        if (const auto entity = entities.find(body.name); entity != entities.end())
            points = world.pointHashes(entity->second);
        cast.points.push_back(static_cast<int>(points.size()));
        std::transform(points.begin(), points.end(), std::back_inserter(tape.points), folded);
    }
    if (tape.casts.empty() || tape.casts.back() != cast) tape.casts.push_back(std::move(cast));
    tape.castOf.push_back(static_cast<std::uint32_t>(tape.casts.size() - 1));
}

void writeTape(const std::filesystem::path& path, const Tape& tape) {
    TAUT_EXPECTS(!tape.chain.empty());
    core::ByteWriter writer;
    for (const std::string& text :
         {tape.origin.program, tape.origin.compiler, tape.origin.simd, tape.origin.scene, tape.origin.text})
        writer.add(text);
    addTexts(writer, tape.origin.overrides);
    writer.add(tape.tickSeconds);
    writer.add(static_cast<std::int32_t>(tape.ticksPerFrame));
    writer.add(static_cast<std::uint64_t>(tape.casts.size()));
    for (const TapeBodies& cast : tape.casts) {
        addTexts(writer, cast.names);
        addNumbers(writer, cast.points);
    }
    addNumbers(writer, tape.castOf);
    addNumbers(writer, tape.chain);
    addNumbers(writer, tape.bodies);
    addNumbers(writer, tape.points);
    scene::addUsedFiles(writer, tape.origin.files);
    writer.add(static_cast<std::int32_t>(tape.origin.bits));
    pipeline::writeSealed(path, kind, writer.take());
}

Tape readTape(const std::filesystem::path& path) {
    const std::vector<std::byte> content = pipeline::readSealed(path, kind);
    try {
        return tapeIn(content);
    } catch (const core::Error& error) {
        throw core::Error(error.kind(), fmt::format("{}: {}", path.string(), error.what()));
    }
}

}  // namespace taut::regression
