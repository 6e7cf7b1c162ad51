#include "taut/geometry/web_page_writer.h"

#include <fmt/format.h>

#include <utility>

#include "taut/core/error.h"
#include "taut/core/private/base64.h"
#include "taut/core/whole_file.h"

namespace taut::geometry {
namespace {

GeometryOptions compact(GeometryOptions options) {
    options.isCompact = true;
    return options;
}

}  // namespace

WebPageWriter::WebPageWriter(std::filesystem::path path, WebPage page, GeometryOptions options)
    : path_(std::move(path)), page_(std::move(page)), glb_(path_, compact(std::move(options))) {}

void WebPageWriter::finish() {
    core::WholeFile file(path_);
    file.write(page_.before);
    core::Base64 writer;
    std::string text;
    std::uint64_t size = 0;
    glb_.finish([&](std::span<const std::byte> bytes) {
        size += bytes.size();
        if (size > mostBytes)
            throw core::Error(
                core::ErrorKind::badContent,
                fmt::format("{}: more than {} MB of geometry, the most that browsers take in a page: leave frames out "
                            "with --every, take some of them with --frames or some bodies with --only",
                            path_.string(), mostBytes / 1000000));
        text.clear();
        writer.append(text, bytes);
        file.write(text);
    });
    text.clear();
    writer.finish(text);
    file.write(text);
    file.write(page_.after);
    file.commit();
}

}  // namespace taut::geometry
