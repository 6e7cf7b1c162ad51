#include "taut/regression/tape_compare.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/core/private/contains.h"

namespace taut::regression {
namespace {

TapeDifference differenceAt(const Tape& tape, std::size_t tick, TapeFault fault) {
    TapeDifference difference;
    difference.fault = fault;
    difference.tick = static_cast<std::int64_t>(tick);
    difference.time = static_cast<double>(tick) * tape.tickSeconds;
    difference.frame = (difference.tick + tape.ticksPerFrame - 1) / tape.ticksPerFrame;
    return difference;
}

// A body that only one of the casts has; the first place where they differ if it is their order.
std::string oddOne(const TapeBodies& a, const TapeBodies& b) {
    for (const auto& [from, other] : {std::pair(&a, &b), std::pair(&b, &a)})
        for (const std::string& name : from->names)
            if (!core::contains(other->names, name)) return name;
    return *std::mismatch(a.names.begin(), a.names.end(), b.names.begin(), b.names.end()).first;
}

// The points of one body; `from` and `other` say where they begin.
void findPoints(const Tape& a, std::size_t from, const Tape& b, std::size_t other, int count,
                TapeDifference& difference) {
    for (int i = 0; i < count; ++i) {
        if (a.points[from + static_cast<std::size_t>(i)] == b.points[other + static_cast<std::size_t>(i)]) continue;
        if (difference.point < 0) difference.point = i;
        ++difference.points;
    }
}

void findBodies(const Tape& a, const Tape& b, std::size_t tick, TapeDifference& difference) {
    const TapeBodies &castA = a.casts[a.castOf[tick]], &castB = b.casts[b.castOf[tick]];
    std::size_t pointA = a.pointAt[tick], pointB = b.pointAt[tick];
    for (std::size_t i = 0; i < castA.names.size(); ++i) {
        const int countA = castA.points[i], countB = castB.points[i];
        if (a.bodies[a.bodyAt[tick] + i] != b.bodies[b.bodyAt[tick] + i]) {
            if (++difference.bodies == 1) {
                difference.body = castA.names[i];
                if (countA == countB) findPoints(a, pointA, b, pointB, countA, difference);
            }
        }
        pointA += static_cast<std::size_t>(countA);
        pointB += static_cast<std::size_t>(countB);
    }
}

std::string place(const TapeDifference& d) {
    return fmt::format("tick {} ({:.4g} s, frame {})", d.tick, d.time, d.frame);
}

}  // namespace

std::optional<TapeDifference> firstDifference(const Tape& a, const Tape& b) {
    if (a.tickSeconds != b.tickSeconds || a.ticksPerFrame != b.ticksPerFrame)
        return differenceAt(a, 0, TapeFault::rates);
    const std::size_t both = std::min(a.chain.size(), b.chain.size());
    const auto found =
        std::mismatch(a.chain.begin(), a.chain.begin() + static_cast<std::ptrdiff_t>(both), b.chain.begin());
    const auto tick = static_cast<std::size_t>(found.first - a.chain.begin());
    if (tick == both) {
        if (a.chain.size() == b.chain.size()) return std::nullopt;
        return differenceAt(a, both, TapeFault::length);
    }
    const TapeBodies &castA = a.casts[a.castOf[tick]], &castB = b.casts[b.castOf[tick]];
    if (castA.names != castB.names) {
        TapeDifference difference = differenceAt(a, tick, TapeFault::cast);
        difference.body = oddOne(castA, castB);
        return difference;
    }
    TapeDifference difference = differenceAt(a, tick, TapeFault::state);
    findBodies(a, b, tick, difference);
    if (difference.bodies == 0) difference.fault = TapeFault::chain;
    return difference;
}

std::string describe(const TapeDifference& d) {
    switch (d.fault) {
        case TapeFault::rates: return "their ticks differ in length, so no state can be compared";
        case TapeFault::cast: return fmt::format("{}: {} is there in only one of them", place(d), d.body);
        case TapeFault::chain:
            return fmt::format("{}: the hash of the chain differs although that of every body agrees", place(d));
        case TapeFault::length: return fmt::format("{} is there in only one of them; up to it they agree", place(d));
        case TapeFault::state: break;
    }
    std::string text = fmt::format("{}: {} differs first", place(d), d.body);
    if (d.point >= 0)
        text += fmt::format(", at point {}{}", d.point, d.points > 1 ? fmt::format(" and {} more", d.points - 1) : "");
    if (d.bodies > 1)
        text +=
            fmt::format("; so do{} {} other bod{}", d.bodies > 2 ? "" : "es", d.bodies - 1, d.bodies > 2 ? "ies" : "y");
    return text;
}

}  // namespace taut::regression
