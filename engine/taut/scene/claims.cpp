#include "taut/scene/private/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "taut/check/check.h"
#include "taut/check/figures.h"
#include "taut/check/private/function_table.h"
#include "taut/scene/private/body_index.h"
#include "taut/scene/private/references.h"
#include "taut/scene/private/timeline.h"
#include "taut/spec/actions.h"
#include "taut/spec/ticks.h"

namespace taut::scene {

namespace {

class Claims {
  public:
    Claims(const Node& root, const BodyIndex& bodies, ReadScene& scene, Problems& problems)
        : root_(root), scene_(scene), problems_(problems), bodies_(bodies), ticks_(scene.spec.run) {}

    void check() {
        for (std::size_t i = 0; i < scene_.spec.checks.size(); ++i) {
            if (scene_.faulty.contains(fmt::format("check[{}]", i))) continue;
            const Node& item = root_.at("check")->items[i];
            checkTimes(item);
            checkClaim(scene_.spec.checks[i], *item.at("that"));
        }
        for (std::size_t i = 0; i < scene_.spec.fit.targets.size(); ++i)
            checkTarget(scene_.spec.fit.targets[i], root_.along({"fit", "target"})->items[i]);
    }

  private:
    void checkTimes(const Node& item) {
        for (const char* key : {"at", "from", "to"}) {
            const Member* member = item.find(key);
            if (member == nullptr || ticks_.at(member->value.number) <= ticks_.last() || isLengthOverridden(root_))
                continue;
            problems_.addError(member->value.place,
                               fmt::format("{} s is past the end: the last frame shows {:.6g} s", member->value.number,
                                           ticks_.secondsOf(ticks_.last())),
                               "set seconds in [run]");
        }
    }

    void checkClaim(world::CheckSpec& spec, const Node& that) {
        const Place first = problems_.placeInside(that.place, that.text, 0);
        spec.source = {problems_.fileOf(first), std::max(first.line, 0), std::max(first.column, 0)};
        if (first.origin > 0) spec.source = {problems_.fileOf(first), 0, 0};
        try {
            spec.parsed = std::make_shared<const check::Check>(check::Check::parse(spec.that));
            for (const check::Mention& mention : spec.parsed->mentions())
                checkMention(spec.at ? *spec.at : spec.from.value_or(0.0), "give the check a later from", that,
                             mention);
            for (const check::Call& call : spec.parsed->calls()) doubtCall(that, call);
        } catch (const check::ClaimError& fault) {
            problems_.addError(problems_.placeInside(that.place, that.text, fault.at), fault.what(), fault.remedy);
        }
    }

    void checkTarget(const world::FitTarget& target, const Node& item) {
        if (target.points.empty()) return;  // something else is wrong with it
        if (ticks_.at(target.points.back().time) > ticks_.last() && !isLengthOverridden(root_))
            problems_.addError(item.at(target.curve.empty() ? "at" : "curve")->place,
                               fmt::format("{:.6g} s is past the end: the last frame shows {:.6g} s",
                                           target.points.back().time, ticks_.secondsOf(ticks_.last())),
                               "set seconds in [run]");
        const Node& that = *item.at("that");
        try {
            const check::Figures figures = check::Figures::parse(target.that);
            if (figures.names().size() != 1)
                problems_.addError(that.place, fmt::format("this is {} numbers, not one", figures.names().size()),
                                   "of a vector .x, .y or .z, or length(…)");
            for (const check::Mention& mention : figures.mentions())
                checkMention(target.points.front().time, "measure it later", that, mention);
        } catch (const check::ClaimError& fault) {
            problems_.addError(problems_.placeInside(that.place, that.text, fault.at), fault.what(), fault.remedy);
        }
    }

