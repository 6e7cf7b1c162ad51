#include "game/web_page.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "game/folders.h"
#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/report/test_page.h"

namespace taut::game {
namespace {

// As plain scripts, which three.js has up to its release 147; modules cannot stand in a page that is opened from a
// file.
constexpr std::array<const char*, 3> scripts = {"build/three.min.js", "examples/js/controls/OrbitControls.js",
                                                "examples/js/loaders/GLTFLoader.js"};
constexpr const char* toInstall = "install Debian's package libjs-three, or name a folder of three.js with --viewer";

// The first of its scripts that a folder lacks; empty: it has all.
std::string lackOf(const std::filesystem::path& folder) {
    std::error_code ignored;
    for (const char* script : scripts)
        if (!std::filesystem::is_regular_file(folder / script, ignored)) return script;
    return "";
}

void replace(std::string& text, const std::string& mark, const std::string& content) {
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + content.size()))
        text.replace(at, mark.size(), content);
}

// Of taut's own pictures; of the page alone.
constexpr std::array<const char*, 14> shaders = {
    "background.frag", "background.vert", "environment.glsl", "frame.glsl",   "ground.frag",
    "ground.vert",     "lamps.glsl",      "lit.glsl",         "pattern.glsl", "screen.vert",
    "shadow.glsl",     "surface.vert",    "tone.glsl",        "weave.glsl"};
constexpr std::array<const char*, 3> ownShaders = {"depth.vert", "forward.frag", "hidden.frag"};

// Which look.js finds by its name.
std::string shaderElement(const std::filesystem::path& file) {
    return fmt::format("<script type=\"text/plain\" id=\"{}\">\n{}</script>\n", file.filename().string(),
                       core::fileContent(file));
}

// "</script" within a string of it would end the element.
std::string scriptElement(const std::filesystem::path& file) {
    std::string content = core::fileContent(file);
    replace(content, "</script", "<\\/script");
    return fmt::format("<script>\n{}</script>\n", content);
}

}  // namespace

std::filesystem::path viewerLibrary(const std::string& wish) {
    const char* variable = std::getenv("TAUT_THREE");
    const std::string named = !wish.empty() ? wish : variable != nullptr ? variable : "";
    if (!named.empty()) {
        const std::string lack = lackOf(named);
        if (lack.empty()) return named;
        throw core::Error(
            core::ErrorKind::inputOutput,
            fmt::format("{}: there is no {} in it, as three.js has it up to release 147; Debian's package "
                        "libjs-three has it in /usr/share/javascript/three",
                        named, lack));
    }
    for (const char* folder : {"/usr/share/javascript/three", "/usr/local/share/javascript/three"})
        if (lackOf(folder).empty()) return folder;
    return {};
}

geometry::WebPage webPage(const std::string& title, const std::string& scene, const std::string& wish) {
    const std::filesystem::path library = viewerLibrary(wish);
    if (library.empty())
        throw core::Error(core::ErrorKind::inputOutput,
                          fmt::format("--web: three.js, which draws in the page, is not there; {}", toInstall));
    const std::filesystem::path own = assetFolder() / "viewer";
    const std::string whole = core::fileContent(own / "page.html"), mark = "@MODEL@";
    const std::size_t at = whole.find(mark);
    if (at == std::string::npos)
        throw core::Error(core::ErrorKind::badContent, (own / "page.html").string() + ": there is no " + mark);
    std::string scriptElements;
    for (const char* script : scripts) scriptElements += scriptElement(library / script);
    for (const char* name : shaders) scriptElements += shaderElement(shaderFolder() / name);
    for (const char* name : ownShaders) scriptElements += shaderElement(own / name);
    for (const char* script : {"film.js", "look.js", "page.js"}) scriptElements += scriptElement(own / script);
    std::string before = whole.substr(0, at);
    replace(before, "@GENERATOR@", fmt::format("taut {}", TAUT_VERSION));
    replace(before, "@STYLE@", core::fileContent(own / "page.css"));
    replace(before, "@SCRIPTS@", scriptElements);
    replace(before, "@SCENE@", report::htmlText(scene));
    replace(before, "@TITLE@", report::htmlText(title));
    return {std::move(before), whole.substr(at + mark.size())};
}

geometry::Format pageFormat(std::shared_ptr<const geometry::WebPage> page) {
    geometry::Format format{.name = "page", .endings = {".html", ".htm"}};
    format.makeSink = [page = std::move(page)](const std::filesystem::path& path,
                                               const geometry::GeometryOptions& options) {
        return std::make_unique<geometry::WebPageWriter>(path, *page, options);
    };
    format.needsNormals = "a page is shaded by its normals";
    return format;
}

}  // namespace taut::game
