#include "taut/geometry/private/format_table.h"

#include <algorithm>

// A line a format, in the order in which helps name them: the function that returns its row.
#define TAUT_FORMATS(FORMAT) \
    FORMAT(usdaFormat)       \
    FORMAT(glbFormat)        \
    FORMAT(npzFormat)        \
    FORMAT(csvFormat)

namespace taut::geometry {

#define TAUT_DECLARE(format) Format format();
TAUT_FORMATS(TAUT_DECLARE)
#undef TAUT_DECLARE

Formats builtInFormats() {
    Formats all;
#define TAUT_ADD(format) all.add(format());
    TAUT_FORMATS(TAUT_ADD)
#undef TAUT_ADD
    return all;
}

std::vector<const Format*> formatsThat(const Formats& formats, Holds what) {
    std::vector<const Format*> found;
    for (const Format& format : formats.all())
        if (what == Holds::points ? format.makePoints != nullptr : format.makeSink != nullptr) found.push_back(&format);
    return found;
}

const Format* formatOf(const Formats& formats, Holds what, const std::filesystem::path& path) {
    for (const Format* format : formatsThat(formats, what))
        if (isIn(*format, path)) return format;
    return nullptr;
}

bool isIn(const Format& format, const std::filesystem::path& path) {
    return std::find(format.endings.begin(), format.endings.end(), path.extension().string()) != format.endings.end();
}

}  // namespace taut::geometry
