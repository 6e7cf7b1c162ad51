// Draws charts with the program gnuplot. Independent of their meaning.
#pragma once

#include <filesystem>
#include <string>

#include "taut/report/chart.h"

namespace taut::report {

enum class Format { svg, png };

// The script that makes gnuplot draw the chart to its standard output, data included.
std::string gnuplotScript(const Chart& chart, Format format);

// Writes stem.svg and stem.png, each completely or not at all. Throws core::Error(inputOutput): gnuplot is not
// installed (with the name of the package), failed (with its message), or the files cannot be written.
void writeChart(const Chart& chart, const std::filesystem::path& stem);

// "gnuplot 5.4 patchlevel 4"; empty when it does not run.
std::string gnuplotVersion();

// The message if gnuplot is missing.
std::string gnuplotMissing();

}  // namespace taut::report
