#include "game/web/scene_source.h"

#include "taut/island/metric_table.h"

namespace taut::web {
namespace {

constexpr double memoryLimit = 1.5e9;  // [bytes] of the 2 GiB that the engine's memory grows to

}  // namespace

SceneSource sourceIn(const Json& with) {
    SceneSource source;
    source.isText = true;
    source.text = with.at("text");
    source.file = with.at("name");
    source.overrides = with.at("overrides").get<std::vector<std::string>>();
    return source;
}

scene::Loaded read(const SceneSource& source) {
    scene::LoadOptions options;
    options.overrides = source.overrides;
    options.assetFolders = {".", "/taut"};
    options.memoryLimit = memoryLimit;
    options.stateIn = pipeline::stateIn;
    return scene::loadSceneText(source.text, source.file, options);
}

Json measuresOf(const world::Metrics& metrics) {
    Json all{{"kinetic", metrics.kinetic},
             {"elastic", metrics.elastic},
             {"gravitational", metrics.gravitational},
             {"energy", metrics.energy()},
             {"broken_springs", metrics.brokenSprings},
             {"volume", metrics.volume},
             {"rest_volume", metrics.restVolume}};
    for (const world::Metric& metric : world::metricTable()) {
        const std::string name(metric.function.empty() ? metric.columns : metric.function);
        if (all.contains(name)) continue;
        const world::MetricValue value = metric.value(metrics);
        if (const auto* v = std::get_if<glm::dvec3>(&value)) all[name] = numbersOf(*v);
        if (const auto* number = std::get_if<double>(&value)) all[name] = *number;
        if (const auto* count = std::get_if<std::int64_t>(&value)) all[name] = *count;
    }
    return all;
}

Json divergenceOf(const world::Divergence& divergence) {
    return {{"tick", divergence.tick},   {"time", divergence.time},         {"body", divergence.body},
            {"point", divergence.point}, {"safeStep", divergence.safeStep}, {"message", divergence.message}};
}

}  // namespace taut::web
