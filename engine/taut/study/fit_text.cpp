#include "taut/study/fit_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "taut/report/column.h"

namespace taut::study {
namespace {

using Json = nlohmann::ordered_json;
using report::In;

std::string brief(double value) {
    return std::isfinite(value) ? fmt::format("{:.6g}", value) : "-";
}

std::string rounded(double value, int digits) {
    return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "-";
}

// "a, b and c".
std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
    return text;
}

// How many letters all keys begin with, up to a dot.
std::size_t sharedBeginning(const Fit& fit) {
    std::size_t length = fit.keys.size() > 1 ? fit.keys[0].key.rfind('.') + 1 : 0;
    for (const FittedKey& key : fit.keys)
        while (length > 0 && key.key.compare(0, length, fit.keys[0].key, 0, length) != 0)
            length = fit.keys[0].key.rfind('.', length - 2) + 1;
    return length;
}

report::Columns<FitTrial> trialColumns(const Fit& fit) {
    using Trial = FitTrial;
    report::Columns<Trial> columns{{"number", [&fit](const Trial& t) { return &t - fit.trials.data() + 1; }, "trial"}};
    for (std::size_t i = 0; i < fit.keys.size(); ++i)
        columns.emplace_back(
            fit.keys[i].key, [i](const Trial& t) { return t.values[i]; }, fit.keys[i].key.substr(sharedBeginning(fit)),
            [i](const Trial& t) { return brief(t.values[i]); });
    columns.emplace_back("misfit", &Trial::misfit, "misfit",
                         [](const Trial& t) { return t.failure.empty() ? rounded(t.misfit, 4) : t.failure; });
    columns.emplace_back("failure", &Trial::failure);
    return columns;
}

report::Columns<FittedKey> keyColumns() {
    using Key = FittedKey;
    return {{"key", &Key::key, "number"},
            {"before", &Key::before, "before", [](const Key& k) { return brief(k.before); }},
            {"value", &Key::value, "found", [](const Key& k) { return brief(k.value); }},
            {"deviation", &Key::deviation, "+-", [](const Key& k) { return rounded(k.deviation, 2); }},
            {"low", &Key::low, "low", [](const Key& k) { return brief(k.low); }},
            {"high", &Key::high, "high", [](const Key& k) { return brief(k.high); }},
            {"at_bound", &Key::isHeld}};
}

report::Columns<FittedTarget> targetColumns() {
    using Target = FittedTarget;
    return {{"that", &Target::that, "target"},
            {"when", &Target::when, ""},
            {"farthest_s", &Target::time},
            {"measured", &Target::wanted, "measured", [](const Target& t) { return brief(t.wanted); }},
            {"reached", &Target::reached, "here", [](const Target& t) { return brief(t.reached); }},
            {"off_sigma", &Target::off, "off / sigma", [](const Target& t) { return rounded(t.off, 3); }},
            {"met", &Target::isMet, "verdict", [](const Target& t) { return t.isMet() ? "met" : "not met"; }}};
}

// The change that leaves all targets as they are: one number alone, two with their product or quotient kept, or more.
std::string unseenText(const Fit& fit, const std::vector<double>& direction) {
    std::vector<std::size_t> parts;
    double most = 0;
    for (const double part : direction) most = std::max(most, std::abs(part));
    for (std::size_t i = 0; i < direction.size(); ++i)
        if (std::abs(direction[i]) > 0.1 * most) parts.push_back(i);
    const auto key = [&](std::size_t i) { return fit.keys[parts[i]].key; };
    if (parts.size() == 1)
        return fmt::format(
            "The targets do not tell {}: they are alike for very different values. Leave it out, or add "
            "a target that it changes.",
            key(0));
    const bool areLogarithmic = std::ranges::all_of(parts, [&](std::size_t i) { return fit.keys[i].isLogarithmic; });
    std::string seen;
    if (parts.size() == 2 && areLogarithmic) {
        const double power = -direction[parts[0]] / direction[parts[1]];
        const bool isPlain = std::abs(std::abs(power) - 1) < 0.1;
        seen = fmt::format("they see only {} {} {}{}", key(0), power > 0 ? "*" : "/", key(1),
                           isPlain ? "" : fmt::format("^{:.2g}", std::abs(power)));
    } else {
        std::vector<std::string> ways;
        for (std::size_t i = 0; i < parts.size(); ++i)
            ways.push_back(key(i) + (direction[parts[i]] * direction[parts[0]] > 0 ? " grows" : " shrinks"));
        seen = "they stay as they are where " + listed(ways);
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i < parts.size(); ++i) names.push_back(key(i));
    return fmt::format(
        "The targets cannot tell {} apart: {}. Leave one of them out, or add a target that changes "
        "with one alone.",
        listed(names), seen);
}

}  // namespace

