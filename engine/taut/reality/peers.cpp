#include "taut/reality/peers.h"

#include <fmt/format.h>

#include <sstream>
#include <string_view>

#include "taut/core/error.h"
#include "taut/core/numbers.h"

namespace taut::reality {
namespace {

constexpr std::string_view header = "peer,gamma,cells,height_over_width,is_at_rest,simulated_s,processor_s,told";
constexpr std::size_t columnCount = 8;

[[noreturn]] void fail(const std::string& file, int line, const std::string& what) {
    throw core::Error(core::ErrorKind::badContent,
                      fmt::format("{}:{}: {}; tests/bench/peers.sh writes such a file", file, line, what));
}

}  // namespace

std::vector<PeerDroop> readPeers(const std::string& text, const std::string& file) {
    std::vector<PeerDroop> peers;
    std::istringstream lines(text);
    std::string line;
    int count = 0;
    const auto number = [&](std::string_view cell, double least, double most) {
        const auto value = core::numberIn(cell);
        if (!value || *value < least || *value > most)
            fail(file, count, fmt::format("\"{}\" is no number from {:g} to {:g}", cell, least, most));
        return *value;
    };
    while (std::getline(lines, line)) {
        ++count;
        if (line.ends_with('\r')) line.pop_back();
        if (count == 1) {
            if (line != header) fail(file, count, fmt::format("the first line is not \"{}\"", header));
            continue;
        }
        const std::vector<std::string_view> cells = core::cellsOf(line);
        if (cells.size() != columnCount)
            fail(file, count, fmt::format("{} columns instead of {}", cells.size(), columnCount));
        PeerDroop peer;
        peer.peer = cells[0];
        peer.gamma = number(cells[1], 1e-6, 1e6);
        peer.cells = static_cast<int>(number(cells[2], 1, 1e6));
        peer.droop = number(cells[3], -1e12, 1e12);
        peer.isAtRest = number(cells[4], 0, 1) != 0;
        peer.simulated = number(cells[5], 0, 1e12);
        peer.processor = number(cells[6], 0, 1e12);
        peer.told = cells[7];
        peers.push_back(peer);
    }
    if (peers.empty()) fail(file, count, "there is no strip in it");
    return peers;
}

}  // namespace taut::reality
