// The page that `export --web` writes, but for its geometry: our viewer of assets/viewer and the scripts of three.js
// that are installed, in one text that needs nothing besides. It knows no scene.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "taut/geometry/private/format_table.h"
#include "taut/geometry/web_page_writer.h"

namespace taut::game {

// Where three.js is: the folder that was wished for, else $TAUT_THREE, else where Debian installs it. Empty when there
// is none; a wish that holds none throws core::Error(inputOutput).
std::filesystem::path viewerLibrary(const std::string& wish = "");

// `title` heads the page, with `scene` below. Throws core::Error(inputOutput), with what to install, when there is no
// library.
geometry::WebPage webPage(const std::string& title, const std::string& scene, const std::string& wish);

// The row of pages, which stand for themselves: --web asks for them. `page` is written around the film.
geometry::Format pageFormat(std::shared_ptr<const geometry::WebPage> page);

}  // namespace taut::game
