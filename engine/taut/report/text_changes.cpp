#include "taut/report/text_changes.h"

#include <algorithm>
#include <cstddef>

namespace taut::report {
namespace {

using Lines = std::vector<std::string_view>;

Lines linesOf(std::string_view text) {
    Lines lines;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        if (line.ends_with('\r')) line.remove_suffix(1);
        lines.push_back(line);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return lines;
}

TextChange changeOf(char sign, const Lines& lines, std::size_t i) {
    return {sign, static_cast<int>(i) + 1, std::string(lines[i])};
}

// The lines from `first` up to `aEnd` and `bEnd` by their longest common subsequence: length[i][j] is that of the
// lines after a[i] and b[j].
void compareMiddle(const Lines& a, const Lines& b, std::size_t first, std::size_t aEnd, std::size_t bEnd,
                   std::vector<TextChange>& all) {
    constexpr std::size_t most = 4'000'000;  // of its table; longer texts are taken as wholly new
    const std::size_t rows = aEnd - first, columns = bEnd - first;
    const bool fits = rows * columns <= most;
    std::vector<int> length(fits ? (rows + 1) * (columns + 1) : 0, 0);
    const auto at = [&](std::size_t i, std::size_t j) -> int& { return length[i * (columns + 1) + j]; };
    for (std::size_t i = fits ? rows : 0; i-- > 0;)
        for (std::size_t j = columns; j-- > 0;)
            at(i, j) = a[first + i] == b[first + j] ? 1 + at(i + 1, j + 1) : std::max(at(i + 1, j), at(i, j + 1));
    std::size_t i = 0, j = 0;
    while (i < rows || j < columns) {
        if (fits && i < rows && j < columns && a[first + i] == b[first + j]) {
            all.push_back(changeOf(' ', b, first + j++));
            ++i;
        } else if (i < rows && (j == columns || !fits || at(i + 1, j) >= at(i, j + 1))) {
            all.push_back(changeOf('-', a, first + i++));
        } else {
            all.push_back(changeOf('+', b, first + j++));
        }
    }
}

}  // namespace

std::vector<TextChange> textChanges(std::string_view before, std::string_view now) {
    constexpr std::size_t around = 2;
    const Lines a = linesOf(before), b = linesOf(now);
    const std::size_t shorter = std::min(a.size(), b.size());
    std::size_t first = 0, last = 0;  // lines that are the same at the start and at the end
    while (first < shorter && a[first] == b[first]) ++first;
    while (last < shorter - first && a[a.size() - 1 - last] == b[b.size() - 1 - last]) ++last;
    if (first == a.size() && first == b.size()) return {};

    std::vector<TextChange> all;
    for (std::size_t i = 0; i < first; ++i) all.push_back(changeOf(' ', b, i));
    compareMiddle(a, b, first, a.size() - last, b.size() - last, all);
    for (std::size_t i = b.size() - last; i < b.size(); ++i) all.push_back(changeOf(' ', b, i));

    std::vector<TextChange> shown;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::size_t low = i < around ? 0 : i - around, high = std::min(all.size() - 1, i + around);
        bool isNear = false;
        for (std::size_t k = low; k <= high; ++k) isNear = isNear || all[k].sign != ' ';
        if (isNear)
            shown.push_back(all[i]);
        else if (!shown.empty() && shown.back().sign != '~')
            shown.push_back({'~', 0, ""});
    }
    if (!shown.empty() && shown.back().sign == '~') shown.pop_back();
    return shown;
}

}  // namespace taut::report
