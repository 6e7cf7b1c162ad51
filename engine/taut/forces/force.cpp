#include "taut/forces/force.h"

#include <algorithm>

namespace taut::world {
namespace {

const Force* named(const ForceList& forces, const std::string& name) {
    const auto found = std::find_if(forces.begin(), forces.end(), [&](const auto& f) { return f->name() == name; });
    return found == forces.end() ? nullptr : found->get();
}

}  // namespace

bool hasSameBytes(const Force& a, const Force& b) {
    const auto bytesOf = [](const Force& force) {
        core::ByteWriter writer;
        StateBytes bytes(writer);
        force.copy()->visit(bytes);
        return writer.take();
    };
    return bytesOf(a) == bytesOf(b);
}

ForceList during(const ForceList& from, const ForceList& middle, const ForceList& to, double t0, double t1) {
    ForceList forces;
    for (const auto& force : middle) {
        const Force *first = named(from, force->name()), *last = named(to, force->name());
        forces.push_back(first != nullptr && last != nullptr ? force->during(*first, *last, t0, t1) : force);
    }
    return forces;
}

bool goesOn(const ForceList& before, const ForceList& now) {
    if (before.size() != now.size()) return false;
    for (std::size_t i = 0; i < now.size(); ++i)
        if (now[i]->name() != before[i]->name() || !now[i]->goesOn(*before[i])) return false;
    return true;
}

void visit(StateBytes& bytes, ForceList& forces) {
    std::size_t next = 0;
    const auto visitNext = [&] {
        const std::shared_ptr<Force> force = forces[next]->copy();
        force->visit(bytes);
        forces[next++] = force;
    };
    if (!forces.empty()) visitNext();
    for (const char* kind : {"wind.", "anchor."}) {
        std::size_t end = next;
        while (end < forces.size() && forces[end]->name().starts_with(kind)) ++end;
        auto count = static_cast<std::uint64_t>(end - next);
        bytes(count);
        bytes.require(count == end - next);
        while (next < end) visitNext();
    }
    while (next < forces.size()) visitNext();
}

}  // namespace taut::world
