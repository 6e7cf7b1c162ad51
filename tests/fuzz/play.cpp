#include "fuzz/play.h"

#include <cstdio>
#include <functional>

#include "fuzz/scene_grammar.h"
#include "fuzz/support.h"
#include "support/playing.h"

namespace taut::fuzz {
namespace {

// Limits of a short run: points times steps of a tick, and evaluations in all, for contact may shorten steps.
constexpr double mostWork = 20'000;
constexpr std::int64_t mostEvaluations = 20'000;

bool takesLong(const world::SceneSpec& spec) {
    double work = 0;
    for (const world::IslandInfo& island : world::World(spec, {.threads = 1}).islands())
        work += static_cast<double>(island.points) * island.substeps;
    return work > mostWork;
}

}  // namespace

PlayedScene playedScene(const world::SceneSpec& spec, std::int64_t ticks) {
    using core::InstructionSet;
    if (takesLong(spec)) return {};
    support::Playing plain;
    plain.ticks = ticks;
    plain.evaluations = mostEvaluations;
    const support::Played one = support::play(spec, plain);
    PlayedScene played;
    played.wasPlayed = true;
    // Motion that is too fast is reported before that, unless a given step is far too long.
    if (!spec.solver.dt && one.end.find("not a number") != std::string::npos) played.fault = one.end;
    const auto compare = [&](const char* what, const std::function<void(support::Playing&)>& change) {
        support::Playing how = plain;
        change(how);
        const support::Played other = support::play(spec, how);
        std::string fault = other.fault.empty() ? differenceOf(one, other) : other.fault;
        if (!fault.empty() && played.fault.empty()) played.fault = std::string(what) + ": " + fault;
        played.gain = std::max(played.gain, other.gain);
    };
    std::vector<InstructionSet> sets{InstructionSet::sse2};
    for (InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512})
        if (core::isSupported(set)) sets.push_back(set);
    for (std::size_t i = 0; i < sets.size(); ++i)
        compare(
            "threads and instructions",
            [&](support::Playing& how) {
                how.threads = {i % 2 == 0 ? 2 : 7};
                how.instructions = sets[i];
            });
    compare("asked everything", [](support::Playing& how) { how.asksEvery = 1; });
    compare("saved and restored", [](support::Playing& how) {
        how.threads = {2, 7, 1};
        how.restoresEvery = 1;
    });
    return played;
}

// Bytes are choices of a grammar, not a text: each of them is a scene.
void readPlay(View bytes) {
    static double mostGain = 0.01;
    const GrownScene scene = grownScene(bytes);
    const PlayedScene played = playedScene(scene::loadSceneText(scene.text, "play.toml", alone()).spec, 6);
    if (scene.isClosed && played.gain > mostGain) {
        mostGain = played.gain;
        std::fprintf(stderr, "energy rises by %.3g of what moved:\n%s\n", played.gain, scene.text.c_str());
    }
    if (!played.fault.empty()) std::fprintf(stderr, "%s\n%s\n", played.fault.c_str(), scene.text.c_str());
    TAUT_EXPECTS(played.fault.empty());
}

}  // namespace taut::fuzz
