#include "taut/scene/private/measured_curves.h"

#include <fmt/format.h>

#include <optional>
#include <sstream>
#include <utility>

#include "taut/core/error.h"
#include "taut/core/numbers.h"

namespace taut::scene {

namespace {

using Point = world::FitTarget::Point;

constexpr std::uint64_t maxCurveSize = 4U << 20U;  // [bytes]

// Nothing if one of the cells is no number.
std::optional<std::vector<double>> numbersOf(std::string_view line) {
    std::vector<double> numbers;
    for (const std::string_view cell : core::cellsOf(line)) {
        const auto number = core::numberIn(cell);
        if (!number) return std::nullopt;
        numbers.push_back(*number);
    }
    return numbers;
}

// Throws core::Error(badContent) with the number of the line.
std::vector<Point> pointsOf(const std::string& text, const std::string& file, std::optional<double> sigma) {
    std::vector<Point> points;
    bool mayBeHeadings = true;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        if (line.find_first_not_of(" \t\r") == std::string::npos || line.starts_with('#')) continue;
        const auto fail = [&](const std::string& why) {
            throw core::Error(core::ErrorKind::badContent, fmt::format("{}:{}: {}", file, number, why));
        };
        const auto numbers = numbersOf(line);
        if (!numbers && std::exchange(mayBeHeadings, false)) continue;
        mayBeHeadings = false;
        if (!numbers || numbers->size() < 2 || numbers->size() > 3)
            fail(fmt::format("\"{}\" is not time, value, and optionally sigma", line));
        if (numbers->size() == 2 && !sigma) fail("there is no sigma, here or at the target");
        const Point point{(*numbers)[0], (*numbers)[1], numbers->size() == 3 ? (*numbers)[2] : *sigma};
        if (!(point.sigma > 0)) fail("sigma must be above 0");
        if (point.time < 0 || (!points.empty() && !(point.time > points.back().time)))
            fail("time must begin at 0 or later and ascend");
        points.push_back(point);
    }
    if (points.empty()) throw core::Error(core::ErrorKind::badContent, file + ": there are no numbers in it");
    return points;
}

}  // namespace

void readCurves(const Node& root, const Confinement& confinement, ReadScene& scene, Problems& problems) {
    if (scene.faulty.contains("fit")) return;
    for (std::size_t i = 0; i < scene.spec.fit.targets.size(); ++i) {
        world::FitTarget& target = scene.spec.fit.targets[i];
        if (target.curve.empty()) continue;
        const Place place = root.along({"fit", "target"})->items[i].at("curve")->place;
        const std::filesystem::path namedIn(place.origin > 0 ? scene.spec.file : problems.fileOf(place));
        const std::filesystem::path file = namedIn.parent_path() / target.curve;
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(file, ignored)) {
            problems.addError(place, fmt::format("there is no file \"{}\"", target.curve),
                              fmt::format("looked for {}", file.string()));
            continue;
        }
        try {
            if (!confinement.allows(file)) throw core::Error(core::ErrorKind::badContent, outsideMessage(file));
            target.points = pointsOf(textFile(file, maxCurveSize), file.string(), target.sigma);
        } catch (const core::Error& error) {
            problems.addError(place, fmt::format("cannot use this curve: {}", error.what()));
        }
    }
}

}  // namespace taut::scene
