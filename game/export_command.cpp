#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/flags.h"
#include "game/interruption.h"
#include "game/lab.h"
#include "game/messages.h"
#include "game/outputs.h"
#include "game/scene_file.h"
#include "game/tables.h"
#include "game/usage.h"
#include "game/web_page.h"
#include "taut/core/error.h"
#include "taut/core/glob.h"
#include "taut/core/private/contains.h"
#include "taut/core/private/parallel.h"
#include "taut/core/private/stopwatch.h"
#include "taut/core/whole_file.h"
#include "taut/geometry/every_nth.h"
#include "taut/geometry/private/format_table.h"
#include "taut/pipeline/geometry_run.h"
#include "taut/pipeline/run.h"
#include "taut/scene/load.h"
#include "taut/spec/ticks.h"
#include "taut/world/world.h"

namespace taut::game {
namespace {

struct ExportFlags {
    std::string scene, output, points, web, live, viewer, engine, frames;
    std::vector<std::string> only, of, sliders;  // as they are given
    std::vector<std::string> overrides;
    std::int64_t every = 1;
    int digits = 0;   // 0: not given
    int smooth = -1;  // -1: not given
    double fps = 0.0, seconds = 0.0;
    int threads = 0;
    OverwriteFlags overwrite;
    bool noNormals = false, quiet = false, isConfined = false, edits = false;
};

using geometry::Format;
using geometry::Formats;
using geometry::Holds;

// A file that is asked for.
struct Destination {
    std::string file;
    const Format* format;
};

// The words between commas, except for commas in places such as cloth.flag@(0.5,0.5); each once.
std::vector<std::string> targetsIn(const std::vector<std::string>& texts) {
    std::vector<std::string> targets;
    for (const std::string& text : texts) {
        std::string target;
        int depth = 0;
        const auto take = [&] {
            if (!core::contains(targets, target)) targets.push_back(target);
            target.clear();
        };
        for (const char c : text) {
            depth += c == '(' ? 1 : c == ')' ? -1 : 0;
            if (c == ',' && depth == 0)
                take();
            else
                target += c;
        }
        take();
    }
    return targets;
}

// "a", "a or b", "a, b or c".
std::string oneOf(const std::vector<std::string>& texts, const char* last = " or ") {
    std::string all;
    for (std::size_t i = 0; i < texts.size(); ++i) all += (i == 0 ? "" : i + 1 < texts.size() ? ", " : last) + texts[i];
    return all;
}

// The `text` of each wanted format that holds that.
std::vector<std::string> ofEach(const Formats& formats, Holds what,
                                const std::function<std::string(const Format&)>& text,
                                const std::function<bool(const Format&)>& isWanted = {}) {
    std::vector<std::string> texts;
    for (const Format* format : geometry::formatsThat(formats, what))
        if (!isWanted || isWanted(*format)) texts.push_back(text(*format));
    return texts;
}

std::string endingOf(const Format& format) {
    return format.endings.front();
}

// ".npz (numpy.load)"
std::string endingAndReaders(const Format& format) {
    std::vector<std::string> facts;
    if (!format.readers.empty()) facts.push_back(format.readers);
    if (format.mayTear) facts.emplace_back("may tear");
    return facts.empty() ? endingOf(format) : fmt::format("{} ({})", endingOf(format), fmt::join(facts, "; "));
}

std::string endingsWithDigits(const Formats& formats) {
    return oneOf(ofEach(
                     formats, Holds::surfaces, endingOf, [](const Format& format) { return format.hasDigits; }),
                 " and ");
}

std::string allKindsOfFiles(const Formats& formats, const Format& page) {
    std::vector<std::string> kinds =
        ofEach(formats, Holds::surfaces, [](const Format& format) { return "-o out" + endingOf(format); });
    kinds.push_back("--web out" + endingOf(page));
    for (const Format* format : geometry::formatsThat(formats, Holds::points)) {
        kinds.push_back("--points out" + endingOf(*format));
        break;
    }
    return oneOf(kinds, ", or ");
}

// The request, and whether the flags fit it.
std::vector<Destination> destinationsOf(const ExportFlags& flags, const Formats& formats, const Format& page) {
    std::vector<Destination> all;
    const auto add = [&](const std::string& file, const Format* format, const auto& fault) {
        if (file.empty()) return;
        if (format == nullptr) failUsage("{}: {}", file, fault());
        all.push_back({file, format});
    };
    if (flags.output.empty() && flags.points.empty() && flags.web.empty())
        failUsage("name an output for the geometry: {}", allKindsOfFiles(formats, page));
    add(
        flags.output, geometry::formatOf(formats, Holds::surfaces, flags.output),
        [&] {
            return fmt::format(
                "geometry goes to {}{}", oneOf(ofEach(formats, Holds::surfaces, endingAndReaders)),
                geometry::isIn(page, flags.output) ? "; a page that shows it is --web " + flags.output : "");
        });
    add(flags.web, geometry::isIn(page, flags.web) ? &page : nullptr,
        [&] { return "--web writes a page, " + endingOf(page); });
    if (flags.web.empty() && !flags.viewer.empty())
        failUsage("--viewer selects the viewer of a page: add --web out.html");
    for (const auto& [file, format] : all)
        if (flags.noNormals && !format->needsNormals.empty()) failUsage("--no-normals: {}", format->needsNormals);
    add(flags.points, geometry::formatOf(formats, Holds::points, flags.points),
        [&] { return "points go to " + oneOf(ofEach(formats, Holds::points, endingAndReaders)); });
    if (flags.points.empty() && !flags.of.empty()) failUsage("--of selects points: add --points out.npz");
    if (flags.digits > 0 && std::ranges::none_of(all, [](const auto& to) { return to.format->hasDigits; }))
        failUsage("--digits applies to {}; other formats have full precision", endingsWithDigits(formats));
    if (flags.output.empty() && flags.web.empty() && (flags.noNormals || !flags.only.empty()))
        failUsage("--only and --no-normals apply to geometry: add -o, or name points with --of");
    return all;
}

std::vector<std::string> allOverrides(const ExportFlags& flags) {
    std::vector<std::string> overrides = flags.overrides;
    addRunOverrides(flags.fps, flags.seconds, overrides);
    addSmoothOverride(flags.smooth, overrides);
    return overrides;
}

bool namesACopy(const std::string& target, const world::BodySpec& body) {
    const int copies = body.array.count.x * body.array.count.y * body.array.count.z;
    for (int i = 0; i < copies; ++i)
        if (core::matches(target, fmt::format("{}.{}", body.fullName(), i))) return true;
    return false;
}

// Why --only names nothing in the scene, with the names there; empty if it does.
std::string onlyFault(const world::SceneSpec& spec, const std::string& target) {
    constexpr std::size_t mostNames = 12;
    std::vector<std::string> names;
    for (const world::BodySpec& body : spec.bodies) {
        const bool isSingle = body.array.count == world::ArraySpec{}.count;
        if (!isSingle && namesACopy(target, body)) return "";
        names.push_back(body.fullName() + (isSingle ? "" : ".*"));
    }
    for (const world::ColliderSpec& collider : spec.colliders) names.push_back("collider." + collider.name);
    names.emplace_back("ground");
    if (std::ranges::any_of(names, [&](const auto& name) { return core::matches(target, name); })) return "";
    const bool isOfBodies = target.find('.') != std::string::npos && !target.starts_with("collider.");
    std::string fault = isOfBodies ? scene::targetFault(spec, target, false) : "";
    if (fault.empty()) fault = "there is no " + target;
    const std::size_t told = std::min(names.size(), mostNames), rest = names.size() - told;
    names.resize(told);
    fault += fmt::format("{} there are {}", fault.ends_with('?') ? "" : ";", fmt::join(names, ", "));
    return rest == 0 ? fault : fmt::format("{}, and {} more", fault, rest);
}

pipeline::GeometryRun runOf(const ExportFlags& flags, const world::SceneSpec& spec) {
    const std::int64_t count = pipeline::frameCount(spec.run);
    const std::int64_t first = world::Ticks(spec.run).firstFrame;
    const FrameRange range = flags.frames.empty() ? FrameRange{first, {}} : frameRange(flags.frames);
    pipeline::GeometryRun run;
    run.firstFrame = range.first;
    run.lastFrame = range.last.value_or(count - 1);
    run.every = flags.every;
    if (run.firstFrame >= count || run.lastFrame >= count)
        failUsage("--frames {}: the scene has frames 0-{}; --seconds makes it longer", flags.frames, count - 1);
    if (run.firstFrame < first)
        failUsage("--frames {}: the scene starts with frame {}, from {}", flags.frames, first, spec.run.start);
    if (flags.points.empty()) return run;
    run.targets = targetsIn(flags.of);
    if (run.targets.empty())
        for (const world::BodySpec& body : spec.bodies) run.targets.push_back(body.fullName());
    if (run.targets.empty()) failUsage("--points: the scene has no bodies");
    return run;
}

geometry::GeometryOptions geometryOptions(const ExportFlags& flags, const world::SceneSpec& spec) {
    geometry::GeometryOptions options;
    options.fps = spec.run.fps;
    options.aspect = static_cast<double>(spec.picture.size.x) / spec.picture.size.y;
    options.normals = !flags.noNormals;
    if (flags.digits > 0) options.digits = flags.digits;
    options.generator = fmt::format("taut {}", TAUT_VERSION);
    if (!flags.only.empty())
        options.isWanted = [only = targetsIn(flags.only)](const std::string& name) {
            return std::ranges::any_of(only, [&](const std::string& pattern) { return core::matches(pattern, name); });
        };
    return options;
}

// One film to several files.
struct Sinks : geometry::GeometrySink {
    void write(const view::FrameView& view) override {
        for (const auto& sink : all) sink->write(view);
    }
    void finish() override {
        for (const auto& sink : all) sink->finish();
    }
    std::vector<std::unique_ptr<geometry::GeometrySink>> all;
};

std::string sizeText(const std::filesystem::path& path) {
    std::error_code ignored;
    const auto bytes = static_cast<double>(std::filesystem::file_size(path, ignored));
    return bytes < 1e6 ? fmt::format("{:.1f} kB", 1e-3 * bytes) : fmt::format("{:.1f} MB", 1e-6 * bytes);
}

void printLost(const geometry::LostMotion& lost, std::int64_t every) {
    if (every == 1) return;
    std::string text = fmt::format("--every {}: {} frames left out", every, lost.frames);
    if (lost.worstName.empty())
        text += ", nothing moved in them";
    else
        text += fmt::format(", error {:.3g} mm rms, {:.3g} mm at worst ({}, frame {}), interpolated linearly",
                            1e3 * lost.rms, 1e3 * lost.worst, lost.worstName, lost.worstFrame);
    if (lost.unmeasured > 0) {
        const std::size_t others = lost.changes.size() - 1;
        text += fmt::format("; {} of them, where {}{}, not measured", lost.unmeasured, *lost.changes.begin(),
                            others == 0 ? "" : fmt::format(" and {} more change", others));
    }
    printResult("{}\n", text);
}

void noteTooManyKeys(std::int64_t keys, const pipeline::GeometryRun& run, const Format& format) {
    const auto most = static_cast<std::int64_t>(format.mostKeys);
    if (most == 0 || keys <= most) return;
    printNote("note: {} keys: {} reserve room for {} per mesh; --every {} has fewer\n", keys, format.limitingReaders,
              most, (run.lastFrame - run.firstFrame) / most + 1);
}

// A page needs no run: it contains the scene.
int exportLive(const ExportFlags& flags) {
    if (!(flags.output + flags.web + flags.points).empty())
        failUsage("--live writes a page that simulates the scene; -o, --web and --points are separate exports");
    if (!flags.live.ends_with(".html") && !flags.live.ends_with(".htm"))
        failUsage("{}: --live writes a page, out.html", flags.live);
    const std::vector<std::string> overrides = allOverrides(flags);
    const scene::Loaded scene = readSceneWithKeys(flags.scene, overrides, flags.isConfined);
    LivePageWish wish{flags.viewer, flags.engine, overrides, targetsIn(flags.sliders), flags.edits};
    if (flags.sliders.empty()) wish.sliders.clear();
    const std::string page = livePage(sceneFile(flags.scene), scene, wish);
    permitOverwritingFile(flags.live, flags.overwrite.answer());
    core::prepareFolderOf(flags.live);
    core::writeWholeFile(flags.live, page);
    if (!flags.quiet) printNote("{} ({})\n", flags.live, sizeText(flags.live));
    return static_cast<int>(ExitCode::ok);
}

// Over 60 lines: the steps of an export, from its flags to its files, are one list.
int exportScene(const ExportFlags& flags, const Formats& formats) {
    if (!flags.live.empty()) return exportLive(flags);
    if (!flags.engine.empty() || !flags.sliders.empty() || flags.edits)
        failUsage("--engine, --sliders and --edit apply to live pages: add --live out.html");
    const auto page = std::make_shared<geometry::WebPage>();
    const Format pages = pageFormat(page);
    const std::vector<Destination> destinations = destinationsOf(flags, formats, pages);
    const world::SceneSpec spec = readScene(flags.scene, allOverrides(flags), flags.isConfined);
    for (const std::string& target : targetsIn(flags.only))
        if (const std::string fault = onlyFault(spec, target); !fault.empty()) failUsage("--only: {}", fault);
    for (const std::string& target : targetsIn(flags.of))
        if (const std::string fault = scene::targetFault(spec, target, true); !fault.empty())
            failUsage("--of: {}", fault);
    pipeline::GeometryRun run = runOf(flags, spec);
    run.mayTear =
        oneOf(ofEach(formats, Holds::surfaces, endingOf, [](const Format& format) { return format.mayTear; }));
    if (!flags.web.empty()) {
        const std::string name = std::filesystem::path(flags.scene).stem().string();
        if (!flags.quiet && (!spec.lamps.empty() || !spec.environment.image.empty()))
            printNote("note: the page has no lamps and no environment: sun and sky light it\n");
        *page = spec.title.empty() ? webPage(name, "", flags.viewer) : webPage(spec.title, name, flags.viewer);
    }
    for (const auto& [file, format] : destinations) {
        permitOverwritingFile(file, flags.overwrite.answer());
        core::prepareFolderOf(file);
    }
    const std::int64_t keys = (run.lastFrame - run.firstFrame + run.every - 1) / run.every + 1;
    for (const auto& [file, format] : destinations)
        if (!flags.quiet) noteTooManyKeys(keys, run, *format);

    const Interruption interruption;
    if (!flags.quiet) notePreparation(spec);
    const core::ThreadLimit threads(flags.threads);
    world::World world(spec, {.threads = flags.threads});
    printWarnings(world.warnings());
    const geometry::GeometryOptions options = geometryOptions(flags, spec);
    Sinks sinks;
    std::unique_ptr<geometry::PointsWriter> points;
    for (const auto& [file, format] : destinations)
        if (format->makeSink)
            sinks.all.push_back(format->makeSink(file, options));
        else
            points = format->makePoints(file, run.targets);
    std::unique_ptr<geometry::EveryNth> fewer;
    if (!sinks.all.empty())
        fewer = std::make_unique<geometry::EveryNth>(sinks, run.firstFrame, run.lastFrame, run.every, options.isWanted);

    const core::Stopwatch watch;
    LabProgress progress("export", flags.quiet, interruption.flag());
    run.frameSimulated = [&](std::int64_t frame) {
        progress.show(static_cast<double>(frame + 1) / static_cast<double>(run.lastFrame + 1),
                      fmt::format("frame {}/{}", frame + 1, run.lastFrame + 1));
    };
    bool isFinished = false;
    try {
        isFinished = pipeline::exportGeometry(world, run, fewer.get(), points.get(), interruption.flag());
    } catch (const core::Error& error) {
        if (error.kind() != core::ErrorKind::diverged) throw;
        const std::int64_t good = world.tick() / world.ticksPerFrame();
        std::string text = fmt::format("{}\nnothing was written", error.what());
        if (good >= run.firstFrame)
            text += fmt::format("; --frames {}-{} writes the frames before", run.firstFrame, good);
        throw core::Error(core::ErrorKind::diverged, text);
    }
    if (!isFinished) return static_cast<int>(interruption.exitCode().value_or(ExitCode::interrupted));
    if (fewer) printLost(fewer->lost(), flags.every);
    if (flags.quiet) return static_cast<int>(ExitCode::ok);
    std::string text;
    for (const auto& [file, format] : destinations)
        text += fmt::format("{}{} ({})", text.empty() ? "" : " and ", file, sizeText(file));
    printNote("{} frames in {}, {:.1f} s\n", keys, text, watch.seconds());
    return static_cast<int>(ExitCode::ok);
}

// Over 60 lines: one call for each flag.
Action declareExport(Options& options, const Formats& formats) {
    const auto fileFor = [](const Format& format) { return "out" + endingOf(format); };
    const auto fileAndReaders = [&](const Format& format) {
        return fileFor(format) + (format.readers.empty() ? "" : " for " + format.readers);
    };
    const auto flags = std::make_shared<ExportFlags>();
    options.value("SCENE", flags->scene, "A scene file, or the name of a shipped scene").required();
    options
        .value("-o,--output", flags->output, "Geometry: " + oneOf(ofEach(formats, Holds::surfaces, fileFor), ", or "))
        .typeName("FILE");
    options.value("--web", flags->web, "A page with the film, offline, with a free camera: out.html").typeName("FILE");
    options.value("--live", flags->live, "A page that simulates the scene, offline and interactive: out.html")
        .typeName("FILE");
    options
        .value("--engine", flags->engine,
               "Folder of the engine for --live; default $TAUT_WEB, then the folder that game/web.sh built")
        .typeName("FOLDER");
    options
        .value("--sliders", flags->sliders,
               "Keys of ramps for the sliders of --live, such as wind.breeze.velocity; default common keys")
        .typeName("KEY,…")
        .oneValue();
    options.flag("--edit", flags->edits, "Open the text of the scene in the page of --live");
    options
        .value("--viewer", flags->viewer,
               "Folder of three.js for pages; default $TAUT_THREE, then Debian's libjs-three")
        .typeName("FOLDER");
    options
        .value("--points", flags->points,
               "Positions and velocities of points: " + oneOf(ofEach(formats, Holds::points, fileAndReaders), ", or "))
        .typeName("FILE");
    options.value("--of", flags->of, "Targets of --points, such as cloth.flag@left; default all bodies")
        .typeName("TARGET,…")
        .oneValue();
    options
        .value("--only", flags->only,
               "Parts of the geometry, such as cloth.*, collider.ball or ground; * matches any letters")
        .typeName("TARGET,…")
        .oneValue();
    addOverwriteFlags(options, flags->overwrite);
    options.value("--frames", flags->frames, "Frames to export: 0-119, 60, or 60-").typeName("A-B");
    options.value("--every", flags->every, "Every n-th frame, and the last; prints the error of interpolation")
        .within<std::int64_t>(1, 1000000);
    addRunFlags(options, flags->fps, flags->seconds);
    addSmoothFlag(options, flags->smooth);
    options.flag("--no-normals", flags->noNormals, "Omit normals: half the size, shaded by the other program's rules");
    options
        .value("--digits", flags->digits, fmt::format("Decimals in {}; default 5: 0.01 mm", endingsWithDigits(formats)))
        .within(1, 9);
    options.flag("--quiet", flags->quiet, "Print no progress; only warnings and errors");
    addThreadsFlag(options, flags->threads);
    addOverrideFlag(options, flags->overrides);
    addConfinedFlag(options, flags->isConfined);
    options.footer(
        "Lengths are metres, y is up. In .usda time codes are frame numbers; in .glb and pages time begins at the "
        "first\n"
        "frame, and nothing may tear. In .usda and .glb patterns other than pictures become their first colour. "
        "Vertices\n"
        "are in an order of their own; --points keeps that of the scene. A page contains its film and viewer: it "
        "needs\n"
        "neither server nor network, and has half the size with --every 2.\n"
        "Examples:\n"
        "  taut export torn-banner -o banner.usda\n"
        "  taut export flag -o flag.glb --every 2 --only cloth.flag\n"
        "  taut export flag --web flag.html\n"
        "  taut export flag --points corner.npz --of cloth.flag@bottom-right");
    return [flags, formats] { return exportScene(*flags, formats); };
}

}  // namespace

Command exportCommand(const Tables& tables) {
    return {"export", "Export moving geometry: USD, GLB, pages, points",
            [formats = tables.formats](Options& options) { return declareExport(options, formats); }};
}

}  // namespace taut::game
