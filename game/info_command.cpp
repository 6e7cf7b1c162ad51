#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/flags.h"
#include "game/messages.h"
#include "game/scene_file.h"
#include "game/usage.h"
#include "taut/advice/bending_cells.h"
#include "taut/advice/private/start_doubts.h"
#include "taut/bodies/cloth.h"
#include "taut/body/private/solid_places.h"
#include "taut/core/error.h"
#include "taut/core/private/contains.h"
#include "taut/core/private/parallel.h"
#include "taut/mechanics/sheet_moduli.h"
#include "taut/ode/method_table.h"
#include "taut/pipeline/run.h"
#include "taut/scene/private/body_size.h"
#include "taut/spec/targets.h"
#include "taut/world/world.h"

namespace taut::game {
namespace {

using Json = nlohmann::ordered_json;

struct InfoFlags {
    std::string scene;
    std::vector<std::string> overrides;
    std::string pointsOf;
    bool json = false;
    bool methods = false;
};

// Of processor time, all threads together [s].
struct TickCost {
    double spent = 0.0;                          // on the ticks that were played
    std::int64_t ticks = 0, from = 0;            // how many; the first of the ones that represent the rest
    double least = 0.0, mean = 0.0, most = 0.0;  // of these; between the outer two eight of ten lie
    double asleep = 0.0;                         // share of points that slept, mean over the ticks that were played
    double ofAll(std::int64_t all) const { return spent + mean * static_cast<double>(all - ticks); }
};

// Plays the scene for some seconds and looks at the clock. The rest is assumed to run as the later half of that time,
// for bodies meet that were apart.
TickCost measuredCost(world::World& world, std::int64_t ticks) {
    constexpr double enough = 3.0;  // [s]
    std::vector<double> costs;
    TickCost cost;
    try {
        while (cost.ticks < ticks && cost.spent < enough) {
            const double before = core::processorSeconds();
            if (world.advance()) break;
            costs.push_back(core::processorSeconds() - before);
            cost.asleep += world.asleepShare();
            cost.spent += costs.back();
            ++cost.ticks;
        }
    } catch (const core::Error& error) {  // an action that finds nothing: taut check says so
        if (error.kind() != core::ErrorKind::badContent) throw;
    }
    if (costs.empty()) return cost;
    cost.asleep /= static_cast<double>(cost.ticks);
    double late = 0.0;
    for (cost.from = cost.ticks; cost.from > 0 && late < 0.5 * cost.spent;) late += costs[--cost.from];
    if (cost.from == cost.ticks) cost.from = 0;  // finer than the clock
    costs.erase(costs.begin(), costs.begin() + cost.from);
    std::ranges::sort(costs);
    const std::size_t tenth = costs.size() / 10;
    cost.least = costs[tenth];
    cost.mean = late / static_cast<double>(costs.size());
    cost.most = costs[costs.size() - 1 - tenth];
    return cost;
}

bool mayHaveContacts(const world::SceneSpec& spec) {
    const auto collides = [](const world::BodySpec& body) { return body.collide; };
    return world::bodiesTouch(spec) ||
           (!spec.colliders.empty() && std::any_of(spec.bodies.begin(), spec.bodies.end(), collides));
}

struct Facts {
    world::SceneSpec spec;
    std::vector<world::IslandInfo> islands;
    std::vector<world::JointInfo> joints;
    world::ContactInfo contact;  // of the ticks that were measured
    std::vector<core::Finding> warnings;
    std::vector<std::string> notes;
    double tickSeconds = 0.0;
    int ticksPerFrame = 1;
    std::int64_t frames = 0;
    TickCost cost;
    std::int64_t ticks() const { return std::max<std::int64_t>(1, (frames - 1) * ticksPerFrame); }
};

Facts gatherFacts(const InfoFlags& flags) {
    Facts facts;
    facts.spec = readScene(flags.scene, flags.overrides);
    notePreparation(facts.spec);
    world::World world(facts.spec);
    facts.islands = world.islands();
    facts.joints = world.joints();
    facts.warnings = world.warnings();
    for (core::Finding& doubt : world::startDoubts(world)) facts.warnings.push_back(std::move(doubt));
    facts.notes = world::coarseCells(facts.spec);
    facts.tickSeconds = world.tickSeconds();
    facts.ticksPerFrame = world.ticksPerFrame();
    facts.frames = pipeline::frameCount(facts.spec.run);
    facts.cost = measuredCost(world, facts.ticks());
    facts.contact = world.contact();
    return facts;
}

Json islandJson(const world::IslandInfo& i) {
    return {{"name", i.name},
            {"bodies", i.bodies},
            {"points", i.points},
            {"held_points", i.heldPoints},
            {"springs", i.springs},
            {"runs", i.runs},
            {"single_springs", i.singles},
            {"cells", i.cells},
            {"constraints", i.constraints},
            {"mass_kg", i.mass},
            {"method", i.method},
            {"omega_B1_per_s", i.omegaBound},
            {"omega_B2_per_s", i.omegaNow},
            {"omega_lanczos_per_s", i.omegaEstimate},
            {"step_limit_s", i.stepLimit},
            {"step_s", i.step},
            {"substeps", i.substeps},
            {"follows_state", i.followsState},
            {"splits_dashpots", i.splitsDashpots},
            {"limited_by", i.limitingSpring},
            {"advice", i.advice},
            {"bytes", i.bytes}};
}

int countOf(const world::JointInfo& joint) {
    int points = 0;
    for (const auto& pair : joint.pairs) points += pair.points;
    return points;
}

Json jointJson(const world::JointInfo& joint) {
    Json pairs = Json::array();
    for (const auto& pair : joint.pairs) pairs.push_back({{"a", pair.a}, {"b", pair.b}, {"points", pair.points}});
    return {{"a", joint.a},
            {"b", joint.b},
            {"name", joint.name},
            {"kind", joint.kind},
            {"points", countOf(joint)},
            {"left", joint.left},
            {"pairs", std::move(pairs)},
            {"largest_jump_m", joint.jump},
            {"loose", joint.loose}};
}

double meanDetections(const world::ContactInfo& contact) {
    return contact.ticks > 0 ? static_cast<double>(contact.detections) / static_cast<double>(contact.ticks) : 0.0;
}

// [s] of wall time, of a point and detection.
double detectionSeconds(const world::ContactInfo& contact) {
    const double detections = static_cast<double>(contact.detections) * contact.points;
    return detections > 0 ? contact.seconds / detections : 0.0;
}

Json contactJson(const world::ContactInfo& contact) {
    if (contact.bodies.empty()) return nullptr;
    Json bodies = Json::array();
    for (std::size_t i = 0; i < contact.bodies.size(); ++i)
        bodies.push_back({{"name", contact.bodies[i]},
                          {"thickness_m", contact.surfaces[i].thickness},
                          {"shortest_edge_m", contact.surfaces[i].shortestEdge}});
    return {{"bodies", std::move(bodies)},
            {"points", contact.points},
            {"most_detections", contact.mostDetections},
            {"mean_detections", meanDetections(contact)},
            {"ticks", contact.ticks},
            {"s_per_point_and_detection", detectionSeconds(contact)},
            {"bytes", contact.bytes}};
}

void printJson(const Facts& facts) {
    Json islands = Json::array(), joints = Json::array();
    for (const world::IslandInfo& island : facts.islands) islands.push_back(islandJson(island));
    for (const world::JointInfo& joint : facts.joints) joints.push_back(jointJson(joint));
    const int perFrame = facts.ticksPerFrame;
    const Json json = {{"scene", facts.spec.file},
                       {"title", facts.spec.title},
                       {"fps", facts.spec.run.fps},
                       {"frames", facts.frames},
                       {"tick_s", facts.tickSeconds},
                       {"ticks_per_frame", facts.ticksPerFrame},
                       {"processor_s_per_frame", {facts.cost.least * perFrame, facts.cost.most * perFrame}},
                       {"processor_s", facts.cost.ofAll(facts.ticks())},
                       {"rehearsed_ticks", facts.cost.ticks},
                       {"asleep", facts.cost.asleep},
                       {"contacts_may_come", mayHaveContacts(facts.spec)},
                       {"islands", std::move(islands)},
                       {"joints", std::move(joints)},
                       {"contact", contactJson(facts.contact)},
                       {"colliders", facts.spec.colliders.size()},
                       {"warnings", printed(facts.warnings)},
                       {"notes", facts.notes}};
    printResult("{}\n", json.dump(2, ' ', true, Json::error_handler_t::replace));
}

// Each material as a continuum, of the first cloth made of it.
void printMaterials(const world::SceneSpec& spec) {
    std::vector<std::string> known;
    for (const world::ClothSpec& cloth : spec.bodies.of<world::ClothSpec>()) {
        if (core::contains(known, cloth.material)) continue;
        known.push_back(cloth.material);
        const mechanics::SheetStiffness sheet = mechanics::sheetStiffness(cloth.build(spec));
        printResult("\nmaterial {} in the cells of cloth.{}\n", cloth.material, cloth.name);
        for (const double angle : {0.0, 22.5, 45.0, 90.0}) {
            const mechanics::StripModuli strip = sheet.at(angle * std::numbers::pi / 180.0);
            if (strip.young > 0)
                printResult("  at {:>4}°    {:.4g} N/m, Poisson's ratio {:.3f}\n", angle, strip.young, strip.poisson);
        }
    }
}

void printIsland(const world::IslandInfo& i) {
    printResult("\n{}\n", fmt::join(i.bodies, ", "));
    printResult("  points      {} ({} held), {:.4g} kg\n", i.points, i.heldPoints, i.mass);
    printResult("  springs     {} ({} runs, {} single){}\n", i.springs, i.runs, i.singles,
                i.cells > 0 ? fmt::format(", {} volume cells", i.cells) : "");
    if (i.constraints > 0) printResult("  constraints {}\n", i.constraints);
    printResult("  omega       {:.4g} /s bound of any shape, {:.4g} /s bound now, {:.4g} /s estimated (Lanczos)\n",
                i.omegaBound, i.omegaNow, i.omegaEstimate);
    if (std::isfinite(i.stepLimit))
        printResult("  step limit  {:.4g} ms by {}\n", 1e3 * i.stepLimit,
                    i.limitingSpring.empty() ? "nothing" : i.limitingSpring);
    else
        printResult("  step limit  none\n");
    for (const std::string& advice : i.advice) printResult("              {}\n", advice);
    printResult("  step        {:.4g} ms = tick / {}, {}{}{}\n", 1e3 * i.step, i.substeps, i.method,
                i.splitsDashpots ? ", dashpots split off" : "",
                i.followsState ? ", and follows the current bound" : "");
    printResult("  memory      {:.3g} MB\n", static_cast<double>(i.bytes) / 1e6);
}

std::string lengthText(double metres) {
    return metres < 0.01 ? fmt::format("{:.3g} mm", 1e3 * metres) : fmt::format("{:.3g} m", metres);
}

void printJoint(const world::JointInfo& joint) {
    const int points = countOf(joint);
    const std::string name = joint.name.empty() ? "" : " \"" + joint.name + "\"";
    printResult("\n{}{} {} – {}: {} point{}{}\n", joint.kind == "spring" ? "spring joint" : joint.kind, name, joint.a,
                joint.b, points, points == 1 ? "" : "s",
                joint.jump > 0 ? fmt::format(", moved together by up to {}", lengthText(joint.jump)) : "");
    for (const auto& pair : joint.pairs) printResult("  {} – {}  {}\n", pair.a, pair.b, pair.points);
}

void printContact(const world::ContactInfo& contact) {
    if (contact.bodies.empty()) return;
    printResult("\ncontact of {}\n", fmt::join(contact.bodies, ", "));
    printResult("  detections  {} a tick at most{}\n", contact.mostDetections,
                contact.ticks > 0
                    ? fmt::format(", {:.3g} in the mean of the first {} ticks", meanDetections(contact), contact.ticks)
                    : "");
    if (contact.ticks > 0)
        printResult("  cost        {:.3g} us a point and detection, {} points\n", 1e6 * detectionSeconds(contact),
                    contact.points);
    // Of the body whose layers lie furthest apart for its cells.
    std::size_t worst = 0;
    const auto share = [&](std::size_t i) {
        const world::ContactInfo::SurfaceSizes& surface = contact.surfaces[i];
        return surface.shortestEdge > 0 ? surface.thickness / surface.shortestEdge : 0.0;
    };
    for (std::size_t i = 1; i < contact.bodies.size(); ++i)
        if (share(i) > share(worst)) worst = i;
    const world::ContactInfo::SurfaceSizes& surface = contact.surfaces[worst];
    printResult("  distance    layers of {} lie {} apart, its shortest edge is {}\n", contact.bodies[worst],
                lengthText(2 * surface.thickness), lengthText(surface.shortestEdge));
    printResult("  memory      {:.3g} MB\n", static_cast<double>(contact.bytes) / 1e6);
}

// "9.1 to 9.9 ms".
std::string rangeText(double least, double most, double scale, std::string_view unit) {
    const std::string low = fmt::format("{:.2g}", least * scale), high = fmt::format("{:.2g}", most * scale);
    return low == high ? fmt::format("{} {}", low, unit) : fmt::format("{} to {} {}", low, high, unit);
}

std::string durationText(double seconds) {
    return seconds < 90 ? fmt::format("{:.2g} s", seconds) : fmt::format("{:.2g} minutes", seconds / 60);
}

void printCost(const Facts& facts, double pointSteps) {
    const TickCost& cost = facts.cost;
    const int perFrame = facts.ticksPerFrame;
    const std::int64_t ticks = facts.ticks();
    printResult(
        "simulation about {} of processor time for the whole scene, {} a frame ({:.3g} ns a point and step){}\n",
        durationText(cost.ofAll(ticks)), rangeText(cost.least * perFrame, cost.most * perFrame, 1e3, "ms"),
        pointSteps > 0.0 ? 1e9 * cost.mean / pointSteps : 0.0,
        cost.ticks < ticks ? fmt::format(": {} of {} ticks simulated, the others as the last {} of these", cost.ticks,
                                         ticks, cost.ticks - cost.from)
                           : "");
    if (facts.spec.solver.sleepError > 0)
        printResult("asleep {:.3g} % of the points, mean of the {} ticks simulated\n", 100.0 * cost.asleep, cost.ticks);
}

void printTable(const Facts& facts) {
    const world::SceneSpec& spec = facts.spec;
    printResult("{}{}\n", spec.file, spec.title.empty() ? "" : ": " + spec.title);
    printResult("{} frames at {:.4g} a second, tick {:.4g} ms = frame / {}, {} precision, {}x{} pixels\n", facts.frames,
                spec.run.fps, 1e3 * facts.tickSeconds, facts.ticksPerFrame,
                spec.solver.precision == world::Precision::double_ ? "double" : "single", spec.picture.size.x,
                spec.picture.size.y);
    for (const world::IslandInfo& island : facts.islands) printIsland(island);
    for (const world::JointInfo& joint : facts.joints) printJoint(joint);
    printMaterials(spec);
    printContact(facts.contact);

    int points = 0;
    int springs = 0;
    double pointSteps = 0.0;
    for (const world::IslandInfo& island : facts.islands) {
        points += island.points;
        springs += island.springs;
        pointSteps += static_cast<double>(island.points) * island.substeps;
    }
    const scene::SceneSize size = scene::wholeSizeOf(spec);
    printResult(
        "\nin all {} points, {} springs, {} islands, {} colliders, about {:.3g} MB, {:.3g} MB of it for pictures\n",
        points, springs, facts.islands.size(), spec.colliders.size(), size.bytes() / 1e6, size.pictures / 1e6);
    if (facts.cost.ticks > 0) printCost(facts, pointSteps);
    for (const core::Finding& warning : facts.warnings)
        printResult("{}{}\n", warning.source.file.empty() ? "warning: " : "", printed(warning));
    for (const std::string& note : facts.notes) printResult("note: {}\n", note);
}

Json methodsJson() {
    Json all = Json::array();
    for (const ode::MethodInfo& m : ode::methods())
        all.push_back({{"name", m.name},
                       {"title", m.title},
                       {"order", m.order},
                       {"evaluations_per_step", m.evaluations},
                       {"stored_arrays", m.storedArrays},
                       {"symplectic", m.symplectic},
                       {"reversible", m.reversible},
                       {"any_first_order_system", m.isFirstOrder()},
                       {"omega_h_undamped", m.largestStep({.omega = 1.0})},  // null: none
                       {"stability_limit", m.limit},
                       {"caution", m.caution}});
    return all;
}

// ω h that undamped motion stands.
std::string undampedLimit(const ode::MethodInfo& method) {
    const double limit = method.largestStep({.omega = 1.0});
    return std::isfinite(limit) ? fmt::format("{:.4g}", limit) : "none";
}

void printMethods() {
    printResult("{:<17} {:<16} {:>5} {:>6} {:>7} {:>10} {:>10} {:>6} {:>6}  {}\n", "name", "method", "order", "evals",
                "arrays", "symplectic", "reversible", "y'=f", "limit", "largest stable ωh at damping ratio ζ");
    const auto yes = [](bool is) { return is ? "yes" : "-"; };
    for (const ode::MethodInfo& m : ode::methods())
        printResult("{:<17} {:<16} {:>5} {:>6} {:>7} {:>10} {:>10} {:>6} {:>6}  {}\n", m.name, m.title, m.order,
                    m.evaluations, m.storedArrays, yes(m.symplectic), yes(m.reversible), yes(m.isFirstOrder()),
                    undampedLimit(m), m.limit);
    printResult(
        "\n"
        "evals: force evaluations per step, besides the solves of implicit methods. arrays: kept besides positions and "
        "velocities, of their size. y'=f: any\n"
        "first-order system, not x'' = a only. limit: of ωh without damping; 0 is unstable at every step.\n"
        "order: with dashpots and drag too; contact lowers it to 1, and the drag of wind along triangles lowers\n"
        "order 4 to 2.\n");
}

// Names of points, and the corners of a box.
std::vector<std::pair<std::string, std::vector<int>>> namedPoints(const world::Body& body) {
    std::vector<std::pair<std::string, std::vector<int>>> named;
    for (const auto& [name, points] : body.model.groups)
        if (name != "all" && !points.empty()) named.emplace_back(name, points);
    for (const char* depth : {"back", "front"})
        for (const char* height : {"bottom", "top"})
            for (const char* width : {"left", "right"}) {
                const std::string name = fmt::format("{}-{}-{}", depth, height, width);
                if (auto corner = world::selectPoints(body.model, name); corner.size() == 1)
                    named.emplace_back(name, std::move(corner));
            }
    return named;
}

// As the scene starts.
Json pointsJson(const world::Body& body) {
    const auto jsonOf = [](const glm::dvec3& x) { return Json{x.x, x.y, x.z}; };
    Json positions = Json::array(), names = Json::object(), places = Json::object();
    for (const glm::dvec3& x : body.model.positions) positions.push_back(jsonOf(x));
    for (const auto& [name, points] : namedPoints(body)) names[name] = points;
    for (const std::string& name : world::placeNames(body.model)) places[name] = jsonOf(*world::placeNamed(body, name));
    return {{"name", body.fullName()}, {"positions_m", positions}, {"points", names}, {"places_m", places}};
}

// Each name once, with its points or its place as the scene starts.
void printPoints(const world::Body& body) {
    const auto textOf = [](const glm::dvec3& x) {
        const auto number = [](double own) { return std::abs(own) < 1e-12 ? 0.0 : own; };
        return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", number(x.x), number(x.y), number(x.z));
    };
    printResult("{}: {} points\n", body.fullName(), body.model.pointCount());
    for (const auto& [name, points] : namedPoints(body)) {
        constexpr std::size_t shown = 8;
        std::vector<std::string> numbers;
        for (const int i : points)
            if (numbers.size() < shown) numbers.push_back(fmt::format("#{}", i));
        const bool isOne = points.size() == 1;
        printResult("  @{:<24} {}{}\n", name, fmt::join(numbers, " "),
                    isOne                   ? "  " + textOf(body.model.positions[points[0]])
                    : points.size() > shown ? fmt::format(" … {} in all", points.size())
                                            : "");
    }
    for (const std::string& name : world::placeNames(body.model))
        printResult("  @{:<24} {}\n", name, textOf(*world::placeNamed(body, name)));
}

int infoPoints(const InfoFlags& flags) {
    const world::SceneSpec spec = readScene(flags.scene, flags.overrides);
    std::vector<world::Body> bodies = world::buildBodies(spec);
    const std::vector<world::Body*> found = world::matchBodies(world::pointersTo(bodies), flags.pointsOf);
    if (found.empty()) {
        std::vector<std::string> names;
        for (const world::Body& body : bodies) names.push_back(body.fullName());
        failUsage("--points {}: there is no such body; there are {}", flags.pointsOf, fmt::join(names, ", "));
    }
    if (flags.json) {
        Json all = Json::array();
        for (const world::Body* body : found) all.push_back(pointsJson(*body));
        printResult("{}\n", all.dump(2));
        return static_cast<int>(ExitCode::ok);
    }
    for (const world::Body* body : found) printPoints(*body);
    return static_cast<int>(ExitCode::ok);
}

int info(const InfoFlags& flags) {
    if (flags.methods && !flags.scene.empty()) failUsage("--methods takes no scene: give one or the other");
    if (flags.methods) {
        if (flags.json)
            printResult("{}\n", methodsJson().dump(2));
        else
            printMethods();
        return static_cast<int>(ExitCode::ok);
    }
    if (flags.scene.empty()) failUsage("info: give a scene, or --methods");
    if (!flags.pointsOf.empty()) return infoPoints(flags);
    const Facts facts = gatherFacts(flags);
    if (flags.json)
        printJson(facts);
    else
        printTable(facts);
    return static_cast<int>(ExitCode::ok);
}

Action declareInfo(Options& options) {
    const auto flags = std::make_shared<InfoFlags>();
    options.value("SCENE", flags->scene, "A scene file, or the name of a shipped scene");
    addOverrideFlag(options, flags->overrides);
    options.value("--points", flags->pointsOf, "List the names of points and places of these bodies instead")
        .typeName("BODY");
    options.flag("--methods", flags->methods, "List the methods of integration instead");
    options.flag("--json", flags->json, "Print JSON");
    return withThreads(options, [flags] { return info(*flags); });
}

}  // namespace

Command infoCommand() {
    return {"info", "Show statistics of a scene: points, time step, memory, cost", declareInfo};
}

}  // namespace taut::game
