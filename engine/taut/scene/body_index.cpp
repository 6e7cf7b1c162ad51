#include "taut/scene/private/body_index.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "taut/core/error.h"
#include "taut/core/glob.h"
#include "taut/fields/private/problems.h"
#include "taut/scene/private/sections.h"
#include "taut/spec/targets.h"

namespace taut::scene {

namespace {

using world::withoutSelector;

std::string_view kindOf(std::string_view title) {
    return title.substr(0, title.find('.'));
}

bool fits(std::string_view pattern, const BodyEntry& body) {
    if (kindOf(pattern) != body.kind) return false;
    if (body.copies == 1) return core::matches(pattern, body.title());
    for (int i = 0; i < body.copies; ++i)
        if (core::matches(pattern, fmt::format("{}.{}", body.title(), i))) return true;
    return false;
}

std::optional<TargetFault> indexFault(const BodyEntry& body, const std::string& selector) {
    const auto number = world::pointNumber(selector);
    if (!number) return TargetFault{fmt::format("\"{}\" is not the number of a point", selector), "write #0, #1, …"};
    if (body.isFaulty || *number < body.outline.points) return std::nullopt;
    return TargetFault{fmt::format("{} has no point {}", body.title(), selector),
                       fmt::format("its points are #0 … #{:.0f}", body.outline.points - 1)};
}

std::optional<TargetFault> uvFault(const BodyEntry& body, const std::string& selector) {
    const auto place = world::gridPlace(selector);
    if (!place)
        return TargetFault{fmt::format("\"{}\" is not a place on a cloth", selector),
                           "write (u,v), each 0 … 1, or (u,v,r) with a radius r in metres"};
    if (body.isFaulty) return std::nullopt;
    if (!body.outline.isGrid) return TargetFault{fmt::format("{} is no grid: it has no (u,v)", body.title()), ""};
    const double u = 2 * place->u - 1, v = 2 * place->v - 1;
    if (!body.outline.isRound || u * u + v * v <= 1) return std::nullopt;
    return TargetFault{fmt::format("{} is round: there is nothing of it at {}", body.title(), selector),
                       "(0.5,0.5) is its middle"};
}

std::optional<TargetFault> percentFault(const BodyEntry& body, const std::string& selector) {
    if (!world::ropePlace(selector))
        return TargetFault{fmt::format("\"{}\" is not a place along a rope", selector), "write 0% … 100%"};
    if (body.outline.isLine) return std::nullopt;
    return TargetFault{fmt::format("{} is no rope: it has no {}", body.title(), selector), ""};
}

std::optional<TargetFault> selectorFaultIn(const BodyEntry& body, const std::string& selector) {
    if (selector.starts_with('#')) return indexFault(body, selector);
    if (selector.starts_with('(')) return uvFault(body, selector);
    if (selector.ends_with('%')) return percentFault(body, selector);
    const auto isGroup = [&](const std::string& name) {
        return std::find(body.outline.groups.begin(), body.outline.groups.end(), name) != body.outline.groups.end();
    };
    if (selector == "all" || isGroup(selector) || body.isFaulty) return std::nullopt;
    if (!world::commonGroups(selector, isGroup).empty()) return std::nullopt;
    std::vector<std::string> groups = body.outline.groups;
    groups.push_back("all");
    std::string remedy = suggestion(selector, groups);
    if (remedy.empty() && groups.size() <= 12) remedy = "it has " + joined(groups);
    return TargetFault{fmt::format("{} has no points \"{}\"", body.title(), selector), remedy};
}

}  // namespace

BodyIndex::BodyIndex(const world::SceneSpec& scene, const world::Kinds& kinds, const std::set<std::string>& faulty) {
    for (const auto& kind : kinds.bodies.all()) kinds_.push_back(kind.name);
    for (const world::BodySpec& spec : scene.bodies) {
        BodyEntry& body = bodies_.emplace_back();
        body.kind = spec.kind();
        body.name = spec.name;
        body.copies = spec.array.count.x * spec.array.count.y * spec.array.count.z;
        body.isFaulty = faulty.contains(body.title());
        try {
            body.outline = spec.outline(scene);
        } catch (const core::Error&) {  // it cannot be built; building reports why
            body.isFaulty = body.outline.hasSurface = true;
        }
        body.solver = spec.solver;
        if (body.outline.hasSurface && !body.isFaulty &&
            std::find(surfaceKinds_.begin(), surfaceKinds_.end(), body.kind) == surfaceKinds_.end())
            surfaceKinds_.push_back(body.kind);
    }
    const auto isBefore = [](const BodyEntry& a, const BodyEntry& b) { return a.title() < b.title(); };
    std::sort(bodies_.begin(), bodies_.end(), isBefore);
}

std::optional<TargetFault> BodyIndex::pointsFault(const std::string& target) const {
    if (auto fault = bodiesFault(target)) return fault;
    const std::size_t at = target.find('@');
    if (at == std::string::npos) {
        return TargetFault{fmt::format("\"{}\" selects no points", target),
                           fmt::format("write {}@all or another selector", target)};
    }
    const std::string selector = target.substr(at + 1);
    for (const BodyEntry* body : matches(target))
        if (auto fault = selectorFaultIn(*body, selector)) return fault;
    return std::nullopt;
}

std::optional<TargetFault> BodyIndex::tieableFault(const std::string& target) const {
    if (auto fault = bodiesFault(target)) return fault;
    const std::size_t at = target.find('@');
    for (const BodyEntry* body : matches(target)) {
        const std::vector<std::string>& places = body->outline.places;
        const bool isWhole = at == std::string::npos && !places.empty();
        const bool isPlace =
            at != std::string::npos && std::find(places.begin(), places.end(), target.substr(at + 1)) != places.end();
        if (isWhole || isPlace) continue;
        if (at == std::string::npos) return pointsFault(target);
        if (auto fault = selectorFaultIn(*body, target.substr(at + 1))) return fault;
    }
    return std::nullopt;
}

std::optional<TargetFault> BodyIndex::targetFault(const std::string& target) const {
    return target.find('@') == std::string::npos ? bodiesFault(target) : pointsFault(target);
}

std::optional<TargetFault> BodyIndex::bodyFault(const std::string& target) const {
    if (target.find('@') == std::string::npos) return bodiesFault(target);
    return TargetFault{fmt::format("\"{}\" names points, not a body", target),
                       fmt::format("write {}", withoutSelector(target))};
}

std::optional<TargetFault> BodyIndex::surfaceFault(const std::string& target) const {
    if (auto fault = bodyFault(target)) return fault;
    for (const BodyEntry* body : matches(target))
        if (!body->outline.hasSurface)
            return TargetFault{fmt::format("a {} has no surface", body->kind),
                               "bodies with a surface are " + joined(surfaceKinds_)};
    return std::nullopt;
}

std::optional<TargetFault> BodyIndex::betweenFault(const std::string& first, const std::string& second) const {
    const std::vector<std::string> bodies = names(first);
    if (bodies.size() != 1 || bodies != names(second)) return std::nullopt;
    return TargetFault{fmt::format("{} and {} are the same body, with nothing in between", first, second),
                       "name another body"};
}

std::optional<TargetFault> BodyIndex::selectorFault(const std::string& title, const std::string& selector) const {
    for (const BodyEntry& body : bodies_)
        if (body.title() == title) return selectorFaultIn(body, selector);
    return std::nullopt;
}

std::vector<const BodyEntry*> BodyIndex::matches(const std::string& target) const {
    std::vector<const BodyEntry*> found;
    for (const BodyEntry& body : bodies_)
        if (fits(withoutSelector(target), body)) found.push_back(&body);
    return found;
}

std::vector<std::string> BodyIndex::names(const std::string& target) const {
    const std::string_view pattern = withoutSelector(target);
    std::vector<std::string> found;
    for (const BodyEntry* body : matches(target)) {
        if (body->copies == 1) found.push_back(body->title());
        for (int i = 0; body->copies > 1 && i < body->copies; ++i) {
            std::string name = fmt::format("{}.{}", body->title(), i);
            if (core::matches(pattern, name)) found.push_back(std::move(name));
        }
    }
    return found;
}

std::optional<TargetFault> BodyIndex::bodiesFault(const std::string& target) const {
    const std::string title(withoutSelector(target));
    const std::string kind(kindOf(title));
    if (kind.size() == title.size())
        return TargetFault{fmt::format("\"{}\" names no body", target), "write KIND.NAME, e.g. cloth.flag"};
    if (std::find(kinds_.begin(), kinds_.end(), kind) == kinds_.end()) {
        std::string remedy = suggestion(kind, kinds_);
        if (remedy.empty()) remedy = "bodies are " + joined(kinds_);
        return TargetFault{fmt::format("\"{}\" is no kind of body", kind), remedy};
    }
    if (!matches(title).empty()) return std::nullopt;
    std::vector<std::string> titles;
    for (const BodyEntry& body : bodies_) {
        titles.push_back(body.title());
        const bool isBeyond = body.copies > 1 && title.starts_with(body.title() + ".");
        if (isBeyond) {
            return TargetFault{fmt::format("there is no {}", title),
                               fmt::format("the copies are {0}.0 … {0}.{1}", body.title(), body.copies - 1)};
        }
        if (body.title() != title) continue;
        return TargetFault{fmt::format("{} is an array", title),
                           fmt::format("write {0}.0 … {0}.{1}, or {0}.*", title, body.copies - 1)};
    }
    return TargetFault{fmt::format("there is no {}", title), suggestion(title, titles)};
}

}  // namespace taut::scene
