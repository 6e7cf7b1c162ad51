// A world as bytes: what its ticks have changed. The scene is not among them; it makes the world that they go into.
#include <algorithm>

#include "taut/world/byte_parts.h"
#include "taut/world/impl.h"

namespace taut::world {
namespace {

using core::ByteReader;
using core::ByteWriter;

Ease easeOf(ByteReader& bytes) {
    const int number = bytes.number<int>();
    require(number >= 0 && number <= static_cast<int>(Ease::hold));
    return static_cast<Ease>(number);
}

// Ways in ticks: none takes longer than any run.
constexpr std::int64_t longest = std::int64_t{1} << 40;

std::int64_t ticks(ByteReader& bytes, std::int64_t least) {
    const auto number = bytes.number<std::int64_t>();
    require(number >= least && number <= longest);
    return number;
}

void addHand(ByteWriter& bytes, const Hand& hand) {
    bytes.add(hand.id);
    bytes.add(hand.rigid);
    for (const dvec3* v : {&hand.from, &hand.to, &hand.rate}) addVector(bytes, *v);
    bytes.add(hand.start);
    bytes.add(hand.length);
    bytes.add(static_cast<int>(hand.ease));
}

Hand readHand(ByteReader& bytes) {
    Hand hand;
    hand.id = bytes.text();
    hand.rigid = bytes.number<bool>();
    for (dvec3* v : {&hand.from, &hand.to, &hand.rate}) *v = vector(bytes);
    hand.start = ticks(bytes, 0);
    hand.length = ticks(bytes, 1);
    hand.ease = easeOf(bytes);
    return hand;
}

void addMove(ByteWriter& bytes, const std::optional<PoseMove>& move) {
    bytes.add(move.has_value());
    if (!move) return;
    addPose(bytes, move->from);
    addPose(bytes, move->to);
    bytes.add(move->start);
    bytes.add(move->length);
    bytes.add(static_cast<int>(move->ease));
}

std::optional<PoseMove> readMove(ByteReader& bytes) {
    if (!bytes.number<bool>()) return std::nullopt;
    PoseMove move;
    move.from = pose(bytes);
    move.to = pose(bytes);
    move.start = ticks(bytes, 0);
    move.length = ticks(bytes, 1);
    move.ease = easeOf(bytes);
    return move;
}

void addRamp(ByteWriter& bytes, const Ramp& ramp, const SceneSpec& spec) {
    bytes.add(ramp.action.key);
    bytes.addList<double>(ramp.action.value);
    bytes.add(static_cast<int>(ramp.action.ease));
    bytes.addList<double>(ramp.from);
    bytes.add(ramp.start);
    bytes.add(ramp.length);
    bytes.addList<double>(ramp.action.field.read(spec));
}

// Its field is that of any action of the scene with the same key. Writes the value as it was into the scene.
Ramp readRamp(ByteReader& bytes, const SceneSpec& start, SceneSpec& spec) {
    Ramp ramp;
    const std::string key = bytes.text();
    const auto like = std::find_if(start.actions.begin(), start.actions.end(),
                                   [&](const ActionSpec& a) { return a.what == Do::ramp && a.key == key; });
    if (like == start.actions.end()) misfit("it has no ramp of \"" + key + "\"");
    ramp.action = *like;
    const std::size_t size = like->field.read(spec).size();
    const auto values = [&] {
        std::vector<double> list = bytes.list<double>();
        require(list.size() == size);
        for (double number : list) require(std::isfinite(number));
        return list;
    };
    ramp.action.value = values();
    ramp.action.ease = easeOf(bytes);
    ramp.from = values();
    ramp.start = ticks(bytes, 0);
    ramp.length = ticks(bytes, 0);
    ramp.action.field.write(spec, values());
    return ramp;
}

}  // namespace

void World::Impl::save(ByteWriter& bytes) const {
    bytes.add(ticksPerSecond);
    bytes.add(tick);
    bytes.add(hash);
    bytes.add(static_cast<std::uint64_t>(ramps.size()));
    for (const Ramp& ramp : ramps) addRamp(bytes, ramp, spec);
    bytes.add(static_cast<std::uint64_t>(spawned.size()));
    for (const std::string& target : spawned) bytes.add(target);
    bytes.add(static_cast<std::uint64_t>(hands.size()));
    for (const Hand& hand : hands) addHand(bytes, hand);
    registry.each<ColliderPart, Placement>([&](ecs::Entity, const ColliderPart& part, const Placement& placement) {
        bytes.add(part.spec.name);
        addPose(bytes, placement.from);
        addPose(bytes, placement.to);
        bytes.add(placement.moved);
        addMove(bytes, part.move);
    });
    bytes.add(static_cast<std::uint64_t>(islands.size()));
    for (const auto& island : islands) island->save(bytes);
}

void World::Impl::restore(ByteReader& bytes) {
    TAUT_EXPECTS(tick == 0);
    if (bytes.number<double>() != ticksPerSecond) misfit("its frame rate is another");
    tick = ticks(bytes, 0);
    hash = bytes.number<std::uint64_t>();
    const auto rampCount = bytes.number<std::uint64_t>();
    for (std::uint64_t i = 0; i < rampCount; ++i) ramps.push_back(readRamp(bytes, *start, spec));
    takeRampedParts();
    const auto spawnCount = bytes.number<std::uint64_t>();
    for (std::uint64_t i = 0; i < spawnCount; ++i) {
        ActionSpec action;
        action.target = bytes.text();
        spawnNamed(action);
    }
    const auto handCount = bytes.number<std::uint64_t>();
    for (std::uint64_t i = 0; i < handCount; ++i) hands.push_back(readHand(bytes));
    registry.each<ColliderPart, Placement>([&](ecs::Entity, ColliderPart& part, Placement& placement) {
        if (bytes.text() != part.spec.name) misfit("its colliders are others");
        placement.from = pose(bytes);
        placement.to = pose(bytes);
        placement.moved = bytes.number<bool>();
        part.move = readMove(bytes);
    });
    if (bytes.number<std::uint64_t>() != islands.size()) misfit("its bodies hang together in another way");
    const IslandForces current = forces();
    for (const auto& island : islands) {
        island->setForces(now(), current);
        island->restore(bytes);
    }
    if (!bytes.isAtEnd()) misfit("there is more in them than it has");
    rebuildColliders();
    redrawDamage();
}

std::vector<std::byte> World::save() const {
    core::ByteWriter bytes;
    impl_->save(bytes);
    return bytes.take();
}

void World::restore(std::span<const std::byte> bytes) {
    core::ByteReader reader(bytes);
    impl_->restore(reader);
}

}  // namespace taut::world
