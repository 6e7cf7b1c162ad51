#include "game/web_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <system_error>
#include <utility>

#include "game/folders.h"
#include "game/scene_file.h"
#include "game/usage.h"
#include "taut/core/error.h"
#include "taut/core/private/base64.h"
#include "taut/core/whole_file.h"
#include "taut/fields/private/problems.h"
#include "taut/report/test_page.h"
#include "taut/scene/private/used_files.h"
#include "taut/spec/common_rows.h"

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

std::filesystem::path viewerFolder() {
    return assetFolder() / "viewer";
}

// `page` of the viewer with its styles and scripts, before its contents are put in.
std::string pageWith(const char* page, std::initializer_list<const char*> styles,
                     std::initializer_list<const char*> ownScripts, const std::string& title, const std::string& scene,
                     const std::string& wish, const char* flag) {
    const std::filesystem::path library = viewerLibrary(wish), own = viewerFolder();
    if (library.empty())
        throw core::Error(core::ErrorKind::inputOutput,
                          fmt::format("{}: three.js, the viewer of pages, is missing; {}", flag, toInstall));
    std::string style, scriptElements;
    for (const char* file : styles) style += core::fileContent(own / file);
    for (const char* script : scripts) scriptElements += scriptElement(library / script);
    for (const char* name : shaders) scriptElements += shaderElement(shaderFolder() / name);
    for (const char* name : ownShaders) scriptElements += shaderElement(own / name);
    for (const char* script : ownScripts) scriptElements += scriptElement(own / script);
    std::string whole = core::fileContent(own / page);
    replace(whole, "@GENERATOR@", fmt::format("taut {}", TAUT_VERSION));
    replace(whole, "@STYLE@", style);
    replace(whole, "@SCRIPTS@", scriptElements);
    replace(whole, "@SCENE@", report::htmlText(scene));
    replace(whole, "@TITLE@", report::htmlText(title));
    return whole;
}

// Of the engine for pages.
constexpr std::array<const char*, 3> engineFiles = {"engine.mjs", "taut.mjs", "taut.wasm.gz"};

std::string base64Of(const std::filesystem::path& file) {
    const std::string content = core::fileContent(file);
    return core::base64(std::as_bytes(std::span(content)));
}

// Where a page keeps a file, so that its scene finds it by the name that it has for it.
class PageFolder {
  public:
    explicit PageFolder(const std::filesystem::path& scene)
        : folder_(std::filesystem::weakly_canonical(scene).parent_path()),
          assets_(std::filesystem::weakly_canonical(assetFolder())) {}

    // Empty: the engine has it itself.
    std::string nameOf(const std::filesystem::path& file) const {
        const std::filesystem::path real = std::filesystem::weakly_canonical(file);
        const std::string ofAssets = real.lexically_relative(assets_).generic_string();
        if (ofAssets.starts_with("fabrics/")) return "";
        return ofAssets.starts_with("..") ? real.lexically_relative(folder_).generic_string() : ofAssets;
    }

  private:
    std::filesystem::path folder_, assets_;
};

// The scene with all files that it names. One outside of its folder, by "../", makes room for that above the scene.
nlohmann::json sceneJson(const std::filesystem::path& file, const world::SceneSpec& spec,
                         const std::vector<std::string>& overrides) {
    const PageFolder folder(file);
    std::vector<std::pair<std::string, std::string>> files;
    std::string above;  // "in/in/"
    for (const scene::UsedFile& used : scene::usedFiles(spec)) {
        if (std::filesystem::equivalent(used.path, file)) continue;
        const std::string name = folder.nameOf(used.path);
        if (name.empty()) continue;
        std::string needed;
        for (std::size_t at = 0; name.compare(at, 3, "../") == 0; at += 3) needed += "in/";
        if (needed.size() > above.size()) above = needed;
        files.emplace_back(name, base64Of(used.path));
    }
    nlohmann::json contents = nlohmann::json::object();
    for (const auto& [name, content] : files)
        contents[std::filesystem::path(above + name).lexically_normal().generic_string()] = content;
    return {{"name", above + file.filename().string()},
            {"reference", referenceTo(file, file.parent_path())},
            {"text", core::fileContent(file)},
            {"files", contents},
            {"overrides", overrides}};
}

