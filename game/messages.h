// The output of the program: results on standard output, everything else on standard error. Independent of commands.
//
// Nothing here throws. Failed writes to standard error are dropped, because results must not be lost if nobody reads
// it. areResultsWritten() reports at the end whether standard output has failed.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "taut/core/error.h"

namespace taut::game {

// writeResult() writes a text unchanged. The two below make control characters of a terminal visible.
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

// Faults of a file start with FILE:LINE:COLUMN, because editors understand that only at the start of a line. Other
// messages start with the name of the program.
void printError(const core::Error& error);
void printWarning(std::string_view text);
void printWarnings(const std::vector<core::Finding>& warnings);

// Flushes the output. Returns whether all of it was written, or its reader closed it early.
bool areResultsWritten();

// Opens standard streams that are closed at the start, so that no file of ours gets their numbers. Writing results to
// such a stream fails, and notes disappear.
void openMissingStreams();

}  // namespace taut::game
