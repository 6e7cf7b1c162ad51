#include "game/messages.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cstdio>

#include "taut/core/private/utf8.h"

namespace taut::game {
namespace {

// A failure stays with the stream.
void write(std::FILE* stream, std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stream);
}

// As head does when it has had enough.
bool hasReaderGone() {
    pollfd out{STDOUT_FILENO, 0, 0};
    return ::poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

void openIfClosed(int descriptor, int mode) {
    if (::fcntl(descriptor, F_GETFD) != -1) return;
    // Takes the lowest number that is free: those below are open by now.
    [[maybe_unused]] const int opened = ::open("/dev/null", mode);
}

}  // namespace

void writeResult(std::string_view text) {
    write(stdout, text);
}

void writeNote(std::string_view text) {
    write(stderr, text);
}

void printText(std::string_view text) {
    writeResult(core::printable(text));
}

void printNoteText(std::string_view text) {
    writeNote(core::printable(text));
}

void printError(const core::Error& error) {
    printNote("{}{}\n", error.kind() == core::ErrorKind::badContent ? "" : "taut: ", error.what());
}

void printWarning(std::string_view text) {
    printNote("taut: warning: {}\n", text);
}

void printWarnings(const std::vector<core::Finding>& warnings) {
    for (const core::Finding& warning : warnings)
        if (warning.source.file.empty())
            printWarning(printed(warning));
        else
            printNote("{}\n", printed(warning));
}

bool areResultsWritten() {
    return (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) || hasReaderGone();
}

void openMissingStreams() {
    openIfClosed(STDIN_FILENO, O_RDONLY);
    openIfClosed(STDOUT_FILENO, O_RDONLY);
    openIfClosed(STDERR_FILENO, O_WRONLY);
}

}  // namespace taut::game
