#include "taut/regression/tape.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

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

}  // namespace

void visit(core::Bytes& bytes, TapeBodies& cast) {
    bytes(cast.names, cast.points);
    bytes.require(cast.points.size() == cast.names.size() &&
                  std::none_of(cast.points.begin(), cast.points.end(), [](int count) { return count < 0; }));
}

void visit(core::Bytes& bytes, Tape& tape) {
    TapeOrigin& origin = tape.origin;
    bytes(origin.program, origin.compiler, origin.simd, origin.scene, origin.text, origin.overrides, tape.tickSeconds,
          tape.ticksPerFrame);
    bytes.require(tape.tickSeconds > 0.0 && tape.ticksPerFrame >= 1);
    bytes(tape.casts, tape.castOf, tape.chain, tape.bodies, tape.points);
    if (!bytes.isAtEnd()) bytes(origin.files);
    if (bytes.isAtEnd())
        origin.bits = 1;
    else
        bytes(origin.bits);
    bytes.require(world::areBits(origin.bits));
    if (bytes.isReading()) index(tape);
}

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

std::optional<world::Divergence> addTicks(Tape& tape, world::World& world, std::int64_t last, bool withPoints,
                                          const std::function<bool()>& goesOn) {
    addTick(tape, world, withPoints);
    while (world.tick() < last && goesOn()) {
        if (auto divergence = world.advance()) return divergence;
        addTick(tape, world, withPoints);
    }
    return std::nullopt;
}

void writeTape(const std::filesystem::path& path, const Tape& tape) {
    TAUT_EXPECTS(!tape.chain.empty());
    pipeline::writeSealedValue(path, kind, tape);
}

Tape readTape(const std::filesystem::path& path) {
    return pipeline::readSealedValue<Tape>(path, kind);
}

}  // namespace taut::regression
