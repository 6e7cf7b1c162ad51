#include "taut/fields/private/problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <tuple>
#include <utility>

#include "taut/core/error.h"
#include "taut/core/private/edit_distance.h"

namespace taut::fields {

namespace {

constexpr std::size_t maxWidth = 120;   // of a printed source line
constexpr std::size_t maxErrors = 200;  // more help nobody

// Where each line begins.
std::vector<std::size_t> lineStartsOf(std::string_view text) {
    std::vector<std::size_t> starts{0};
    for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n', end + 1))
        starts.push_back(end + 1);
    return starts;
}

// Whether the first byte of a character announces as many bytes as there are.
bool isWholeCharacter(const std::string& bytes) {
    const auto lead = static_cast<unsigned char>(bytes[0]);
    const std::size_t length = lead < 0x80   ? 1
                               : lead < 0xC2 ? 0
                               : lead < 0xE0 ? 2
                               : lead < 0xF0 ? 3
                               : lead < 0xF5 ? 4
                                             : 0;
    return bytes.size() == length;
}

// Bytes of the first character of a text that is not empty.
std::size_t characterLength(std::string_view text) {
    std::size_t length = 1;
    while (length < text.size() && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) ++length;
    return length;
}

// The source line fit to print, and the caret's indent in characters.
std::pair<std::string, std::size_t> excerpt(std::string_view line, int column) {
    // Split into characters; a byte that continues one belongs to the character before.
    std::vector<std::string> characters;
    for (const char c : line) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xC0U) == 0x80U && !characters.empty())
            characters.back() += c;
        else if (c != '\r')
            characters.emplace_back(1, c == '\t' ? ' ' : byte < 0x20 || byte == 0x7F ? '?' : c);
    }
    for (std::string& character : characters)
        if (!isWholeCharacter(character)) character = "?";
    const std::size_t caret = column > 0 ? static_cast<std::size_t>(column) - 1 : 0;
    const std::size_t first = caret > maxWidth - 20 ? caret - maxWidth / 2 : 0;
    std::string shown;
    for (std::size_t i = first; i < std::min(characters.size(), first + maxWidth); ++i) shown += characters[i];
    return {shown, caret - first};
}

// A text must not move the cursor of a terminal.
std::string printable(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
    return text;
}

std::string lowerCase(std::string_view word) {
    std::string lower(word);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return lower;
}

}  // namespace

Problems::Problems(std::string_view text, std::string fileName, std::vector<std::string> labels)
    : files_{{std::move(fileName), text, lineStartsOf(text)}}, labels_(std::move(labels)) {}

int Problems::addBase(std::string text, std::string fileName) {
    const std::string& kept = baseTexts_.emplace_back(std::move(text));
    files_.push_back({std::move(fileName), kept, lineStartsOf(kept)});
    return 1 - static_cast<int>(files_.size());
}

const std::string& Problems::fileOf(Place place) const {
    if (place.origin > 0) return labels_[static_cast<std::size_t>(place.origin) - 1];
    return writtenIn(place).name;
}

std::string_view Problems::lineOf(Place place) const {
    const File& file = writtenIn(place);
    const auto line = static_cast<std::size_t>(std::max(place.line, 1)) - 1;
    if (line >= file.lines.size()) return {};
    const std::string_view rest = file.text.substr(file.lines[line]);
    return rest.substr(0, rest.find('\n'));
}

Place Problems::placeInside(Place place, std::string_view value, std::size_t byte) const {
    if (place.origin > 0) return place;
    // To the quotes, a character of several bytes counting as one.
    std::string_view line = lineOf(place);
    for (int skipped = 1; !line.empty() && skipped < place.column; ++skipped) line.remove_prefix(characterLength(line));
    const char quote = line.empty() ? '\0' : line.front();
    const std::size_t quotes = line.starts_with(std::string(3, quote)) && !value.empty() ? 3 : 1;
    line.remove_prefix(std::min(quotes, line.size()));
    place.column += static_cast<int>(quotes);
    for (std::size_t at = 0; at < byte && at < value.size() && !line.empty();) {
        const bool isEscape = quote == '"' && line.front() == '\\' && line.size() > 1;
        const std::size_t written = !isEscape ? characterLength(line) : line[1] == 'u' ? 6 : line[1] == 'U' ? 10 : 2;
        place.column += static_cast<int>(isEscape ? written : 1);
        line.remove_prefix(std::min(written, line.size()));
        at += characterLength(value.substr(at));
    }
    return place;
}

