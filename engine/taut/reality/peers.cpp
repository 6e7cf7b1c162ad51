#include "taut/reality/peers.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

#include "taut/core/error.h"

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
    const auto number = [&](const std::string& word, double least, double most) {
        double value = NAN;
        const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (code != std::errc() || end != word.data() + word.size() || !(value >= least && value <= most))
            fail(file, count, fmt::format("\"{}\" is no number from {:g} to {:g}", word, least, most));
        return value;
    };
    while (std::getline(lines, line)) {
        ++count;
        if (line.ends_with('\r')) line.pop_back();
        if (count == 1) {
            if (line != header) fail(file, count, fmt::format("the first line is not \"{}\"", header));
            continue;
        }
        std::vector<std::string> words;
        std::istringstream rest(line);
        for (std::string word; std::getline(rest, word, ',');) words.push_back(word);
        if (words.size() != columnCount)
            fail(file, count, fmt::format("{} columns instead of {}", words.size(), columnCount));
        PeerDroop peer;
        peer.peer = words[0];
        peer.gamma = number(words[1], 1e-6, 1e6);
        peer.cells = static_cast<int>(number(words[2], 1, 1e6));
        peer.droop = number(words[3], -1e12, 1e12);
        peer.isAtRest = number(words[4], 0, 1) != 0;
        peer.simulated = number(words[5], 0, 1e12);
        peer.processor = number(words[6], 0, 1e12);
        peer.told = words[7];
        peers.push_back(peer);
    }
    if (peers.empty()) fail(file, count, "there is no strip in it");
    return peers;
}

}  // namespace taut::reality
