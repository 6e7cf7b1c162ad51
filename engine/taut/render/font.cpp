#include "taut/render/private/font.h"

#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "taut/core/error.h"

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <stb/stb_truetype.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace taut::render {

namespace {

// Where fonts-dejavu-core has put its files in the releases of Debian.
constexpr const char* places[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/ttf-dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu/DejaVuSans.ttf",
};

std::vector<unsigned char> bytesOf(const std::filesystem::path& file) {
    if (file.empty()) {
        throw core::Error(core::ErrorKind::inputOutput,
                          std::string("no font for the labels: ") + places[0] +
                              " is missing; install the package fonts-dejavu-core, or name a font file with TAUT_FONT");
    }
    std::error_code ignored;
    std::ifstream stream(file, std::ios::binary);
    if (!stream || !std::filesystem::is_regular_file(file, ignored)) {
        throw core::Error(core::ErrorKind::inputOutput, "the font " + file.string() +
                                                            " cannot be read; name another with TAUT_FONT, or install "
                                                            "the package fonts-dejavu-core and name none");
    }
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

std::filesystem::path defaultFont() {
    std::error_code ignored;
    for (const char* place : places)
        if (std::filesystem::is_regular_file(place, ignored)) return place;
    return {};
}

struct Font::Impl {
    std::vector<unsigned char> bytes;
    stbtt_fontinfo info{};

    float scale(float pixels) const { return stbtt_ScaleForMappingEmToPixels(&info, pixels); }
};

Font::Font(const std::filesystem::path& file) : impl_(std::make_unique<Impl>()) {
    const std::filesystem::path path = file.empty() ? defaultFont() : file;
    impl_->bytes = bytesOf(path);
    constexpr std::size_t header = 12;  // [bytes] of the table directory, without which there is nothing to look at
    const int start = impl_->bytes.size() < header ? -1 : stbtt_GetFontOffsetForIndex(impl_->bytes.data(), 0);
    if (start < 0 || stbtt_InitFont(&impl_->info, impl_->bytes.data(), start) == 0)
        throw core::Error(core::ErrorKind::badContent, path.string() + " is no TrueType font");
}

Font::~Font() = default;
Font::Font(Font&&) noexcept = default;

int Font::glyphOf(char32_t character) const {
    return stbtt_FindGlyphIndex(&impl_->info, static_cast<int>(character));
}

Glyph Font::drawn(int glyph, float pixels, float shift) const {
    const float scale = impl_->scale(pixels);
    int right = 0, bottom = 0;
    Glyph result;
    stbtt_GetGlyphBitmapBoxSubpixel(&impl_->info, glyph, scale, scale, shift, 0.0F, &result.left, &result.top, &right,
                                    &bottom);
    result.width = right - result.left;
    result.height = bottom - result.top;
    result.coverage.resize(static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height));
    if (result.coverage.empty()) return result;
    stbtt_MakeGlyphBitmapSubpixel(&impl_->info, result.coverage.data(), result.width, result.height, result.width,
                                  scale, scale, shift, 0.0F, glyph);
    return result;
}

float Font::advance(int glyph, int next, float pixels) const {
    int units = 0, bearing = 0;
    stbtt_GetGlyphHMetrics(&impl_->info, glyph, &units, &bearing);
    if (next >= 0) units += stbtt_GetGlyphKernAdvance(&impl_->info, glyph, next);
    return static_cast<float>(units) * impl_->scale(pixels);
}

}  // namespace taut::render