std::string fitVerdict(const Fit& fit) {
    std::string text;
    const auto add = [&](const std::string& sentence) { text += (text.empty() ? "" : "\n") + sentence; };
    const auto worst = std::ranges::max_element(
        fit.targets, [](const FittedTarget& a, const FittedTarget& b) { return a.off < b.off; });
    const bool isReached = worst->isMet();
    if (!isReached)
        add(
            fmt::format("The targets {}: with the best numbers found, {} is {:.4g} at {:.4g} s, where {:.4g} was "
                        "measured{}: {:.3g} sigma off.",
                        !fit.hasConverged ? "are not met yet"
                        : fit.starts == 1 ? "are not met from this start"
                                          : fmt::format("are not met from these {} starts", fit.starts),
                        worst->that, worst->reached, worst->time, worst->wanted,
                        worst->when.starts_with("at ") ? "" : "; over all of the curve", worst->off));
    if (!fit.hasConverged)
        add(fmt::format("{} trials did not do. Allow more of them, or begin nearer.", fit.trials.size()));
    for (const FittedKey& key : fit.keys)
        if (key.isHeld)
            add(fmt::format("{} is at its bound: the targets would have it {} than {:.6g}.", key.key,
                            key.value == key.low ? "lower" : "higher", key.value));
    for (const std::vector<double>& direction : fit.unseen) add(unseenText(fit, direction));
    if (isReached && fit.isMet()) add("The targets are met.");
    return text;
}

std::string fitSummary(const Fit& fit) {
    const auto several = [](auto count, const char* what) {
        return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
    };
    std::string text = fmt::format("{}\nSeeks {} by {}.\n", fit.name, several(fit.keys.size(), "number"),
                                   several(fit.values, "measured value"));
    text += "\nTrials (misfit: sum of (off / sigma) squared)\n" +
            aligned(tableOf(trialColumns(fit), fit.trials, In::people));
    text += "\nNumbers (+-: standard deviation)\n" + aligned(tableOf(keyColumns(), fit.keys, In::people));
    text += "\nTargets (met: within 3 sigma; a curve at its worst, and the RMS of all of it)\n" +
            aligned(tableOf(targetColumns(), fit.targets, In::people));
    return text + "\n" + fitVerdict(fit) + "\n";
}

std::string fitJson(const Fit& fit, const MachineFacts& machine) {
    Json json;
    json["scene"] = fit.name;
    for (const auto& [name, value] : machine) json["machine"][name] = value;
    json["met"] = fit.isMet();
    json["verdict"] = fitVerdict(fit);
    json["misfit"] = fit.misfit;
    json["starts"] = fit.starts;
    json["measured_values"] = fit.values;
    json["keys"] = report::jsonOf<Json>(keyColumns(), fit.keys);
    json["correlation"] = fit.correlation;
    json["not_told_apart"] = fit.unseen;
    json["targets"] = report::jsonOf<Json>(targetColumns(), fit.targets);
    json["trials"] = report::jsonOf<Json>(trialColumns(fit), fit.trials);
    json["changes"] = Json::array();
    for (const scene::Change& change : fit.changes)
        json["changes"].push_back({{"key", change.key}, {"value", change.value}});
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace taut::study
