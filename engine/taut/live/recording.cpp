#include "taut/live/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <variant>

#include "taut/core/error.h"
#include "taut/live/mouse_hand.h"
#include "taut/scene/private/document.h"
#include "taut/world/result_bits.h"

namespace taut::live {
namespace {

std::string quoted(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        if (c == '\n')
            result += "\\n";
        else
            result += c;
    }
    return result + "\"";
}

std::string numbersText(std::span<const double> numbers) {
    return fmt::format("[{}]", fmt::join(numbers, ", "));
}

// The inverse of fields::fieldValue().
struct ValueText {
    const fields::Field& field;

    std::string operator()(std::monostate) const { return ""; }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t whole) const { return fmt::format("{}", whole); }
    std::string operator()(double number) const { return fmt::format("{}", number); }
    std::string operator()(const std::string& text) const { return quoted(text); }
    std::string operator()(const std::vector<std::string>& texts) const {
        std::string list;
        for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + quoted(text);
        return "[" + list + "]";
    }
    std::string operator()(const std::vector<double>& numbers) const {
        if (field.kind == fields::FieldKind::numbers && numbers.size() == 1) return (*this)(numbers.front());
        if (field.kind != fields::FieldKind::segment) return numbersText(numbers);
        const std::span<const double> all(numbers);
        const std::size_t half = numbers.size() / 2;
        return "[" + numbersText(all.first(half)) + ", " + numbersText(all.last(half)) + "]";
    }
};

// A value that says nothing where it is the default.
bool isNothing(const fields::Value& value) {
    const std::string text = fields::defaultText(value);
    return text.empty() || text == "false" || text == "0";
}

// A moment as a file has it: the tick's, so that nothing is left to rounding.
double momentOf(std::int64_t tick, double ticksPerSecond) {
    return rounded(static_cast<double>(tick) / ticksPerSecond, 6);
}

struct Entry {
    std::int64_t tick;
    const world::ActionSpec* action;
};

// Events by tick: those of the hand come before those of the scene at the same tick, as when played.
std::vector<Entry> entriesOf(const Recording& recording) {
    std::vector<Entry> entries;
    for (const auto* actions : {&recording.deeds, &recording.timeline})
        for (const world::ActionSpec& action : *actions)
            entries.push_back(
                {static_cast<std::int64_t>(std::floor(action.t * recording.ticksPerSecond + 0.5)), &action});
    std::erase_if(
        entries, [&](const Entry& entry) { return entry.tick >= recording.endTick; });
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.tick < b.tick; });
    return entries;
}

std::string claimsText(const Recording& recording) {
    std::string text =
        "\n"
        "# Proposed checks, from measured values; keep the ones that should hold.\n";
    if (recording.hasClaims) text += "golden = []\n";
    text += "check = [\n";
    for (const auto& [body, strain] : recording.strains) {
        const double bound = rounded(std::max(1e-3, 1.3 * strain), 3);
        text += fmt::format("  # {{ that = \"max_strain({}) < {}\" }},  # measured {:.3g}\n", body, bound, strain);
    }
    return text + "]\n";
}

}  // namespace

std::string actionText(const world::ActionSpec& action, double t, const world::KindTable<world::ActionSpec>& kinds) {
    const auto* kind = kinds.find(action.kind());
    if (kind == nullptr)
        throw core::Error(core::ErrorKind::badContent,
                          fmt::format("no table has the kind \"{}\" of an action", action.kind()));
    const auto fresh = kind->make();
    std::string text = fmt::format("{{ t = {}, do = \"{}\"", t, kind->name);
    for (const fields::Field& row : kind->section.fields) {
        const fields::Value value = row.read(dynamic_cast<const void*>(&action));
        if (row.key == "t" || (isNothing(value) && value == row.read(dynamic_cast<const void*>(fresh.get())))) continue;
        text += fmt::format(", {} = {}", row.key, std::visit(ValueText{row}, value));
    }
    return text + " }";
}

std::string overrideLine(const std::string& text) {
    const std::size_t equals = text.find('=');
    std::string key = text.substr(0, equals);
    std::erase_if(key, [](char c) { return c == ' ' || c == '\t'; });
    const std::string value = equals == std::string::npos ? "" : text.substr(equals + 1);
    for (std::size_t begin = 0; begin <= key.size();) {
        const std::size_t end = std::min(key.find('.', begin), key.size());
        const std::string part = key.substr(begin, end - begin);
        if (part.find_first_not_of("0123456789") == std::string::npos || part.find('*') != std::string::npos) return "";
        begin = end + 1;
    }
    const std::string line =
        fmt::format("{} = {}", key, value.substr(std::min(value.find_first_not_of(" \t"), value.size())));
    try {
        scene::documentTree(line, 0);
        return line;
    } catch (const scene::SyntaxError&) {
        return fmt::format("{} = {}", key, quoted(value));
    }
}

std::string scenarioText(const Recording& recording) {
    const double last = static_cast<double>(recording.endTick) / static_cast<double>(recording.ticksPerFrame);
    std::string text = fmt::format("# Recorded by taut play: {} frames, state hash {:016x} at tick {}, bits {}.\n",
                                   last + 1.0, recording.hash, recording.endTick, world::resultBits);
    text += fmt::format("schema = 1\nscene = {}\n", quoted(recording.scene));

    // The last word on each key.
    std::vector<std::pair<std::string, std::string>> lines;  // key, line
    std::string beside;
    for (const std::string& change : recording.overrides) {
        const std::string line = overrideLine(change);
        if (line.empty()) {
            beside += fmt::format(
                "# It was played with --set '{}', which is not part of this file: render it with that too.\n", change);
            continue;
        }
        const std::string key = line.substr(0, line.find(" = "));
        std::erase_if(lines, [&](const auto& other) { return other.first == key; });
        lines.emplace_back(key, line);
    }
    for (const char* own : {"hand.anywhere", "run.fps", "run.seconds"})
        std::erase_if(lines, [&](const auto& other) { return other.first == own; });
    for (const auto& [key, line] : lines) text += line + "\n";
    text += beside;
    text += fmt::format("hand.anywhere = true\nrun.fps = {}\nrun.seconds = {}\n", recording.run.fps,
                        rounded((last + 1.0) / recording.run.fps, 6));

    const auto& kinds = recording.actionKinds ? *recording.actionKinds : world::builtInActions();
    text += "at = [\n";
    for (const Entry& entry : entriesOf(recording))
        text += "  " + actionText(*entry.action, momentOf(entry.tick, recording.ticksPerSecond), kinds) + ",\n";
    return text + "]\n" + claimsText(recording);
}

}  // namespace taut::live
