// The picture of a comparison, as a description that report draws.
#pragma once

#include <string>
#include <vector>

#include "taut/reality/comparison.h"
#include "taut/report/chart.h"

namespace taut::reality {

// Height over width of heavy cantilevers over Γ, with the results of other programs. `notes` stand at the foot.
report::Chart droopChart(const std::vector<DroopCurve>& curves, const std::vector<PeerDroop>& peers,
                         const std::vector<std::string>& notes);
// Drape coefficients over the weight of the cloth, a colour per fabric, beside the measurements.
report::Chart drapeChart(const std::vector<DrapeBand>& bands, const std::vector<std::string>& notes);

}  // namespace taut::reality
