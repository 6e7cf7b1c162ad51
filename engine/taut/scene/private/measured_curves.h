// Reads the CSV files of measurements that the targets of a fit name.
#pragma once

#include "taut/scene/private/scene_reader.h"
#include "taut/scene/private/text_file.h"

namespace taut::scene {

// Fills FitTarget::points. A line is time, value, and sigma or not, with commas between; empty lines, lines that begin
// with # and one line of headings are skipped. Paths are from the folder of the file that names them.
void readCurves(const Node& root, const Confinement& confinement, ReadScene& scene, Problems& problems);

}  // namespace taut::scene