void Problems::addError(Place place, std::string message, std::string remedy) {
    if (errors_.size() == maxErrors) {
        std::vector<core::Finding> all = errors();
        all.push_back(core::at({}) + "… and more errors");
        throw core::Error(core::ErrorKind::badContent, std::move(all));
    }
    errors_.push_back({place, printable(std::move(message)), printable(std::move(remedy)), subject_});
}

void Problems::addWarning(Place place, std::string message, std::string remedy) {
    warnings_.push_back({place, printable(std::move(message)), printable(std::move(remedy)), subject_});
}

std::vector<core::Finding> Problems::errors() const {
    std::vector<core::Finding> all;
    for (const Problem& problem : sorted(errors_)) all.push_back(finding(problem, core::Severity::error));
    return all;
}

std::vector<core::Finding> Problems::warnings() const {
    std::vector<core::Finding> all;
    for (const Problem& problem : sorted(warnings_)) {
        if (all.size() == maxErrors) break;
        all.push_back(finding(problem, core::Severity::warning));
    }
    return all;
}

std::vector<Problems::Problem> Problems::sorted(const std::vector<Problem>& problems) const {
    // The file comes first, then the files that it builds on, then the overrides.
    const auto rank = [&](const Problem& problem) {
        const int origin = problem.place.origin;
        return std::tuple(origin <= 0 ? -origin : static_cast<int>(files_.size()) + origin, problem.place.line,
                          problem.place.column);
    };
    std::vector<Problem> all = problems;
    std::stable_sort(all.begin(), all.end(), [&](const Problem& a, const Problem& b) { return rank(a) < rank(b); });
    std::vector<Problem> once;
    std::size_t first = 0;  // of those at the same place
    for (Problem& problem : all) {
        if (first < once.size() && rank(once[first]) != rank(problem)) first = once.size();
        const bool isReported =
            std::any_of(once.begin() + static_cast<std::ptrdiff_t>(first), once.end(), [&](const Problem& other) {
                const bool isOfAnother = !other.subject.empty() && !problem.subject.empty();
                return other.message == problem.message || (isOfAnother && other.subject != problem.subject);
            });
        if (!isReported) once.push_back(std::move(problem));
    }
    return once;
}

core::Finding Problems::finding(const Problem& problem, core::Severity severity) const {
    const auto& [place, message, remedy, subject] = problem;
    if (place.origin > 0) return {severity, {fileOf(place)}, message, remedy};
    const auto [line, caret] = excerpt(lineOf(place), place.column);
    return {severity,
            {fileOf(place), place.line, place.column},
            message,
            remedy,
            line + "\n  " + std::string(caret, ' ') + "^"};
}

namespace {

// Other words for those of scenes, of which a candidate is meant however it is spelt.
constexpr std::array<std::array<std::string_view, 2>, 9> synonyms{{{"ball", "sphere"},
                                                                   {"cube", "box"},
                                                                   {"cuboid", "box"},
                                                                   {"floor", "plane"},
                                                                   {"ground", "plane"},
                                                                   {"pill", "capsule"},
                                                                   {"rod", "cylinder"},
                                                                   {"tube", "cylinder"},
                                                                   {"wall", "box"}}};

}  // namespace

std::string likelyWord(std::string_view word, const std::vector<std::string>& candidates) {
    // A short word must match better; very long ones are not worth the time.
    if (word.empty() || word.size() > 60) return {};
    const std::string lower = lowerCase(word);
    for (const auto& [other, meant] : synonyms)
        if (lower == other && std::find(candidates.begin(), candidates.end(), meant) != candidates.end())
            return std::string(meant);
    std::string best;
    int bestDistance = 1 + static_cast<int>(word.size() < 3 ? 1 : word.size() < 8 ? 2 : 3);
    for (const std::string& candidate : candidates) {
        if (candidate.empty() || candidate.size() > 60) continue;
        const bool isStem = word.size() >= 2 && candidate.starts_with(lower + "_");
        const bool isStart = word.size() >= 3 && candidate.starts_with(lower);
        const std::string other = lowerCase(candidate);
        const int wrongStart = other.front() == lower.front() ? 0 : 1;  // a wrong first letter is rare
        const int distance = isStem ? 1 : std::min(core::editDistance(lower, other) + wrongStart, isStart ? 2 : 60);
        if (distance < bestDistance && distance < static_cast<int>(std::max(word.size(), candidate.size()))) {
            best = candidate;
            bestDistance = distance;
        }
    }
    return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
    const std::string likely = likelyWord(word, candidates);
    return likely.empty() ? "" : fmt::format("did you mean \"{}\"?", likely);
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
    return fmt::format("{}", fmt::join(words, separator));
}

}  // namespace taut::fields
