// Pages that need nothing else: the viewer of assets/viewer, the shaders of taut's own pictures, the installed scripts
// of three.js, and a film (`export --web`) or a scene with the engine that plays it (`export --live`).
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "taut/geometry/private/format_table.h"
#include "taut/geometry/web_page_writer.h"
#include "taut/scene/load.h"

namespace taut::game {

// The folder of three.js: `wish`, else $TAUT_THREE, else where Debian installs it. Empty if there is none. A wish
// without three.js throws core::Error(inputOutput).
std::filesystem::path viewerLibrary(const std::string& wish = "");

// `title` heads the page, with `scene` below. Throws core::Error(inputOutput), with the package to install, if there is
// no library.
geometry::WebPage webPage(const std::string& title, const std::string& scene, const std::string& wish);

// The engine for pages, as game/web.sh builds it: `wish`, else $TAUT_WEB, else its installation or build. Throws
// core::Error(inputOutput), with a remedy, if there is none.
std::filesystem::path webEngine(const std::string& wish = "");

struct LivePageWish {
    std::string viewer, engine;          // folders; empty: wherever they are
    std::vector<std::string> overrides;  // "key=value"
    std::vector<std::string> sliders;    // keys that ramps may change; empty: common keys
    bool edits = false;                  // the scene's text is open beside the picture
};

// The page in which people play with the scene. Throws core::Error(inputOutput) for missing or unreadable files,
// core::Error(usage) for a slider of a key that ramps cannot change.
std::string livePage(const std::filesystem::path& file, const scene::Loaded& scene, const LivePageWish& wish);

// The row of web pages, which need no other file; --web asks for them. `page` is written around the film.
geometry::Format pageFormat(std::shared_ptr<const geometry::WebPage> page);

}  // namespace taut::game
