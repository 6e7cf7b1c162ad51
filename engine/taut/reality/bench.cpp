#include "taut/reality/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "taut/core/error.h"
#include "taut/core/private/bisect.h"
#include "taut/scene/load.h"

namespace taut::reality {

std::string lineScene(const LineScene& scene) {
    return fmt::format(R"(schema = 1

[run]
fps = {}
seconds = {}

[world]
gravity = [0, {}, 0]

[solver]
integrator = "{}"
precision = "double"
{}
[rope.strip]
{}segments = {}
mass_kg = {}
stretch_N = {}
{}damping_time_s = {}
drag_per_s = {}
radius = {}
{}
[camera.main]
eye = [0, 1, {}]
target = [0, 1, 0]
)",
                       scene.fps, scene.seconds, -scene.gravity, scene.method,
                       scene.method.starts_with("implicit") ? "cg_tolerance = 1e-8\nnewton_steps = 4\n" : "",
                       scene.place, scene.cells, scene.weight / g, scene.stretch,
                       scene.rigidity > 0 ? fmt::format("bending_rigidity_N_m2 = {}\n", scene.rigidity) : "",
                       scene.damping, scene.drag, scene.length / 100, scene.more, 3 * scene.length);
}

std::string laidAlong(double length, int parts, const std::function<glm::dvec3(double)>& way) {
    const auto place = [&](int i) {
        const glm::dvec3 at = way(length * i / parts);
        return fmt::format("[{}, {}, {}]", at.x, at.y, at.z);
    };
    std::string text = "ends = [" + place(0) + ", " + place(parts) + "]\nthrough = [\n";
    for (int i = 1; i < parts; ++i) text += "  { position = " + place(i) + " },\n";
    return text + "]\n";
}

world::World Bench::load(const std::string& name, const std::string& scene) {
    scene_ = name;
    const auto same = std::ranges::find_if(study_.scenes, [&](const auto& kept) { return kept.first == name; });
    if (same == study_.scenes.end())
        study_.scenes.emplace_back(name, scene);
    else
        same->second = scene;
    return world::World(scene::loadSceneText(scene, name + ".toml", {.assetFolders = settings_.assetFolders}).spec,
                        {.threads = 1});
}

void Bench::play(world::World& world, double seconds, const std::function<void()>& look) {
    const std::clock_t start = std::clock();
    const double begin = world.time();
    while (world.time() < begin + seconds - 1e-9) {
        if (settings_.listener.isStopped()) throw core::Error(core::ErrorKind::interrupted, "stopped");
        if (const auto divergence = world.advance()) throw core::Error(core::ErrorKind::diverged, divergence->message);
        if (look) look();
    }
    processor_ += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    simulated_ += world.time() - begin;
}

bool Bench::settle(world::World& world, const std::string& target, double length) {
    const world::Selection all = world.select(target);
    for (double t = 0; t < 60; t += 0.25) {
        play(world, 0.25);
        double fastest = 0;
        for (const glm::dvec3& v : world.points(all).v) fastest = std::max(fastest, glm::length(v));
        if (fastest < 1e-5 * length) return true;
    }
    return false;
}

void Bench::line(const std::string& quantity, const std::string& source, double expected, double value,
                 double tolerance, int cells, const std::string& missing) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const std::string why =
        !missing.empty() || std::isfinite(value) ? missing : "it does not turn where it was looked for";
    study_.lines.push_back({row_, quantity, source, expected, missing.empty() ? value : none, tolerance, cells,
                            processor_, simulated_, scene_, why});
    processor_ = simulated_ = 0;
}

double Bench::threshold(double low, double high, int halvings, const std::function<bool(double)>& gives) {
    if (gives(low) || !gives(high)) return std::numeric_limits<double>::quiet_NaN();
    const auto ends = core::bisected(low, high, halvings, [&](double x) { return !gives(x); });
    return 0.5 * (ends.first + ends.second);
}

std::vector<double> frequenciesNear(const std::vector<double>& samples, double dt, const std::vector<double>& guesses) {
    const auto count = static_cast<double>(samples.size());
    const auto power = [&](double omega) {
        double real = 0, imaginary = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const double phase = 2 * std::numbers::pi * static_cast<double>(i) / (count - 1),
                         windowed = samples[i] * (0.42 - 0.5 * std::cos(phase) + 0.08 * std::cos(2 * phase)),
                         turn = omega * dt * static_cast<double>(i);
            real += windowed * std::cos(turn);
            imaginary += windowed * std::sin(turn);
        }
        return real * real + imaginary * imaginary;
    };
    // The highest of many, then ever closer around it.
    std::vector<double> found;
    for (const double guess : guesses) {
        double centre = guess, half = guess / 8;
        for (int round = 0; round < 5; ++round) {
            constexpr int parts = 40;
            double best = -1, at = centre;
            for (int k = -parts; k <= parts; ++k) {
                const double omega = centre + half * k / parts, p = power(omega);
                if (p > best) best = p, at = omega;
            }
            centre = at;
            half /= 15;
        }
        found.push_back(centre);
    }
    return found;
}

}  // namespace taut::reality
