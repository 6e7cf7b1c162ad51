// Results of other programs for the strips of row R1, as measured: read from CSV. It runs none of them.
#pragma once

#include <string>
#include <vector>

namespace taut::reality {

// A heavy cantilever of theirs.
struct PeerDroop {
    std::string peer;  // program, version and model
    double gamma = 0;  // Γ
    int cells = 0;     // along the strip
    double droop = 0;  // H/W
    bool isAtRest = false;
    double simulated = 0, processor = 0;  // [s] until it rests, and of processor time
    std::string told{};                   // the number that stands for the rigidity
};

// The columns of `text`, named in its first line: peer, gamma, cells, height_over_width, is_at_rest, simulated_s,
// processor_s, told. `file` is its name in messages. Throws core::Error(badContent) with file and line.
std::vector<PeerDroop> readPeers(const std::string& text, const std::string& file);

}  // namespace taut::reality
