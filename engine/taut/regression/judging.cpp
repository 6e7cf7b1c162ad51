#include "taut/regression/judging.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/image/png.h"
#include "taut/image/read.h"
#include "taut/pipeline/run.h"
#include "taut/pipeline/run_parts.h"
#include "taut/regression/scenario_text.h"
#include "taut/regression/tape_compare.h"

namespace taut::regression {
namespace {

using report::TestPicture;
using report::TestScenario;
using report::TestState;
using report::Verdict;

using pipeline::hexadecimal;

// The entry of a scenario in the manifest; an empty one when there is none.
const GoldenScenario& goldensOf(const Scenario& scenario, const Manifest& manifest) {
    static const GoldenScenario none;
    const auto found = manifest.scenarios.find(scenario.name);
    return found == manifest.scenarios.end() ? none : found->second;
}

// As large as the picture that it is compared with, or the general limit.
std::int64_t mostPixels(const image::Image& picture) {
    return std::max(image::mostPixels, std::int64_t{picture.width} * picture.height);
}

bool isRecorded(const GoldenScenario& goldens) {
    return goldens.state || !goldens.pictures.empty();
}

void setOutdated(TestState& state, int recorded, int now) {
    state.verdict = Verdict::outdated;
    state.bits = recorded;
    state.word = fmt::format("bits {}", recorded);
    state.reason = world::recordedBy(recorded, now);
}

std::vector<std::byte> bytesOf(const std::filesystem::path& path) {
    const std::string content = core::fileContent(path, std::uint64_t{1} << 30U);
    const auto bytes = std::as_bytes(std::span<const char>(content.data(), content.size()));
    return {bytes.begin(), bytes.end()};
}

TestState judgedState(const Scenario& scenario, const Played& played, const GoldenFolder& folder,
                      const GoldenScenario& goldens, int bits) {
    TestState state;
    state.ticks = played.tape.ticks();
    state.lastHash = hexadecimal(played.tape.chain.back());
    const std::filesystem::path file = folder.tape(scenario.name);
    if (!goldens.state || !core::isThere(file)) {
        state.verdict = Verdict::missing;
        state.reason = goldens.state ? fmt::format("the manifest names a chain that is not there: {}", file.string())
                                     : "no chain of state hashes is kept for this scenario yet";
        return state;
    }
    state.why = goldens.state->why;
    state.madeBy = fmt::format("{}, {}, {}", goldens.state->program, goldens.state->compiler, goldens.state->simd);
    try {
        const Tape golden = readTape(file);
        if (golden.origin.bits != bits) {
            setOutdated(state, golden.origin.bits, bits);
        } else if (const auto difference = firstDifference(golden, played.tape)) {
            state.verdict = Verdict::failed;
            state.reason = describe(*difference);
            if (difference->fault == TapeFault::length)
                state.reason = fmt::format("the run has {} ticks, its golden {}; up to there they agree", state.ticks,
                                           golden.ticks());
        } else if (hexadecimal(golden.chain.back()) != goldens.state->lastHash) {
            state.verdict = Verdict::failed;
            state.reason = fmt::format("{} ends with another hash than that of the manifest", file.string());
        }
    } catch (const core::Error& error) {
        state.verdict = Verdict::failed;
        state.reason = error.what();
    }
    return state;
}

bool isOfChecksOnly(const Scenario& scenario, const GoldenFolder& folder, const GoldenScenario& goldens) {
    return !scenario.spec.checks.empty() && scenario.goldens.empty() && !isRecorded(goldens) &&
           !core::isThere(folder.tape(scenario.name));
}

// Whether the state at a picture's frame is the one that its golden was drawn from.
bool showsSameState(const PlayedPicture& played, const GoldenPicture& golden) {
    return played.request.restart || hexadecimal(played.stateHash) == golden.stateHash;
}

void compare(const PlayedPicture& played, const GoldenPicture& golden, const std::filesystem::path& file,
             const image::Tolerance& tolerance, TestPicture& picture) {
    image::Image expected;
    try {
        picture.golden = bytesOf(file);
        expected = image::readImage(file, mostPixels(played.picture));
    } catch (const core::Error& error) {
        picture.golden.clear();
        picture.verdict = Verdict::failed;
        picture.reason = error.what();
        return;
    }
    const image::Comparison comparison = image::compare(expected, played.picture, tolerance);
    if (comparison.sameSize) {
        picture.figures = image::describe(comparison, tolerance);
        picture.isSame = comparison.largest == 0;
        picture.difference = image::pngBytes(image::differencePicture(expected, played.picture));
    }
    if (comparison.within) return;
    if (comparison.sameSize && comparison.worstTileShare > 0.0) {
        picture.worstTile = {comparison.worstTileX, comparison.worstTileY,
                             std::min(image::tileSize, expected.width - comparison.worstTileX),
                             std::min(image::tileSize, expected.height - comparison.worstTileY)};
        picture.size = {expected.width, expected.height};
    }
    picture.verdict = Verdict::failed;
    picture.reason = comparison.sameSize
                         ? picture.figures
                         : fmt::format("this picture has {}x{} pixels, its golden {}x{}", played.picture.width,
                                       played.picture.height, expected.width, expected.height);
    if (!showsSameState(played, golden)) picture.reason += "; the state that it shows differs too";
}

TestPicture judgedPicture(const Scenario& scenario, const PlayedPicture& played, const std::string& renderer,
                          const Goldens& all) {
    const GoldenFolder& folder = all.folder;
    const GoldenScenario& goldens = goldensOf(scenario, all.manifest);
    TestPicture picture;
    picture.key = played.request.key();
    picture.frame = played.request.frame;
    picture.time = played.time;
    if (played.picture.isWhole()) picture.actual = image::pngBytes(played.picture);
    if (!played.fault.empty()) {
        picture.verdict = Verdict::failed;
        picture.reason = played.fault;
        return picture;
    }
    const auto golden = goldens.pictures.find(picture.key);
    const std::filesystem::path file = folder.picture(scenario.name, picture.key);
    if (golden == goldens.pictures.end() || !core::isThere(file)) {
        picture.verdict = Verdict::missing;
        picture.reason = golden == goldens.pictures.end()
                             ? "no golden picture is kept for this frame yet"
                             : fmt::format("the manifest names a picture that is not there: {}", file.string());
        return picture;
    }
    picture.why = golden->second.why;
    picture.madeBy = golden->second.renderer;
    if (played.request.restart && !core::isThere(folder.stored(scenario.name, picture.key))) {
        picture.verdict = Verdict::missing;
        picture.reason = "the state that this picture is to be drawn from is not stored";
        return picture;
    }
    picture.isOfAnotherRenderer = !isSameRenderer(picture.madeBy, renderer);
    compare(played, golden->second, file, toleranceFor(all.manifest, golden->second, renderer), picture);
    return picture;
}

TestScenario blank(const Scenario& scenario) {
    TestScenario result;
    result.name = scenario.name;
    result.title = scenario.spec.title;
    result.file = scenario.file.string();
    result.framesPerSecond = scenario.spec.run.fps;
    result.sceneSeconds = static_cast<double>(pipeline::frameCount(scenario.spec.run)) / scenario.spec.run.fps;
    result.notes = printed(scenario.warnings);
    return result;
}

}  // namespace

std::string inWords(const image::Tolerance& tolerance) {
    return fmt::format(
        "at most {:.4g} % of its pixels are off by more than {}/255 in any channel, of no tile of {} × {} pixels "
        "more than {:.3g} % by more than {}/255, and the mean of no channel by more than {:.4g}/255",
        100.0 * tolerance.share, tolerance.channel, image::tileSize, image::tileSize, 100.0 * tolerance.tileShare,
        tolerance.tileChannel, tolerance.offset);
}

std::string otherRendererNote(const report::TestReport& report, const Manifest& manifest) {
    int pictures = 0;
    std::string other;
    for (const TestScenario& scenario : report.scenarios)
        for (const TestPicture& picture : scenario.pictures) {
            if (!picture.isOfAnotherRenderer) continue;
            ++pictures;
            other = nameOfRenderer(picture.madeBy);
        }
    if (pictures == 0) return "";
    return fmt::format(
        "{} draws, and {} golden picture{} of {}: held against the tolerance for another renderer, by which a picture "
        "is right when {}",
        nameOfRenderer(report.renderer), pictures, pictures == 1 ? " is" : "s are", other,
        inWords(manifest.otherRenderer));
}

std::vector<std::string> leftOver(const Scenario& scenario, const Manifest& manifest) {
    std::vector<std::string> keys;
    for (const auto& [key, picture] : goldensOf(scenario, manifest).pictures)
        if (std::ranges::none_of(scenario.goldens,
                                 [&, &name = key](const GoldenRequest& request) { return request.key() == name; }))
            keys.push_back(key);
    return keys;
}

bool isOutdated(const Scenario& scenario, const Goldens& goldens) {
    const GoldenScenario& known = goldensOf(scenario, goldens.manifest);
    return isRecorded(known) && known.bits != goldens.bits;
}

TestScenario judged(const Scenario& scenario, const Played& played, const Goldens& all, bool requiresGoldens) {
    const auto& [folder, manifest, bits] = all;
    const GoldenScenario& goldens = goldensOf(scenario, manifest);
    TestScenario result = blank(scenario);
    result.seconds = played.seconds;
    result.checks = played.checks;
    result.notes.insert(result.notes.end(), played.warnings.begin(), played.warnings.end());
    for (const PlayedPicture& picture : played.pictures)
        result.pictures.push_back(judgedPicture(scenario, picture, played.renderer, all));
    if (played.divergence) {
        result.state.verdict = Verdict::diverged;
        result.state.ticks = played.tape.ticks();
        result.state.lastHash = hexadecimal(played.tape.chain.back());
        result.faults.push_back(played.divergence->message);
    } else if (!requiresGoldens && isOfChecksOnly(scenario, folder, goldens)) {
        result.state.word = "checks only";
        result.state.ticks = played.tape.ticks();
        result.state.lastHash = hexadecimal(played.tape.chain.back());
    } else {
        result.state = judgedState(scenario, played, folder, goldens, bits);
    }
    if (isOutdated(scenario, all)) {
        if (!played.divergence) setOutdated(result.state, goldens.bits, bits);
        for (std::size_t i = 0; i < result.pictures.size(); ++i) {
            if (!played.pictures[i].fault.empty()) continue;
            result.pictures[i].verdict = Verdict::outdated;
            result.pictures[i].reason.clear();
        }
    }
    for (const std::string& key : leftOver(scenario, manifest))
        result.notes.push_back(fmt::format("the golden picture {} is asked for no more; --update drops it", key));

    result.verdict = result.state.verdict;
    for (const report::TestCheck& check : result.checks) result.verdict = std::max(result.verdict, check.verdict);
    for (const TestPicture& picture : result.pictures) result.verdict = std::max(result.verdict, picture.verdict);
    if (result.verdict != Verdict::passed) result.changes = changedText(scenario, folder);
    return result;
}

TestScenario unfinished(const Scenario& scenario, const Played& played) {
    TestScenario result = blank(scenario);
    result.verdict = result.state.verdict = Verdict::failed;
    result.seconds = played.seconds;
    result.state.word = "not finished !";
    result.state.ticks = played.tape.chain.empty() ? 0 : played.tape.ticks();
    result.faults.push_back(
        fmt::format("not finished: interrupted at tick {}, {:.4g} s of {:.4g} s", result.state.ticks,
                    static_cast<double>(result.state.ticks) * played.tape.tickSeconds, result.sceneSeconds));
    return result;
}

TestScenario unreadScenario(const UnreadScenario& scenario) {
    TestScenario result;
    result.name = scenario.name;
    result.file = scenario.file.string();
    result.verdict = result.state.verdict = Verdict::failed;
    result.state.word = "not read !";
    result.faults.push_back(scenario.fault);
    return result;
}

TestScenario brokenScenario(const Scenario& scenario, const std::string& fault) {
    TestScenario result = blank(scenario);
    result.verdict = Verdict::failed;
    result.faults.push_back(fault);
    result.state.verdict = Verdict::skipped;
    return result;
}

}  // namespace taut::regression
