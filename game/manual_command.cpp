#include <fmt/format.h>

#include <memory>
#include <string>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/folders.h"
#include "game/manual_page.h"
#include "game/messages.h"
#include "game/version.h"
#include "taut/core/whole_file.h"

namespace taut::game {
namespace {

const char* const manualExplanation =
    R"(.SH ENVIRONMENT
.TP
.B TAUT_ASSETS
The folder of the shipped scenes, models and textures.
.TP
.B TAUT_SHADERS
The folder of the shaders.
.TP
.B TAUT_FONT
A TrueType file for labels and figures.
.TP
.B TAUT_SIMD
What \fB\-\-isa\fR would say.
.TP
.B LP_NUM_THREADS
How many threads draw without a graphics card.
.SH FILES
Assets, shaders and the pages of the manual are looked for in \fIshare/taut\fR beside the folder of the
program, then where it was built.
.SH SEE ALSO
.BR ffmpeg (1),
.BR gnuplot (1)
.PP
\fBtaut manual\fR \fIPAGE\fR explains how to use the program, \fBtaut schema
\-\-manual\fR every field of scene files, \fBtaut doctor\fR tells what
is not installed.
)";

Action declareManual(Options& options) {
    const auto page = std::make_shared<std::string>();
    options.value("PAGE", *page, "A page of the manual, in Markdown; this program's page for man when left out")
        .oneOf(manualPages());
    options.footer(
        "Examples:\n"
        "  taut manual | man -l -\n"
        "  taut manual contact");
    return [page, tree = options.tree()] {
        writeResult(page->empty() ? manualPage(tree(), {versionDate(), "taut " TAUT_VERSION, manualExplanation})
                                  : core::fileContent(manualFolder() / (*page + ".md")));
        return static_cast<int>(ExitCode::ok);
    };
}

}  // namespace

Command manualCommand() {
    return {"manual", "Print a page of the manual, or the page for man", declareManual};
}

}  // namespace taut::game
