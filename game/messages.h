// What the program says: results on standard output, everything else on standard error. It knows no command.
//
// Nothing here throws. What cannot be written to standard error is dropped, for results must not be lost because nobody
// listens; that standard output has failed is known at the end, by areResultsWritten().
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "taut/core/error.h"

namespace taut::game {

// As they are; what would steer a terminal is shown as text by the two below.
void writeResult(std::string_view text);
void writeNote(std::string_view text);

void printText(std::string_view text);
template <class... Values>
void printResult(fmt::format_string<Values...> format, Values&&... values) {
    printText(fmt::format(format, std::forward<Values>(values)...));
}
void printNoteText(std::string_view text);
template <class... Values>
void printNote(fmt::format_string<Values...> format, Values&&... values) {
    printNoteText(fmt::format(format, std::forward<Values>(values)...));
}

// Faults of a file come as FILE:LINE:COLUMN, which editors understand at the start of a line only; others are preceded
// by the name of the program.
void printError(const core::Error& error);
void printWarnings(const std::vector<std::string>& warnings);

// Makes sure that what was printed has left, and tells whether all of it did, or its reader wanted no more of it.
bool areResultsWritten();

// Opens what the program was started without, so that no file of ours gets the number of a standard stream: there,
// writing results fails and notes go nowhere.
void openMissingStreams();

}  // namespace taut::game
