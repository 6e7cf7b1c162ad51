#include "taut/bodies/net.h"

#include <fmt/format.h>

#include <set>

#include "taut/drawing/drawing.h"
#include "taut/fields/private/problems.h"
#include "taut/mechanics/builders.h"
#include "taut/spec/common_rows.h"

namespace taut::world {

NetSpec::NetSpec() {
    thickness = radius;
}
TAUT_VALUE_COPIES(NetSpec);

using fields::FieldList;
using fields::notNegative;
using fields::positive;
using fields::Range;
using fields::Role;
using fields::Section;

namespace {

Section netPointSection() {
    Section section;
    section.fields = FieldList<NetPointSpec>()
                         .text("name", &NetPointSpec::name, Role::none, "Name.")
                         .required()
                         .vector("position", &NetPointSpec::position, "m", placeRange, "Initial position.")
                         .required()
                         .number("mass_kg", &NetPointSpec::mass, "kg", positive, "Mass.")
                         .flag("hold", &NetPointSpec::hold, "Whether it is pinned.")
                         .take();
    section.check = [](const fields::CheckInput& input, void* target) {
        const std::string& name = static_cast<const NetPointSpec*>(target)->name;
        if (input.table.find("name") == nullptr) return;
        if (!fields::isName(name)) {
            input.problems.addError(input.at("name"), fmt::format("\"{}\" cannot be the name of a point", name),
                                    "a name has letters, digits, - and _");
        } else if (name == "all") {
            input.problems.addError(input.at("name"), "\"all\" cannot be the name of a point: it means all of them");
        }
    };
    return section;
}

Section netSpringSection() {
    Section section;
    section.fields = FieldList<NetSpringSpec>()
                         .text("a", &NetSpringSpec::a, Role::none, "Name of the point at one end.")
                         .required()
                         .text("b", &NetSpringSpec::b, Role::none, "Name of the point at the other end.")
                         .required()
                         .number("stiffness_N_per_m", &NetSpringSpec::stiffness, "N/m", notNegative, "Spring constant.")
                         .number("rest_length_m", &NetSpringSpec::restLength, "m", Range{0.0, 1e6},
                                 "Rest length; default the initial distance.")
                         .number("damping_time_s", &NetSpringSpec::dampingTime, "s", dampingTimeRange,
                                 "Damping time; default the net's.")
                         .take();
    return section;
}

void checkNet(const fields::CheckInput& input, const NetSpec& net) {
    const auto report = [&](const char* list, std::size_t i, const char* key, const std::string& message,
                            const std::string& remedy) {
        const fields::Node& item = input.table.find(list)->value.items[i];
        const fields::Member* member = item.find(key);
        if (member != nullptr) input.problems.addError(member->value.place, message, remedy);
    };
    std::set<std::string> names;
    for (std::size_t i = 0; i < net.points.size(); ++i) {
        const std::string& name = net.points[i].name;
        if (names.insert(name).second) continue;
        report("points", i, "name", fmt::format("there is a point \"{}\" already", name), "");
    }
    const std::vector<std::string> known(names.begin(), names.end());
    for (std::size_t i = 0; i < net.springs.size(); ++i) {
        const NetSpringSpec& spring = net.springs[i];
        for (const auto& [key, end] : {std::pair{"a", spring.a}, std::pair{"b", spring.b}}) {
            if (names.contains(end)) continue;
            report("springs", i, key, fmt::format("there is no point \"{}\"", end), fields::suggestion(end, known));
        }
        if (spring.a == spring.b) report("springs", i, "b", "a spring needs two different points", "");
    }
}

}  // namespace

Section NetSpec::section() {
    Section section;
    section.help = "Points and springs listed one by one.";
    FieldList<NetSpec> list;
    list.tables("points", &NetSpec::points, netPointSection(), "Point masses.")
        .required()
        .tables("springs", &NetSpec::springs, netSpringSection(), "Springs.");
    section.fields = withPlasticity(withLosses(list))
                         .number("radius", &NetSpec::radius, "m", lengthRange,
                                 "Drawn radius of springs, and the default of the net's thickness.")
                         .number("ball", &NetSpec::ball, "m", lengthRange, "Drawn radius of points.")
                         .take();
    section.check = [](const fields::CheckInput& input, void* target) {
        auto& net = *static_cast<NetSpec*>(target);
        keepRadius(input, net.radius, net);
        if (input.isClean && net.points.empty()) input.problems.addError(input.at("points"), "a net needs points");
        checkNet(input, net);
    };
    return section;
}

mechanics::Model NetSpec::build(const SceneSpec&) const {
    std::vector<mechanics::NetPoint> masses;
    for (const NetPointSpec& p : points) masses.push_back({p.name, p.position, dvec3(0.0), p.mass, drag, p.hold});
    std::vector<mechanics::NetSpring> ties;
    for (const NetSpringSpec& s : springs)
        ties.push_back({s.a, s.b, s.stiffness, s.restLength, s.dampingTime.value_or(dampingTime)});
    return mechanics::buildNet(masses, ties);
}

std::unique_ptr<BodyDrawing> NetSpec::drawing(const Body& body) const {
    return rodDrawing(body, radius, ball);
}

BodyOutline NetSpec::outline(const SceneSpec&) const {
    BodyOutline outline;
    outline.points = static_cast<double>(points.size());
    outline.springs = static_cast<double>(springs.size());
    for (const NetPointSpec& point : points) outline.groups.push_back(point.name);
    return outline;
}

Kind<BodySpec> netKind() {
    return bodyKind<NetSpec>();
}

}  // namespace taut::world
