#include "taut/scene/private/measured_curves.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "taut/core/error.h"

namespace taut::scene {

namespace {

using Point = world::FitTarget::Point;

constexpr std::uint64_t maxCurveSize = 4U << 20U;  // [bytes]

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// The numbers between commas; nothing if one of them is none.
std::optional<std::vector<double>> numbersOf(std::string_view line) {
    std::vector<double> numbers;
    for (bool isMore = true; isMore;) {
        const std::size_t comma = line.find(',');
        const std::string_view cell = trimmed(line.substr(0, comma));
        double& number = numbers.emplace_back();
        const auto [end, fault] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
        if (fault != std::errc() || end != cell.data() + cell.size() || !std::isfinite(number)) return std::nullopt;
        isMore = comma != std::string_view::npos;
        if (isMore) line.remove_prefix(comma + 1);
    }
    return numbers;
}

// Throws core::Error(badContent) with the number of the line.
std::vector<Point> pointsOf(std::string_view text, const std::string& file, std::optional<double> sigma) {
    std::vector<Point> points;
    bool mayBeHeadings = true;
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = text.find('\n');
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (line.empty() || line.front() == '#') continue;
        const auto fail = [&](const std::string& why) {
            throw core::Error(core::ErrorKind::badContent, fmt::format("{}:{}: {}", file, number, why));
        };
        const auto numbers = numbersOf(line);
        if (!numbers && std::exchange(mayBeHeadings, false)) continue;
        mayBeHeadings = false;
        if (!numbers || numbers->size() < 2 || numbers->size() > 3)
            fail(fmt::format("\"{}\" is not time, value, and sigma or not", line));
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
        const Place place = root.find("fit")->value.find("target")->value.items[i].find("curve")->value.place;
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
