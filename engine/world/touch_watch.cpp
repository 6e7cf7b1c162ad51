#include "taut/world/touch_watch.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "taut/world/body.h"

namespace taut::world {
namespace {

// Of an edge and a triangle's plane: how far the nearer end is from it.
double depthOf(const Touching& touching, const contact::Crossing& crossing) {
    const auto at = [&](std::size_t k) { return touching.position(crossing.points[k]); };
    const dvec3 normal = glm::cross(at(3) - at(2), at(4) - at(2));
    const double size = std::sqrt(glm::dot(normal, normal));
    if (!(size > 0)) return 0;
    const double a = std::abs(glm::dot(normal, at(0) - at(2))), b = std::abs(glm::dot(normal, at(1) - at(2)));
    return std::min(a, b) / size;
}

std::string crossingText(const std::string& first, const std::string& second, double start, std::size_t edges) {
    char text[200];
    const bool isOne = first == second;
    std::snprintf(text, sizeof text, "%s crossed %s since %.2f s (%zu edge%s); %s being drawn apart",
                  isOne ? "has" : "have", isOne ? "itself" : "each other", start, edges, edges == 1 ? "" : "s",
                  isOne ? "it is" : "they are");
    return (isOne ? first : first + " and " + second) + " " + text;
}

}  // namespace

std::vector<BodyCrossing> crossingsOf(Touching& touching) {
    std::vector<BodyCrossing> all;
    for (const contact::Crossing& crossing : touching.crossings()) {
        const auto& elements = touching.elements();
        const int edge = elements.edges()[static_cast<std::size_t>(crossing.edge)].surface;
        const int triangle = elements.triangles()[static_cast<std::size_t>(crossing.triangle)].surface;
        if (!touching.isOfBody(edge)) continue;  // a collider's stands out of a face
        all.push_back({crossing.place, depthOf(touching, crossing), &touching.bodyOf(edge), &touching.bodyOf(triangle),
                       crossing.edge});
    }
    return all;
}

void TouchWatch::look(const Touching& touching, double start) {
    contacts_.clear();
    hasMet_ = hasMet_ || touching.hasMet();
    for (const contact::Touching& c : touching.contacts())
        if (touching.isOfBody(c.surfaceA) && touching.isOfBody(c.surfaceB))
            contacts_.push_back(
                {c.place, c.normal, c.impulse, &touching.bodyOf(c.surfaceA), &touching.bodyOf(c.surfaceB)});
    if (touching.crossingsBefore().empty()) return;
    std::map<std::pair<std::string, std::string>, std::set<int>> edges;
    for (const contact::Crossing& crossing : touching.crossingsBefore()) {
        const auto& elements = touching.elements();
        const int edge = elements.edges()[static_cast<std::size_t>(crossing.edge)].surface;
        if (!touching.isOfBody(edge)) continue;
        const Body* a = &touching.bodyOf(edge);
        const Body* b = &touching.bodyOf(elements.triangles()[static_cast<std::size_t>(crossing.triangle)].surface);
        if (sortsBefore(*b, *a)) std::swap(a, b);
        edges[{a->fullName(), b->fullName()}].insert(crossing.edge);
    }
    for (const auto& [names, crossed] : edges) {
        const auto& [first, second] = names;
        bool isKnown = false;
        for (const Said& said : said_) isKnown = isKnown || (said.first == first && said.second == second);
        if (!isKnown) said_.push_back({first, second, crossingText(first, second, start, crossed.size())});
    }
}

void TouchWatch::forget(const Body& body) {
    std::erase_if(
        contacts_, [&](const BodyContact& c) { return c.first == &body || c.second == &body; });
}

std::vector<std::string> TouchWatch::warnings() const {
    std::vector<std::string> all;
    for (const Said& said : said_) all.push_back(said.text);
    return all;
}

void TouchWatch::visit(StateBytes& bytes, std::span<const Body* const> bodies) {
    bytes.each(said_, [&](Said& said) {
        for (std::string* text : {&said.first, &said.second, &said.text}) bytes(*text);
    });
    bytes.each(contacts_, [&](BodyContact& c) {
        bytes(c.place);
        bytes(c.normal);
        bytes(c.impulse);
        for (const Body** body : {&c.first, &c.second}) {
            auto number = static_cast<std::int64_t>(std::find(bodies.begin(), bodies.end(), *body) - bodies.begin());
            bytes.atLeast(number, 0, static_cast<std::int64_t>(bodies.size()) - 1);
            *body = bodies[static_cast<std::size_t>(number)];
        }
    });
}

}  // namespace taut::world
