#include "taut/pipeline/run_record.h"

#include <fmt/format.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "taut/core/numbers.h"
#include "taut/forces/wind.h"
#include "taut/island/metric_table.h"
#include "taut/pipeline/run_parts.h"
#include "taut/spec/spec.h"
#include "taut/world/result_bits.h"
#include "taut/world/world.h"

namespace taut::pipeline {
namespace {

using Json = nlohmann::ordered_json;

Json machineJson(const Machine& machine) {
    return {{"compiler", machine.compiler}, {"processor", machine.processor}, {"system", machine.system},
            {"simd", machine.simd},         {"simd_by", machine.simdReason},  {"machine_threads", machine.threads}};
}

Json rendererJson(const std::optional<render::RendererInfo>& info) {
    if (!info) return nullptr;
    return {
        {"backend", info->backend}, {"vendor", info->vendor}, {"renderer", info->renderer}, {"version", info->version}};
}

Json seedsJson(const world::SceneSpec& spec) {
    Json seeds = Json::object();
    for (const world::BodySpec& body : spec.bodies)
        if (body.jitter > 0.0) seeds[body.fullName() + ".seed"] = body.seed;
    for (const world::WindSpec& wind : spec.forces.of<world::WindSpec>())
        if (wind.gustAmplitude > 0.0) seeds[wind.fullName() + ".gust.seed"] = wind.gustSeed;
    return seeds;
}

Json islandsJson(const world::World& world) {
    Json islands = Json::array();
    for (const world::IslandInfo& island : world.islands()) {
        Json changes = Json::array();
        for (const world::StepChange& change : island.stepChanges)
            changes.push_back({{"time_s", change.time},
                               {"from", change.from},
                               {"to", change.to},
                               {"tick_repeated", change.isRepeated}});
        islands.push_back({{"name", island.name},
                           {"bodies", island.bodies},
                           {"method", island.method},
                           {"points", island.points},
                           {"springs", island.springs},
                           {"step_s", island.step},
                           {"substeps", island.substeps},
                           {"step_limit_s", island.stepLimit},
                           {"follows_state", island.followsState},
                           {"substeps_changed", changes},
                           {"limited_by", island.limitingSpring}});
    }
    return islands;
}

Json divergenceJson(const world::Divergence& d) {
    return {{"tick", d.tick},   {"time_s", d.time},          {"body", d.body},
            {"point", d.point}, {"spring", d.spring},        {"omega_h", d.omegaH},
            {"limit", d.limit}, {"safe_step_s", d.safeStep}, {"message", d.message}};
}

Json frozenJson(const world::World& world) {
    Json all = Json::array();
    for (const world::FrozenIsland& island : world.frozen())
        all.push_back({{"name", island.name},
                       {"bodies", island.bodies},
                       {"kept_time_s", island.time},
                       {"divergence", divergenceJson(island.divergence)}});
    return all;
}

// Of the methods: force evaluations, and the work of the solver of implicit ones.
Json workJson(const ode::Work& work) {
    return {{"evaluations", work.evaluations},
            {"solver_iterations", work.iterations},
            {"unconverged_solves", work.unconverged}};
}

Json layersJson(const PictureLayers& layers) {
    Json json = {{"alpha", layers.alpha ? Json("straight") : Json(nullptr)}};
    for (const std::string& kind : layers.kinds) json[kind] = nullptr;
    for (const auto& layer : layers.layers) {
        Json& facts = json[layer->name()] = Json::object();
        for (const auto& [name, fact] : layer->facts())
            std::visit([&, &key = name](const auto& value) { facts[key] = value; }, fact);
    }
    return json;
}

Json timesJson(const RunResult& result) {
    double simulating = 0.0, drawing = 0.0, encoding = 0.0;
    for (std::size_t i = 0; i < result.frames.size(); ++i) {
        const FrameRecord frame = result.frames[i];
        simulating += frame.simulating;
        drawing += frame.drawing;
        encoding += frame.encoding;
    }
    return {{"simulate", simulating}, {"render", drawing}, {"encode", encoding}, {"total", result.seconds}};
}

}  // namespace

void writeRunJson(const Write& write, const world::SceneSpec& spec, const world::World& world,
                  const RunRequest& request, const Machine& machine,
                  const std::optional<render::RendererInfo>& renderer, const RunResult& result) {
    Json json;
    json["program"] = machine.program;
    json["bits"] = world::resultBits;
    json["scene"] = spec.file;
    json["output"] = request.output;
    json["overrides"] = request.overrides;
    json["ended"] = request.isBegun      ? "begun"
                    : result.divergence  ? "diverged"
                    : result.interrupted ? "interrupted"
                                         : "complete";
    if (result.divergence) json["divergence"] = divergenceJson(*result.divergence);
    json["machine"] = machineJson(machine);
    json["threads"] = request.threads == 0 ? machine.threads : request.threads;
    json["draw_threads"] = 1 + request.options.moreDraws.size();
    json["gl"] = rendererJson(renderer);
    json["precision"] = spec.solver.precision == world::Precision::double_ ? "double" : "single";
    json["fps"] = spec.run.fps;
    json["ticks_per_frame"] = world.ticksPerFrame();
    json["tick_s"] = world.tickSeconds();
    json["size"] = {spec.picture.size.x, spec.picture.size.y};
    json["layers"] = layersJson(request.layers);
    json["frames"] = {{"first", request.firstFrame}, {"last", request.options.lastFrame}, {"of", request.frames}};
    json["run"] = hexadecimal(request.key);
    json["seeds"] = seedsJson(spec);
    json["islands"] = islandsJson(world);
    json["frozen"] = frozenJson(world);
    json["warnings"] = printed(world.warnings());
    json["work"] = workJson(world.work());
    json["seconds"] = timesJson(result);
    std::string head = json.dump(2, ' ', false, Json::error_handler_t::replace);
    head.resize(head.size() - 2);  // without the end of the object: two more members follow, piece by piece
    write(head + ",\n  \"state_hash\": [");
    for (std::size_t i = 0; i < result.frames.size(); ++i)  // of frames 0, 1, …
        write(fmt::format("{}\n    \"{}\"", i > 0 ? "," : "", hexadecimal(result.frames[i].hash)));
    write("],\n  \"picture_crc32\": [");
    for (std::size_t i = 0; i < request.pictures.size(); ++i)  // of the first frame that was asked for, …
        write(fmt::format("{}\n    \"{:08x}\"", i > 0 ? "," : "", request.pictures[i]));
    write("]\n}\n");
}

void writeMetricsCsv(const Write& write, const world::SceneSpec& spec, const RunResult& result,
                     const std::vector<std::string>& figures) {
    std::string text = "frame,time_s";
    for (const world::Metric& metric : world::metricTable()) text += fmt::format(",{}", metric.columns);
    for (const std::string& name : figures) text += "," + core::csvCell(name);
    for (std::size_t i = 0; i < result.frames.size(); ++i) {
        const FrameRecord frame = result.frames[i];
        if (!frame.metrics) continue;
        text += fmt::format("\n{},{}", frame.frame, frame.time);
        for (const world::Metric& metric : world::metricTable()) {
            if (!world::isCounted(metric.counts, spec)) {
                text += ",";
                continue;
            }
            const world::MetricValue value = metric.value(*frame.metrics);
            if (const auto* v = std::get_if<glm::dvec3>(&value)) text += fmt::format(",{},{},{}", v->x, v->y, v->z);
            if (const auto* number = std::get_if<double>(&value)) text += fmt::format(",{}", *number);
            if (const auto* count = std::get_if<std::int64_t>(&value)) text += fmt::format(",{}", *count);
        }
        for (const double figure : frame.figures) text += std::isfinite(figure) ? fmt::format(",{:.17g}", figure) : ",";
        write(text);
        text.clear();
    }
    write(text + "\n");
}

}  // namespace taut::pipeline
