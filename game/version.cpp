#include "game/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "commit.h"
#include "taut/world/result_bits.h"

namespace taut::game {

std::string commitText() {
    return TAUT_COMMIT;
}

std::string versionText() {
    return "taut " TAUT_VERSION ", commit " TAUT_COMMIT ", bits " + std::to_string(world::resultBits);
}

std::string versionDate() {
    constexpr std::array months = {"Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    std::istringstream date(TAUT_DATE);  // "22 Nov 2026"
    std::string day, month, year;
    date >> day >> month >> year;
    const auto number = std::ranges::find(months, month) - months.begin() + 1;
    return fmt::format("{}-{:02}-{:0>2}", year, number, day);
}

}  // namespace taut::game
