#include "taut/core/private/instruction_set.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <vector>

#include "taut/core/error.h"
#include "taut/core/private/trial_kernel.h"

namespace taut::core {

TAUT_KERNELS(template <class Real> void pullSprings(const Real* x, Real* f);)

namespace {

#define TAUT_SET_TEXT(set, condition, ...) std::string_view(#set),
constexpr std::array names{TAUT_SETS(TAUT_SET_TEXT)};

// A set with the work to be timed, and the least that it took [ns].
struct Contestant {
    InstructionSet set;
    void (*single)(const float*, float*);
    void (*twice)(const double*, double*);
    double leastSingle = HUGE_VAL, leastTwice = HUGE_VAL;
};

template <class Work>
double nanosecondsOf(Work&& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
}

std::vector<InstructionSetTime> trial() {
    constexpr int rounds = 24;  // the least of so many is hardly disturbed
    constexpr std::size_t size = 3 * (trialPoints + trialReach);
    std::vector<float> x(size), f(size);
    std::vector<double> xx(size), ff(size);
    for (std::size_t i = 0; i < size; ++i) xx[i] = x[i] = static_cast<float>(i * i % 97);
    std::vector<Contestant> contestants;
#define TAUT_CONTESTANT(set, condition, ...) Contestant{InstructionSet::set, set::pullSprings, set::pullSprings},
    for (const Contestant& c : {TAUT_SETS(TAUT_CONTESTANT)})
        if (isSupported(c.set)) contestants.push_back(c);
    // In turns, so that other work of the machine affects all equally.
    for (int round = 0; round < rounds; ++round)
        for (Contestant& c : contestants) {
            c.leastSingle = std::min(c.leastSingle, nanosecondsOf([&] { c.single(x.data(), f.data()); }));
            c.leastTwice = std::min(c.leastTwice, nanosecondsOf([&] { c.twice(xx.data(), ff.data()); }));
        }
    std::vector<InstructionSetTime> times;
    for (const Contestant& c : contestants)
        times.push_back({c.set, std::sqrt(c.leastSingle * c.leastTwice) / (trialPoints * trialOffsets)});
    return times;
}

struct Choice {
    InstructionSet set;
    std::string reason;
};

Choice choiceOf(std::string_view name, const std::string& reason) {
    if (name == "auto") {
        const std::vector<InstructionSetTime> times = trial();
        return {fastestOf(times), textOf(times)};
    }
    std::string expected;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto set = static_cast<InstructionSet>(i);
        expected += std::string(names[i]) + (i + 1 < names.size() ? ", " : " or auto");
        if (names[i] != name) continue;
        if (isSupported(set)) return {set, reason};
        throw Error(ErrorKind::usage, reason + " " + std::string(name) + ": this processor does not have it");
    }
    throw Error(ErrorKind::usage, reason + " " + std::string(name) + ": expected " + expected);
}

Choice chosenAtStart() {
    const char* wish = std::getenv("TAUT_SIMD");
    return choiceOf(wish != nullptr && *wish != '\0' ? wish : "auto", "TAUT_SIMD");
}

// Kernels are looked up from any thread.
class Current {
  public:
    InstructionSet set() {
        ask();
        return set_.load();
    }
    std::string reason() {
        ask();
        const std::lock_guard lock(mutex_);
        return reason_;
    }
    void use(const Choice& choice) {
        const std::lock_guard lock(mutex_);
        set_.store(choice.set);
        reason_ = choice.reason;
        isKnown_.store(true);
    }

  private:
    void ask() {
        if (isKnown_.load()) return;
        const std::lock_guard lock(mutex_);
        if (isKnown_.load()) return;
        const Choice choice = chosenAtStart();
        set_.store(choice.set);
        reason_ = choice.reason;
        isKnown_.store(true);
    }
    std::mutex mutex_;
    std::atomic<bool> isKnown_ = false;
    std::atomic<InstructionSet> set_{};
    std::string reason_;
};

Current& current() {
    static Current only;
    return only;
}

}  // namespace

std::string_view nameOf(InstructionSet set) {
    return names.at(static_cast<std::size_t>(set));
}

bool isSupported(InstructionSet set) {
#define TAUT_SET_CONDITION(set, condition, ...) condition,
    const bool has[] = {TAUT_SETS(TAUT_SET_CONDITION)};
    return has[static_cast<std::size_t>(set)];
}

InstructionSet instructionSet() {
    return current().set();
}

std::string instructionSetReason() {
    return current().reason();
}

void chooseInstructionSet(std::string_view name, const std::string& reason) {
    current().use(choiceOf(name, reason));
}

void useInstructionSet(InstructionSet set) {
    TAUT_EXPECTS(isSupported(set));
    current().use({set, "asked for"});
}

std::string textOf(std::span<const InstructionSetTime> times) {
    std::string text = "trial:";
    for (const InstructionSetTime& time : times) {
        char number[32];
        std::snprintf(number, sizeof number, " %.2f", time.nanoseconds);
        text += (&time == times.data() ? " " : ", ") + std::string(nameOf(time.set)) + number;
    }
    return text + " ns";
}

InstructionSet fastestOf(std::span<const InstructionSetTime> times) {
    TAUT_EXPECTS(!times.empty());
    InstructionSetTime best = times.front();
    for (const InstructionSetTime& time : times)
        if (time.nanoseconds < 0.95 * best.nanoseconds) best = time;
    return best.set;
}

}  // namespace taut::core
