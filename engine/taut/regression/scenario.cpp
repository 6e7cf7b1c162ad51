#include "taut/regression/scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <system_error>

#include "taut/core/error.h"
#include "taut/pipeline/run.h"

namespace taut::regression {
namespace {

[[noreturn]] void refuse(const world::SceneSpec& spec, const world::Source& source, const std::string& what) {
    throw core::Error(core::ErrorKind::badContent,
                      source.line > 0 ? at(source) + what : core::at({}) + fmt::format("{}: {}", spec.file, what));
}

}  // namespace

std::string GoldenRequest::key() const {
    return fmt::format("{:06}{}{}", frame, camera.empty() ? "" : "-" + camera, debug ? "-debug" : "");
}

std::vector<std::filesystem::path> scenarioFilesIn(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (auto entry = std::filesystem::directory_iterator(folder, error);
         !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
        if (std::error_code ignored; entry->path().extension() == ".toml" && entry->is_regular_file(ignored))
            files.push_back(entry->path());
    if (error) throw core::Error(core::ErrorKind::inputOutput, fmt::format("{}: {}", folder.string(), error.message()));
    if (files.empty())
        throw core::Error(
            core::ErrorKind::inputOutput,
            fmt::format("{}: there is no scenario in this folder, that is, no file NAME.toml", folder.string()));
    std::ranges::sort(files);
    return files;
}

std::vector<std::filesystem::path> scenarioFiles(const std::vector<std::filesystem::path>& named) {
    std::vector<std::filesystem::path> files;
    for (const std::filesystem::path& path : named) {
        std::error_code error;
        if (std::filesystem::is_directory(path, error)) {
            const std::vector<std::filesystem::path> inside = scenarioFilesIn(path);
            files.insert(files.end(), inside.begin(), inside.end());
        } else if (!std::filesystem::exists(path, error)) {
            throw core::Error(core::ErrorKind::inputOutput,
                              fmt::format("{}: there is no such file or folder of scenarios", path.string()));
        } else {
            files.push_back(path);
        }
    }
    std::map<std::string, std::filesystem::path> seen;
    std::vector<std::filesystem::path> once;
    for (const std::filesystem::path& file : files) {
        const auto [other, isNew] = seen.emplace(file.stem().string(), file);
        std::error_code ignored;
        if (isNew)
            once.push_back(file);
        else if (!std::filesystem::equivalent(other->second, file, ignored))
            throw core::Error(core::ErrorKind::usage,
                              fmt::format("two scenarios are called {}: {} and {}; goldens are kept by name",
                                          file.stem().string(), other->second.string(), file.string()));
    }
    return once;
}

std::vector<GoldenRequest> goldenRequests(const world::SceneSpec& spec) {
    std::vector<GoldenRequest> requests;
    std::set<std::string> keys;
    const std::int64_t count = pipeline::frameCount(spec.run);
    for (const world::GoldenSpec& golden : spec.goldens) {
        if (!golden.camera.empty() && std::ranges::none_of(spec.cameras, [&](const world::CameraSpec& camera) {
                return camera.name == golden.camera;
            }))
            refuse(spec, golden.source, fmt::format("there is no camera '{}'", golden.camera));
        for (const int frame : golden.frames) {
            if (frame < 0 || frame >= count)
                refuse(spec, golden.source,
                       fmt::format("there is no frame {}: the run has frames 0 to {}", frame, count - 1));
            requests.push_back({golden.source, frame, golden.debug, golden.restart, golden.camera, golden.size});
            if (!keys.insert(requests.back().key()).second)
                refuse(spec, golden.source, fmt::format("the golden picture of frame {} is asked for twice", frame));
        }
    }
    std::ranges::stable_sort(requests, {}, &GoldenRequest::frame);
    return requests;
}

ReadScenarios readScenarios(const std::vector<std::filesystem::path>& files, const scene::LoadOptions& options) {
    ReadScenarios read;
    for (const std::filesystem::path& file : files) {
        try {
            scene::Loaded loaded = scene::loadScene(file, options);
            std::vector<GoldenRequest> goldens = goldenRequests(loaded.spec);
            read.scenarios.push_back(
                {file.stem().string(), file, std::move(loaded.spec), std::move(goldens), std::move(loaded.warnings)});
        } catch (const core::Error& error) {
            if (error.kind() != core::ErrorKind::badContent) throw;
            read.unread.push_back({file.stem().string(), file, error.what()});
        }
    }
    return read;
}

}  // namespace taut::regression
