#include "taut/world/private/contact_report.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "taut/body/body.h"

namespace taut::world {
namespace {

constexpr std::uint64_t spansMark = 0xfff8'7461'7574'0005ULL;     // a NaN
constexpr std::uint64_t squeezedMark = 0xfff8'7461'7574'0009ULL;  // a NaN

// With the time: "since 1.20 s", "from 1.20 s to 1.35 s".
std::string crossingText(const std::string& first, const std::string& second, const std::string& when,
                         std::int64_t edges, std::int64_t times, bool isOn) {
    const bool isOne = first == second;
    std::string text = isOne ? first : first + " and " + second;
    if (isOn) text += isOne ? " has" : " have";
    text += std::string(" crossed ") + (isOne ? "itself " : "each other ") + when + " (" + std::to_string(edges) +
            (edges == 1 ? " edge" : " edges") + (times > 1 ? ", " + std::to_string(times) + " times in all)" : ")");
    if (isOn) return text + (isOne ? "; it is being drawn apart" : "; they are being drawn apart");
    return text + (isOne ? "; it has come apart" : "; they have come apart");
}

std::string moment(double seconds) {
    char text[40];
    std::snprintf(text, sizeof text, "%.2f s", seconds);
    return text;
}

}  // namespace

std::vector<BodyCrossing> crossingsOf(ContactStage& stage) {
    std::vector<BodyCrossing> all;
    for (const contact::Crossing& crossing : stage.crossings()) {
        const auto& elements = stage.elements();
        const int edge = elements.edges()[crossing.edge].surface;
        const int triangle = elements.triangles()[crossing.triangle].surface;
        if (!stage.isOfBody(edge) || !stage.isOfBody(triangle)) continue;
        all.push_back(
            {crossing.place, stage.depthOf(crossing), &stage.bodyOf(edge), &stage.bodyOf(triangle), crossing.edge});
    }
    return all;
}

void ContactReport::look(const ContactStage& stage, double start) {
    contacts_.clear();
    squeezed_.clear();
    for (const int point : stage.squeezed()) ++squeezed_[&stage.bodyOf(stage.elements().surfaceOf(point))];
    const auto bodyOf = [&](int surface) { return stage.isOfBody(surface) ? &stage.bodyOf(surface) : nullptr; };
    hadImpulse_ = hadImpulse_ || stage.hadImpulse();
    for (const contact::ContactPoint& c : stage.contacts())
        if (c.surfaceB == ContactStage::noSurface ||
            (!stage.elements().isRigid(c.surfaceA) && !stage.elements().isRigid(c.surfaceB)))
            contacts_.push_back({c.place, c.normal, c.impulse, bodyOf(c.surfaceA), bodyOf(c.surfaceB)});
    // Edges that cross, by the names of the two sides: two bodies, or a body and a figure.
    std::map<std::pair<std::string, std::string>, std::set<int>> edges;
    for (const contact::Crossing& crossing : stage.crossingsBefore())
        if (const auto sides = stage.sidesOf(crossing))
            edges[{stage.nameOf(sides->first), stage.nameOf(sides->second)}].insert(crossing.edge);
    // Updates old warnings: crossings go on, end, or come back.
    for (Said& said : said_) {
        const bool isOn = edges.count({said.first, said.second}) > 0;
        if (said.isOn) said.until = start;
        if (isOn && !said.isOn) ++said.times;
        if (!isOn || said.isOn) edges.erase({said.first, said.second});
        said.isOn = isOn;
    }
    // The remaining crossings began in this tick.
    for (const auto& [names, crossed] : edges) {
        const std::string &first = names.first, &second = names.second;
        auto said = std::find_if(said_.begin(), said_.end(),
                                 [&](const Said& s) { return s.first == first && s.second == second; });
        if (said == said_.end()) {
            said_.push_back({first, second, {}});
            said = said_.end() - 1;
        }
        said->since = said->until = start;
        said->edges = std::ssize(crossed);
        said->text = crossingText(first, second, "since " + moment(start), said->edges, said->times, true);
    }
}

void ContactReport::forget(const Body& body) {
    squeezed_.erase(&body);
    std::erase_if(contacts_, [&](const BodyContact& c) { return c.isOf(body); });
    for (Said& said : said_)
        if (said.first == body.fullName() || said.second == body.fullName()) said.isOn = false;
}

std::vector<std::string> ContactReport::warnings() const {
    std::vector<std::string> all;
    for (const Said& said : said_)
        all.push_back(said.isOn ? said.text
                                : crossingText(said.first, said.second,
                                               "from " + moment(said.since) + " to " + moment(said.until), said.edges,
                                               said.times, false));
    return all;
}

void ContactReport::visit(StateBytes& bytes, std::span<const Body* const> bodies) {
    const auto visitNumber = [&](const Body*& body) {
        auto number = static_cast<std::int64_t>(std::find(bodies.begin(), bodies.end(), body) - bodies.begin());
        const auto count = static_cast<std::int64_t>(bodies.size());  // of a figure
        bytes.atLeast(number, 0, count);
        body = number < count ? bodies[number] : nullptr;
    };
    bytes.each(said_, [&](Said& said) {
        for (std::string* text : {&said.first, &said.second, &said.text}) bytes(*text);
    });
    bytes.each(contacts_, [&](BodyContact& c) {
        bytes(c.place);
        bytes(c.normal);
        bytes(c.impulse);
        visitNumber(c.first);
        visitNumber(c.second);
    });
    if (bytes.mark(squeezedMark, !squeezed_.empty())) {
        std::vector<std::pair<const Body*, std::int64_t>> all(squeezed_.begin(), squeezed_.end());
        bytes.each(all, [&](auto& entry) {
            visitNumber(entry.first);
            bytes.atLeast(entry.second, 1, std::int64_t{1} << 32);
        });
        squeezed_ = {all.begin(), all.end()};
    }
    if (!bytes.mark(spansMark, !said_.empty())) return;
    for (Said& said : said_) {
        bytes(said.since);
        bytes(said.until);
        bytes(said.edges);
        bytes(said.times);
        bytes(said.isOn);
    }
}

}  // namespace taut::world