[[noreturn]] void failSlider(const std::string& key, const std::vector<scene::Rampable>& rampable) {
    std::vector<std::string> keys;
    for (const scene::Rampable& other : rampable) keys.push_back(other.key);
    const std::string meant = fields::suggestion(key, keys);
    failUsage("--sliders: ramps do not change {}; {}", key,
              meant.empty() ? "taut schema --manual lists their keys, under \"Ramps\"" : meant);
}

}  // namespace

std::filesystem::path viewerLibrary(const std::string& wish) {
    const char* variable = std::getenv("TAUT_THREE");
    const std::string named = !wish.empty() ? wish : variable != nullptr ? variable : "";
    if (!named.empty()) {
        const std::string lack = lackOf(named);
        if (lack.empty()) return named;
        throw core::Error(core::ErrorKind::inputOutput,
                          fmt::format("{}: there is no {} in it, which three.js has up to release 147; Debian's "
                                      "package libjs-three has it in /usr/share/javascript/three",
                                      named, lack));
    }
    for (const char* folder : {"/usr/share/javascript/three", "/usr/local/share/javascript/three"})
        if (lackOf(folder).empty()) return folder;
    return {};
}

geometry::WebPage webPage(const std::string& title, const std::string& scene, const std::string& wish) {
    const std::string mark = "@MODEL@";
    std::string before =
        pageWith("page.html", {"page.css"}, {"film.js", "look.js", "page.js"}, title, scene, wish, "--web");
    const std::size_t at = before.find(mark);
    if (at == std::string::npos)
        throw core::Error(core::ErrorKind::badContent,
                          (viewerFolder() / "page.html").string() + ": there is no " + mark);
    std::string after = before.substr(at + mark.size());
    before.resize(at);
    return {std::move(before), std::move(after)};
}

std::filesystem::path webEngine(const std::string& wish) {
    const char* variable = std::getenv("TAUT_WEB");
    const std::string named = !wish.empty() ? wish : variable != nullptr ? variable : "";
    const std::filesystem::path folder = named.empty() ? webFolder() : std::filesystem::path(named);
    for (const char* file : engineFiles)
        if (!std::filesystem::is_regular_file(folder / file))
            throw core::Error(
                core::ErrorKind::inputOutput,
                named.empty()
                    ? "--live: the engine for pages is missing; sh game/web.sh builds it, and --engine names its folder"
                    : fmt::format("{}: there is no {} in it; sh game/web.sh writes it", named, file));
    return folder;
}

std::string livePage(const std::filesystem::path& file, const scene::Loaded& scene, const LivePageWish& wish) {
    const std::vector<scene::Rampable> rampable = scene.actions->rampable(scene.spec);
    for (const std::string& key : wish.sliders) {
        const auto own = std::ranges::find_if(rampable, [&](const auto& other) { return other.key == key; });
        if (own == rampable.end()) failSlider(key, rampable);
        if (own->value.size() > 1 && std::ranges::all_of(own->value, [](double x) { return x == 0; }))
            failUsage("--sliders: {} has no direction for a slider; give it a length in the scene", key);
    }
    const std::filesystem::path engine = webEngine(wish.engine);
    nlohmann::json live{{"methods", world::methodNames()}, {"edits", wish.edits}};
    live["sliders"] = wish.sliders.empty() ? nlohmann::json() : nlohmann::json(wish.sliders);
    for (const char* module : {"engine.mjs", "taut.mjs"}) live["modules"][module] = core::fileContent(engine / module);
    live["scene"] = sceneJson(file, scene.spec, wish.overrides);
    std::string text = live.dump();
    replace(text, "<", "\\u003c");  // nothing of a scene ends its element

    const std::string name = file.stem().string(), title = scene.spec.title;
    std::string page =
        pageWith("live.html", {"page.css", "live.css"}, {"look.js", "live_film.js", "live_panel.js", "live.js"},
                 title.empty() ? name : title, title.empty() ? "" : name, wish.viewer, "--live");
    replace(page, "@ENGINE@", base64Of(engine / "taut.wasm.gz"));
    replace(page, "@LIVE@", text);
    return page;
}

geometry::Format pageFormat(std::shared_ptr<const geometry::WebPage> page) {
    geometry::Format format{.name = "page", .endings = {".html", ".htm"}};
    format.makeSink = [page = std::move(page)](const std::filesystem::path& path,
                                               const geometry::GeometryOptions& options) {
        return std::make_unique<geometry::WebPageWriter>(path, *page, options);
    };
    format.needsNormals = "a page needs its normals";
    return format;
}

}  // namespace taut::game
