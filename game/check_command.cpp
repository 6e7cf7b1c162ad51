#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/flags.h"
#include "game/messages.h"
#include "game/outputs.h"
#include "game/scene_file.h"
#include "taut/advice/figures.h"
#include "taut/advice/rehearsal.h"
#include "taut/core/error.h"
#include "taut/pipeline/run.h"
#include "taut/regression/scenario.h"
#include "taut/scene/load.h"

namespace taut::game {
namespace {

using Json = nlohmann::ordered_json;

struct CheckFlags {
    std::vector<std::string> scenes;
    std::vector<std::string> overrides;
    bool isConfined = false, quick = false, strict = false, json = false;
};

struct Verdict {
    std::string scene;                    // its file
    std::optional<core::Error> error;     // all that is wrong
    std::vector<core::Finding> warnings;  // of the loader and the rehearsal
    std::vector<std::string> notes;       // of its figures
    std::vector<std::string> advice;
    std::string large;  // the cost of so many pictures
    ExitCode code = ExitCode::ok;
};

// Copies of a body would say the same again and again.
void printAdvice(const std::vector<std::string>& all) {
    constexpr int most = 5;
    int count = 0;
    for (const std::string& advice : all)
        if (++count <= most) printNote("taut: note: {}\n", advice);
    if (count > most) printNote("taut: note: … and {} more; taut info lists them\n", count - most);
}

// Of a folder the scenes in it, as `taut test` finds scenarios.
std::vector<std::string> scenesOf(const std::vector<std::string>& arguments) {
    std::vector<std::string> scenes;
    for (const std::string& argument : arguments) {
        std::error_code ignored;
        if (!std::filesystem::is_directory(argument, ignored))
            scenes.push_back(argument);
        else
            for (const std::filesystem::path& file : regression::scenarioFilesIn(argument))
                scenes.push_back(file.string());
    }
    return scenes;
}

// Reads a scene, and builds and rehearses it.
Verdict judge(const std::string& argument, const CheckFlags& flags) {
    Verdict verdict;
    verdict.scene = argument;
    try {
        const scene::Loaded loaded =
            scene::loadScene(sceneFile(argument), loadOptions(flags.overrides, flags.isConfined));
        const world::SceneSpec& spec = loaded.spec;
        verdict.scene = spec.file;
        verdict.warnings = loaded.warnings;
        verdict.large = largeRunText(pipeline::frameCount(spec.run), spec.picture.size.x, spec.picture.size.y);
        verdict.notes = world::figureNotes(spec);
        const bool isTooLarge = !flags.quick && world::isTooLarge(spec);
        if (isTooLarge)
            verdict.advice.push_back(
                "these are too many points to simulate the start: only the file was checked; taut info builds them");
        if (!flags.quick && !isTooLarge) {
            if (!flags.json) notePreparation(spec);
            world::Rehearsal rehearsal = world::rehearse(spec);
            std::ranges::move(rehearsal.warnings, std::back_inserter(verdict.warnings));
            verdict.advice = std::move(rehearsal.advice);
            if (!rehearsal.faults.empty()) throw core::Error(core::ErrorKind::badContent, std::move(rehearsal.faults));
        }
        if (flags.strict && !verdict.warnings.empty()) verdict.code = ExitCode::badContent;
    } catch (const core::Error& error) {
        verdict.error = error;
        verdict.code = exitCodeOf(error.kind());
    }
    return verdict;
}

void print(const Verdict& verdict, bool isAlone) {
    printWarnings(verdict.warnings);
    for (const std::string& note : verdict.notes) printNote("taut: note: {}\n", note);
    printAdvice(verdict.advice);
    if (verdict.error) printError(*verdict.error);
    if (verdict.code == ExitCode::ok) {
        printResult("{}: ok\n", verdict.scene);
        if (!verdict.large.empty()) printResult("{}: {}\n", verdict.scene, verdict.large);
    } else if (!isAlone || !verdict.error) {
        printResult("{}: wrong\n", verdict.scene);
    }
}

// Without a file, line or column where none is known.
Json jsonOf(const std::vector<core::Finding>& findings) {
    Json all = Json::array();
    for (const core::Finding& finding : findings) {
        Json& entry = all.emplace_back();
        if (!finding.source.file.empty()) entry["file"] = finding.source.file;
        if (finding.source.line > 0) entry["line"] = finding.source.line;
        if (finding.source.column > 0) entry["column"] = finding.source.column;
        entry["message"] = finding.text;
        if (!finding.remedy.empty()) entry["remedy"] = finding.remedy;
    }
    return all;
}

void printJson(const std::vector<Verdict>& verdicts) {
    Json all = Json::array();
    for (const Verdict& verdict : verdicts) {
        Json notes = verdict.notes;
        for (const std::string& advice : verdict.advice) notes.push_back(advice);
        all.push_back({{"scene", verdict.scene},
                       {"ok", verdict.code == ExitCode::ok},
                       {"errors", verdict.error ? jsonOf(verdict.error->findings()) : Json::array()},
                       {"warnings", jsonOf(verdict.warnings)},
                       {"notes", std::move(notes)}});
    }
    printResult("{}\n", all.dump(2, ' ', false, Json::error_handler_t::replace));
}

// Goes on after a scene that is wrong, and returns the worst code.
int check(const CheckFlags& flags) {
    ExitCode code = ExitCode::ok;
    const std::vector<std::string> scenes = scenesOf(flags.scenes);
    std::vector<Verdict> verdicts;
    for (const std::string& argument : scenes) {
        Verdict verdict = judge(argument, flags);
        code = std::max(code, verdict.code);
        if (flags.json)
            verdicts.push_back(std::move(verdict));
        else
            print(verdict, scenes.size() == 1);
    }
    if (flags.json) printJson(verdicts);
    return static_cast<int>(code);
}

Action declareCheck(Options& options) {
    const auto flags = std::make_shared<CheckFlags>();
    options.value("SCENE", flags->scenes, "Scene files, folders of them, or names of shipped scenes").required();
    addOverrideFlag(options, flags->overrides, "Override a field: --set cloth.flag.cells=[72,48]");
    addConfinedFlag(options, flags->isConfined);
    options.flag("--quick", flags->quick, "Check the files only, without building and simulating");
    options.flag("--strict", flags->strict, "Make warnings errors");
    options.flag("--json", flags->json, "Print JSON with file, line and column, for editors and CI");
    options.footer(
        "Of a folder every file NAME.toml is checked, with a line each. The exit code is that of the worst. Simulates "
        "for up\n"
        "to two seconds of processor time, and up to 100 000 points.\n"
        "Examples:\n"
        "  taut check my.toml\n"
        "  taut check my --confined --strict\n"
        "  taut check hammock --set 'rope.*.radius=0.01' --set defaults.rope.segments=20");
    return withThreads(options, [flags] { return check(*flags); });
}

}  // namespace

Command checkCommand() {
    return {"check", "Validate scene files", declareCheck};
}

}  // namespace taut::game
