#include "taut/report/gnuplot.h"

#include <fmt/format.h>

#include "taut/core/error.h"
#include "taut/core/private/child_process.h"
#include "taut/core/whole_file.h"

namespace taut::report {
namespace {

const char* const gnuplotProgram = "gnuplot";

void draw(const Chart& chart, Format format, const std::filesystem::path& path) {
    core::prepareFolderOf(path);
    core::WholeFile file(path);
    const auto fail = [&](const std::string& what) {
        throw core::Error(core::ErrorKind::inputOutput, fmt::format("{}: {}", path.string(), what));
    };
    if (!core::isInPath(gnuplotProgram)) fail(gnuplotMissing());
    // "-d": no settings of the user's own.
    // The picture comes to us, for gnuplot does not tell of a disk that is full.
    const core::ChildResult result = core::runChild({{gnuplotProgram, "-d", "-"}}, gnuplotScript(chart, format));
    if (!result.end.succeeded() || result.output.empty())
        fail(fmt::format("gnuplot {}{}{}", result.end.succeeded() ? "drew nothing" : result.end.text(),
                         result.errors.empty() ? "" : ":\n", result.errors));
    file.write(result.output);
    if (format == Format::svg) file.write("\n");
    file.commit();
}

}  // namespace

void writeChart(const Chart& chart, const std::filesystem::path& stem) {
    draw(chart, Format::svg, stem.string() + ".svg");
    draw(chart, Format::png, stem.string() + ".png");
}

std::string gnuplotVersion() {
    if (!core::isInPath(gnuplotProgram)) return "";
    const core::ChildResult result = core::runChild({{gnuplotProgram, "--version"}});
    return result.end.succeeded() ? result.output.substr(0, result.output.find('\n')) : "";
}

std::string gnuplotMissing() {
    return "gnuplot is not installed. Install the package 'gnuplot-nox'";
}

}  // namespace taut::report
