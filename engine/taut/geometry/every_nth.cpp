#include "taut/geometry/every_nth.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "taut/geometry/private/parts.h"

namespace taut::geometry {
namespace {

glm::dvec3 placeOf(const view::Surface& surface, std::size_t vertex) {
    return glm::dvec3(surface.transform * glm::vec4(surface.geometry->positions[vertex], 1.0F));
}

bool isStill(const view::Surface& a, const view::Surface& b) {
    return a.geometry == b.geometry && a.transform == b.transform;
}

bool isOfOneKind(const view::Surface* a, const view::Surface* b) {
    return (a->topology == b->topology || a->topology->triangles == b->topology->triangles) &&
           a->geometry->positions.size() == b->geometry->positions.size();
}

using Pieces = std::map<std::string, std::vector<const view::Surface*>>;  // by the name of the body

Pieces piecesOf(const view::FrameView& view) {
    Pieces pieces;
    for (const view::Surface& surface : view.surfaces) pieces[PartFinder::fullName(surface)].push_back(&surface);
    return pieces;
}

// The surfaces with other triangles, and why.
std::set<std::string> changesBetween(const view::FrameView& from, const view::FrameView& to) {
    std::set<std::string> changes;
    const Pieces before = piecesOf(from), after = piecesOf(to);
    for (const auto& [name, pieces] : before)
        if (const auto now = after.find(name); now == after.end())
            changes.insert(name + " goes");
        else if (!std::equal(pieces.begin(), pieces.end(), now->second.begin(), now->second.end(), isOfOneKind))
            changes.insert(name + " tears or is cut");
    for (const auto& [name, pieces] : after)
        if (!before.contains(name)) changes.insert(name + " appears");
    return changes;
}

}  // namespace

EveryNth::EveryNth(GeometrySink& sink, std::int64_t first, std::int64_t last, std::int64_t every,
                   std::function<bool(const std::string&)> isWanted)
    : sink_(sink), first_(first), last_(last), every_(every), isWanted_(std::move(isWanted)) {
    TAUT_EXPECTS(every >= 1);
}

void EveryNth::write(const view::FrameView& view) {
    if ((view.frame - first_) % every_ != 0 && view.frame != last_) {
        between_.push_back(view);
        return;
    }
    measure(view);
    between_.clear();
    sink_.write(view);
    if (every_ > 1) from_ = view;
}

void EveryNth::measure(const view::FrameView& to) {
    for (const view::FrameView& at : between_) {
        ++lost_.frames;
        std::set<std::string> changes = changesBetween(from_, at);
        changes.merge(changesBetween(from_, to));
        if (changes.empty())
            measure(at, to);
        else
            ++lost_.unmeasured;
        lost_.changes.merge(changes);
    }
}

void EveryNth::measure(const view::FrameView& at, const view::FrameView& to) {
    const double share = static_cast<double>(at.frame - from_.frame) / static_cast<double>(to.frame - from_.frame);
    for (std::size_t i = 0; i < to.surfaces.size(); ++i) {
        const view::Surface &a = from_.surfaces[i], &x = at.surfaces[i], &b = to.surfaces[i];
        if ((isStill(a, b) && isStill(a, x)) || (isWanted_ && !isWanted_(PartFinder::fullName(x)))) continue;
        for (std::size_t v = 0; v < x.geometry->positions.size(); ++v) {
            const glm::dvec3 off = glm::mix(placeOf(a, v), placeOf(b, v), share) - placeOf(x, v);
            const double square = glm::dot(off, off);
            sum_ += square;
            ++count_;
            if (square <= lost_.worst * lost_.worst) continue;
            lost_.worst = std::sqrt(square);
            lost_.worstFrame = at.frame;
            lost_.worstName = PartFinder::fullName(x);
        }
    }
}

LostMotion EveryNth::lost() const {
    LostMotion lost = lost_;
    lost.rms = count_ > 0 ? std::sqrt(sum_ / static_cast<double>(count_)) : 0.0;
    return lost;
}

}  // namespace taut::geometry
