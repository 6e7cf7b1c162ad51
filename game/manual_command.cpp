#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/manual_page.h"
#include "game/messages.h"
#include "game/version.h"

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
Assets and shaders are looked for in \fIshare/taut\fR beside the folder of the
program, then where it was built.
.SH SEE ALSO
.BR ffmpeg (1),
.BR gnuplot (1)
.PP
\fBtaut schema \-\-manual\fR explains scene files, \fBtaut doctor\fR tells what
is not installed.
)";

Action declareManual(Options& options) {
    options.footer("Example: taut manual | man -l -");
    return [tree = options.tree()] {
        writeResult(manualPage(tree(), {versionDate(), "taut " TAUT_VERSION, manualExplanation}));
        return static_cast<int>(ExitCode::ok);
    };
}

}  // namespace

Command manualCommand() {
    return {"manual", "Print the manual page of the program", declareManual};
}

}  // namespace taut::game
