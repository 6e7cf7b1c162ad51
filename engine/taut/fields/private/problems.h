// Collects errors and warnings of a text and lists them in the order of the file, each with its line and a caret.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "taut/core/finding.h"
#include "taut/fields/node.h"

namespace taut::fields {

class Problems {
  public:
    // The text is kept by reference. labels[k - 1] names override k, e.g. "--set cloth.flag.cells".
    Problems(std::string_view text, std::string fileName, std::vector<std::string> labels);

    // A file that the one before builds on. Returns the origin of its places: -1, then -2, and so on.
    int addBase(std::string text, std::string fileName);

    // Subject of the next problems: "rope.line", or none. A problem at a place that several elements share is reported
    // for the first only.
    void about(std::string subject) { subject_ = std::move(subject); }

    // The file, or the name of the override.
    const std::string& fileOf(Place place) const;

    // The place of a byte of a text value that is written at `place`.
    Place placeInside(Place place, std::string_view value, std::size_t byte) const;

    // A remedy is a short phrase printed beside the caret: the correct text. After 200 errors the next one throws them
    // as core::Error(badContent), because each may cost a search for a similar word.
    void addError(Place place, std::string message, std::string remedy = {});
    void addWarning(Place place, std::string message, std::string remedy = {});

    int errorCount() const { return static_cast<int>(errors_.size()); }

    // Sorted: the file from top to bottom, then its base files, then the overrides in their order.
    std::vector<core::Finding> errors() const;
    std::vector<core::Finding> warnings() const;

  private:
    struct Problem {
        Place place;
        std::string message, remedy, subject;
    };
    struct File {
        std::string name;
        std::string_view text;
        std::vector<std::size_t> lines;  // where each begins
    };
    std::vector<Problem> sorted(const std::vector<Problem>& problems) const;
    core::Finding finding(const Problem& problem, core::Severity severity) const;

    const File& writtenIn(Place place) const { return files_[-place.origin]; }
    std::string_view lineOf(Place place) const;

    std::deque<std::string> baseTexts_;
    std::vector<File> files_;  // the first file, then its base files
    std::vector<std::string> labels_;
    std::string subject_;
    std::vector<Problem> errors_, warnings_;
};

// The candidate that a mistyped word probably means, or an empty text. Also finds "density_kg_per_m2" for "density".
std::string likelyWord(std::string_view word, const std::vector<std::string>& candidates);

// `did you mean "x"?`, or an empty text.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

// "a, b, c"
std::string joined(const std::vector<std::string>& words, std::string_view separator = ", ");

}  // namespace taut::fields