    // A body that is measured from a time on must exist by then.
    void checkMention(double begin, const char* remedy, const Node& that, const check::Mention& mention) {
        const Place place = problems_.placeInside(that.place, that.text, mention.at);
        if (mention.isJoint) {
            if (const auto fault = nameFault(scene_.spec, mention.target))
                problems_.addError(place, fault->message, fault->remedy);
            return;
        }
        const auto fault = mention.hasPoints ? bodies_.targetFault(mention.target) : bodies_.bodyFault(mention.target);
        if (fault) return problems_.addError(place, fault->message, fault->remedy);
        if (!mention.against.empty())
            if (const auto same = bodies_.betweenFault(mention.against, mention.target))
                return problems_.addError(place, same->message, same->remedy);
        if (!mention.isNeeded) return;
        std::optional<double> birth;
        for (const std::string& name : bodies_.names(mention.target)) {
            const std::optional<double> t = birthOf(name);
            if (!t) return;
            birth = birth ? std::min(*birth, *t) : *t;
        }
        if (!birth || ticks_.at(*birth) < ticks_.at(begin)) return;
        problems_.addError(place,
                           fmt::format("{} is not there at {} s: it is spawned at {} s", mention.target, begin, *birth),
                           remedy);
    }

    // A function that can never find anything is hardly meant.
    void doubtCall(const Node& that, const check::Call& call) {
        if (call.function->counts == world::Counts::everyBody) return;
        const bool isOfFaces = call.function->counts == world::Counts::bodiesMeetingFaces;
        const auto countsAny = [&](const std::string& target) {
            const std::vector<const BodyEntry*> named = bodies_.matches(target);
            return std::any_of(scene_.spec.bodies.begin(), scene_.spec.bodies.end(), [&](const world::BodySpec& body) {
                const auto isIt = [&](const BodyEntry* entry) { return entry->title() == body.fullName(); };
                return world::isCounted(call.function->counts, body) &&
                       (target.empty() || std::any_of(named.begin(), named.end(), isIt));
            });
        };
        const auto doubt = [&](std::size_t at, const std::string& lack) {
            const std::string what = isOfFaces ? lack + " corners or edges of colliders" : lack;
            problems_.addWarning(
                problems_.placeInside(that.place, that.text, at),
                fmt::format("{}: {}", what,
                            call.function->isBetween() ? "it passes through other bodies"
                                                       : call.function->name + " is always 0"),
                isOfFaces ? "give it collide = \"faces\", or touch" : "give it touch = \"others\" or \"all\"");
        };
        for (const check::Mention& mention : call.targets)
            if (!countsAny(mention.target))
                doubt(mention.at, mention.target + (isOfFaces ? " meets no" : " touches nothing"));
        if (call.targets.empty() && !countsAny(""))
            doubt(call.at, isOfFaces ? "no body meets" : "no body touches anything");
    }

    // When a body is spawned; nothing if it is there from the start.
    std::optional<double> birthOf(const std::string& body) const {
        for (const auto& spawn : scene_.spec.actions.of<world::SpawnAction>()) {
            const std::vector<std::string> names = bodies_.names(spawn.target);
            if (std::find(names.begin(), names.end(), body) != names.end()) return spawn.t;
        }
        return std::nullopt;
    }

    const Node& root_;
    ReadScene& scene_;
    Problems& problems_;
    const BodyIndex& bodies_;
    world::Ticks ticks_;
};

void checkGoldens(const Node& root, const ReadScene& scene, Problems& problems) {
    const std::int64_t last = world::Ticks(scene.spec.run).lastFrame;
    const std::int64_t first = world::Ticks(scene.spec.run).firstFrame;
    for (std::size_t i = 0; i < scene.spec.goldens.size(); ++i) {
        if (scene.faulty.contains(fmt::format("golden[{}]", i))) continue;
        const Node& frames = *root.at("golden")->items[i].at("frames");
        for (const Node& frame : frames.items) {
            if (frame.whole < first)
                problems.addError(frame.place, fmt::format("frame {} is before the start: the first is {}, from {}",
                                                           frame.whole, first, scene.spec.run.start));
            if (frame.whole <= last || isLengthOverridden(root)) continue;
            problems.addError(frame.place, fmt::format("frame {} is past the end: the last is {}", frame.whole, last));
        }
    }
}

}  // namespace

void checkClaims(const Node& root, const BodyIndex& bodies, ReadScene& scene, Problems& problems) {
    Claims(root, bodies, scene, problems).check();
    checkGoldens(root, scene, problems);
}

}  // namespace taut::scene
