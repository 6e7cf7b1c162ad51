// The page that `export --web` writes, without its geometry: the viewer of assets/viewer, the shaders of taut's own
// pictures and the installed scripts of three.js, in one text that needs nothing else. It knows no scene.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "taut/geometry/private/format_table.h"
#include "taut/geometry/web_page_writer.h"

namespace taut::game {

// The folder of three.js: `wish`, else $TAUT_THREE, else where Debian installs it. Empty if there is none. A wish
// without three.js throws core::Error(inputOutput).
std::filesystem::path viewerLibrary(const std::string& wish = "");

// `title` heads the page, with `scene` below. Throws core::Error(inputOutput), with what to install, if there is no
// library.
geometry::WebPage webPage(const std::string& title, const std::string& scene, const std::string& wish);

// The row of web pages, which need no other file; --web asks for them. `page` is written around the film.
geometry::Format pageFormat(std::shared_ptr<const geometry::WebPage> page);

}  // namespace taut::game
