#include "taut/geometry/web_page_writer.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "taut/core/error.h"
#include "taut/core/private/base64.h"
#include "taut/core/whole_file.h"

namespace taut::geometry {
namespace {

GeometryOptions compact(GeometryOptions options) {
    options.isCompact = true;
    return options;
}

// As a gzip file.
std::vector<std::byte> packed(std::span<const std::byte> bytes) {
    constexpr int level = 9;  // of 12
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
        libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
    std::vector<std::byte> out(libdeflate_gzip_compress_bound(compressor.get(), bytes.size()));
    out.resize(libdeflate_gzip_compress(compressor.get(), bytes.data(), bytes.size(), out.data(), out.size()));
    TAUT_EXPECTS(!out.empty());
    return out;
}

}  // namespace

WebPageWriter::WebPageWriter(std::filesystem::path path, WebPage page, GeometryOptions options)
    : path_(std::move(path)), page_(std::move(page)), glb_(path_, compact(std::move(options))) {}

void WebPageWriter::finish() {
    std::vector<std::byte> film;
    glb_.finish([&](std::span<const std::byte> bytes) {
        if (film.size() + bytes.size() > mostBytes)
            throw core::Error(
                core::ErrorKind::badContent,
                fmt::format("{}: more than {} MB of geometry, the most that browsers take in a page: leave frames out "
                            "with --every, take some of them with --frames or some bodies with --only",
                            path_.string(), mostBytes / 1000000));
        film.insert(film.end(), bytes.begin(), bytes.end());
    });
    core::WholeFile file(path_);
    file.write(page_.before);
    file.write(core::base64(packed(film)));
    file.write(page_.after);
    file.commit();
}

}  // namespace taut::geometry
