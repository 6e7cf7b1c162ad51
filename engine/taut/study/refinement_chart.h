// The pictures of a refinement study, as descriptions that report draws.
#pragma once

#include <string>
#include <vector>

#include "taut/study/refinement.h"
#include "taut/study/work_precision_chart.h"

namespace taut::study {

// "error": bodies with a theory, error against resolution, a panel each. "drape": the other bodies, how far they are
// from their limit, with the band of 1 %. Left out when the study has no such body. `notes` stand at the foot.
std::vector<NamedChart> refinementCharts(const RefinementStudy& study, const std::vector<std::string>& notes);

}  // namespace taut::study
