#include "taut/reality/comparison.h"

#include <algorithm>
#include <limits>

#include "taut/core/error.h"
#include "taut/core/private/contains.h"
#include "taut/reality/bench.h"
#include "taut/reality/rows.h"

namespace taut::reality {

std::span<const Row> rows() {
    static const Row all[] = {
        {"R1", "a strip droops under its own weight", false, holdCantilever},
        {"R2", "a strip bends under a load on its end", false, holdTipLoad},
        {"R3", "loops of one strip hang", false, holdLoops},
        {"R4", "an upright strip falls over", false, holdStanding},
        {"R5", "a strip is pushed together", false, holdColumn},
        {"R6", "a strip on edge leans aside", true, holdLateral},
        {"R7", "a rod pushed onto a plane slips", false, holdStickSlip},
        {"R8", "a clamped strip swings", false, holdStripModes},
        {"R9", "a hanging chain swings", false, holdChainModes},
        {"R10", "a folded chain falls", false, holdFoldedChain},
        {"R11", "friction holds a rope", false, holdFriction},
        {"R13", "strips of measured fabrics keep a crease", false, holdCreases},
        {"R14", "measured fabrics drape over a disc", true, holdDrape},
        {"R15", "strips of measured fabrics droop", false, holdFabrics},
        {"R16", "a clamped disc is blown up", false, holdDisc},
        {"R17", "a ball is blown up", false, holdBall},
        {"R18", "two sewn discs are blown up", false, holdMylar},
    };
    return all;
}

bool Comparison::passes() const {
    return std::ranges::all_of(lines, &Line::passes);
}

Comparison compare(const Settings& settings) {
    Comparison study;
    Bench bench(settings, study);
    std::vector<const Row*> chosen;
    for (const Row& row : rows()) {
        const bool isNamed = core::contains(settings.rows, row.name);
        if (isNamed || (settings.rows.empty() && (settings.isLong || !row.isLong))) chosen.push_back(&row);
    }
    try {
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            settings.listener.report(static_cast<double>(i) / static_cast<double>(chosen.size()), chosen[i]->title);
            bench.begin(chosen[i]->name);
            try {
                chosen[i]->hold(bench);
            } catch (const core::Error& error) {
                if (error.kind() != core::ErrorKind::diverged) throw;
                constexpr double none = std::numeric_limits<double>::quiet_NaN();
                bench.line(chosen[i]->title, "", none, none, 0, settings.cells, "diverges");
            }
        }
    } catch (const core::Error& error) {
        if (error.kind() != core::ErrorKind::interrupted) throw;
        study.isInterrupted = true;
    }
    settings.listener.report(1.0, "");
    return study;
}

}  // namespace taut::reality
