#include "taut/report/palette.h"

#include <array>
#include <cstdint>

namespace taut::report {
namespace {

struct Named {
    std::string_view name;
    Style style;
};

constexpr double width = 1.8;

Style style(const char* colour, Mark mark, bool isFilled, Dash dash) {
    return {colour, mark, isFilled, dash, width, 1.0};
}

// Hues after Okabe and Ito (2008), darkened where a thin line on white needs it. Related methods have
// related hues and differ in mark, filling and dashes.
const std::array<Named, 10>& named() {
    static const std::array<Named, 10> all = {{
        {"leapfrog", style("#d55e00", Mark::circle, true, Dash::solid)},
        {"velocity-verlet", style("#e69f00", Mark::circle, false, Dash::dashed)},
        {"symplectic-euler", style("#b5539c", Mark::diamond, true, Dash::solid)},
        {"euler", style("#7f7f7f", Mark::down, true, Dash::solid)},
        {"heun", style("#0072b2", Mark::triangle, true, Dash::solid)},
        {"midpoint", style("#56b4e9", Mark::triangle, false, Dash::dashed)},
        {"rk4", style("#101010", Mark::square, true, Dash::solid)},
        {"blanes-moan", style("#8c1d2f", Mark::star, true, Dash::solid)},
        {"implicit-euler", style("#009e73", Mark::pentagon, true, Dash::solid)},
        {"sdirk2", style("#5aa05a", Mark::pentagon, false, Dash::dashed)},
    }};
    return all;
}

const std::array<Style, 6>& spare() {
    static const std::array<Style, 6> all = {{
        style("#7a3b1e", Mark::square, false, Dash::dashed),
        style("#4b2e83", Mark::diamond, false, Dash::dashed),
        style("#8a8a00", Mark::pentagon, false, Dash::dashed),
        style("#004d40", Mark::down, false, Dash::dotted),
        style("#ad1457", Mark::star, true, Dash::dotted),
        style("#37474f", Mark::plus, true, Dash::dashDotted),
    }};
    return all;
}

}  // namespace

Style styleOf(std::string_view name) {
    for (const Named& entry : named())
        if (entry.name == name) return entry.style;
    std::uint32_t hash = 0;
    for (const char c : name) hash = hash * 31U + static_cast<unsigned char>(c);
    return spare()[hash % spare().size()];
}

ColourScale divergingScale(double least, double middle, double most) {
    const auto below = [&](double part) { return middle + part * (least - middle); };
    const auto above = [&](double part) { return middle + part * (most - middle); };
    return {"",
            {{least, "#0b3c6f"},
             {below(0.5), "#4a90c4"},
             {below(0.15), "#c6dcee"},
             {middle, "#fbfbf7"},
             {above(0.15), "#fbd9b0"},
             {above(0.5), "#e8813a"},
             {most, "#8f2d04"}},
            {}};
}

}  // namespace taut::report
