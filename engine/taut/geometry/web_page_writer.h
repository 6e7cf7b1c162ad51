// A film as one page for browsers: its GLB, packed, as text, between two halves of a given page. Independent of the
// behaviour of the page.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "taut/geometry/glb_writer.h"

namespace taut::geometry {

struct WebPage {
    std::string before, after;  // the gzip file of the GLB in base64 stands between them
};

class WebPageWriter : public GeometrySink {
  public:
    // Throws core::Error(inputOutput).
    WebPageWriter(std::filesystem::path path, WebPage page, GeometryOptions options);

    void write(const view::FrameView& view) override { glb_.write(view); }
    // Throws core::Error(badContent), too: more than mostBytes.
    void finish() override;

    // The packed text is always shorter than 512 MiB, the longest string that Chromium makes of a part of a page.
    static constexpr std::uint64_t mostBytes = std::uint64_t{384} << 20U;  // [bytes] of the GLB

  private:
    std::filesystem::path path_;
    WebPage page_;
    GlbWriter glb_;
};

}  // namespace taut::geometry
