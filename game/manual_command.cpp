#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/folders.h"
#include "game/manual_page.h"
#include "game/messages.h"
#include "game/usage.h"
#include "game/version.h"
#include "taut/core/private/contains.h"
#include "taut/core/whole_file.h"

namespace taut::game {
namespace {

const char* const manualExplanation =
    R"(.SH ENVIRONMENT
.TP
.B TAUT_ASSETS
Folder of the shipped scenes, models and textures.
.TP
.B TAUT_SHADERS
Folder of the shaders.
.TP
.B TAUT_FONT
A TrueType file for labels and figures.
.TP
.B TAUT_SIMD
Vector instructions: sse2, avx2, avx512, or auto, the default: the fastest in a short trial. The
bits are the same.
.TP
.B LP_NUM_THREADS
Number of threads that draw without a graphics card.
.SH FILES
Assets, shaders and the pages of the manual are in \fIshare/taut\fR beside the folder of the
program, or where it was built.
.SH SEE ALSO
.BR ffmpeg (1),
.BR gnuplot (1)
.PP
\fBtaut manual\fR \fIPAGE\fR describes how to use the program, \fBtaut schema
\-\-manual\fR every field of scene files, \fBtaut doctor\fR reports
missing packages.
)";

struct Heading {
    std::string page, text;
};

// The headings of all pages that hold the word, in letters of either case.
std::vector<Heading> headingsWith(const std::string& word) {
    const auto lower = [](std::string text) {
        std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
        return text;
    };
    std::vector<Heading> all;
    for (const std::string& page : manualPages()) {
        std::istringstream lines(core::fileContent(manualFolder() / (page + ".md")));
        bool isCode = false;
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with("```")) isCode = !isCode;
            if (!isCode && line.starts_with('#') && lower(line).find(lower(word)) != std::string::npos)
                all.push_back({page, line.substr(line.find_first_not_of("# "))});
        }
    }
    return all;
}

// The page of that name, or the one that has a heading with the word; of several their list.
void printPage(const std::string& word) {
    const std::vector<std::string> pages = manualPages();
    std::set<std::string> found;
    const std::vector<Heading> headings = headingsWith(word);
    for (const Heading& heading : headings) found.insert(heading.page);
    if (core::contains(pages, word)) found = {word};
    if (found.empty())
        failUsage("no page of the manual has this name or a heading with it: {}; pages: {}", word,
                  fmt::join(pages, ", "));
    if (found.size() == 1) return writeResult(core::fileContent(manualFolder() / (*found.begin() + ".md")));
    for (const Heading& heading : headings) printResult("taut manual {:<20} {}\n", heading.page, heading.text);
}

Action declareManual(Options& options) {
    const auto page = std::make_shared<std::string>();
    options.value("PAGE", *page, "A page of the manual, or a word of one of its headings; default the page for man")
        .suggests(manualPages());
    options.footer(
        "Examples:\n"
        "  taut manual | man -l -\n"
        "  taut manual contact\n"
        "  taut manual sleep");
    return [page, tree = options.tree()] {
        if (page->empty())
            writeResult(manualPage(tree(), {versionDate(), "taut " TAUT_VERSION, manualExplanation}));
        else
            printPage(*page);
        return static_cast<int>(ExitCode::ok);
    };
}

}  // namespace

Command manualCommand() {
    return {"manual", "Print a page of the manual, or the page for man", declareManual};
}

}  // namespace taut::game
