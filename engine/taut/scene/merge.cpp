#include "taut/scene/private/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "taut/core/error.h"
#include "taut/scene/private/sections.h"
#include "taut/scene/private/text_file.h"

namespace taut::scene {

namespace {

using std::filesystem::path;

bool isSame(const path& a, const path& b) {
    std::error_code ignored;
    return std::filesystem::equivalent(a, b, ignored);
}

bool isAmong(const path& file, const std::vector<path>& files) {
    return std::any_of(
        files.begin(), files.end(), [&](const path& other) { return isSame(file, other); });
}

// "a.toml -> b.toml -> c.toml": each builds on the next.
std::string text(const std::vector<path>& chain, const path& last) {
    std::string all;
    for (const path& file : chain) all += file.string() + " -> ";
    return all + last.string();
}

bool isFile(const path& file) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(file, ignored);
}

// The names of scene files in a folder, sorted, for suggestions.
void addScenesIn(const path& folder, const path& but, std::vector<std::string>& names) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
        if (entry.path().extension() == ".toml" && !isSame(entry.path(), but))
            names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
}

}  // namespace

BaseName nameOfBase(std::string_view value) {
    constexpr std::string_view shipped = "shipped:";
    if (!value.starts_with(shipped)) return {std::string(value), false};
    return {std::string(value.substr(shipped.size())), true};
}

Node merged(Node base, const Node& over) {
    if (base.kind != NodeKind::table || over.kind != NodeKind::table) return over;
    for (const Member& member : over.members) {
        Member* below = base.find(member.key);
        if (below == nullptr) {
            base.members.push_back(member);
        } else {
            const bool isTable = below->value.kind == NodeKind::table && member.value.kind == NodeKind::table;
            below->value = merged(std::move(below->value), member.value);
            if (!isTable) below->place = member.place;
        }
    }
    return base;
}

BaseFile baseFileOf(const Node& root, const std::vector<path>& chain, const std::vector<path>& assetFolders,
                    const Confinement& confinement, std::uint64_t maxBytes, Problems& problems) {
    const Member* member = root.find("scene");
    if (member == nullptr) return {};
    const Node& value = member->value;
    const path& sceneFile = chain.back();
    if (value.kind != NodeKind::text) {  // in the first file the reader reports a wrong type
        if (chain.size() > 1)
            problems.addError(value.place, fmt::format("scene must be a text, not {}", description(value)));
        return {};
    }
    const bool isControlFree =
        std::all_of(value.text.begin(), value.text.end(), [](unsigned char c) { return c >= 0x20 && c != 0x7F; });
    if (value.text.empty() || !isControlFree) {
        problems.addError(value.place, "scene must be the name of a scene or of a file");
        return {};
    }
    const auto [name, isShipped] = nameOfBase(value.text);
    std::vector<path> folders;
    if (!isShipped) folders.push_back(sceneFile.parent_path());
    for (const path& folder : assetFolders) {
        folders.push_back(folder / "scenes");
        if (name.find('/') != std::string::npos && isShipped) folders.push_back(folder);
    }

    const std::string fileName = name.ends_with(".toml") ? name : name + ".toml";
    bool namesItself = false;
    std::vector<std::string> searched, known;
    for (const path& folder : folders) {
        const path file = folder / fileName;
        searched.push_back(file.string());
        if (isFile(file) && isSame(file, sceneFile)) {
            namesItself = true;
        } else if (isFile(file) && isAmong(file, chain)) {
            problems.addError(value.place, fmt::format("these scenes build on each other: {}", text(chain, file)));
            return {};
        } else if (isFile(file) && chain.size() > mostBases) {
            problems.addError(value.place, fmt::format("a scene builds on {} others at most, one upon another: {}",
                                                       mostBases, text(chain, file)));
            return {};
        } else if (isFile(file) && !confinement.allows(file)) {
            problems.addError(value.place, outsideMessage(file));
            return {};
        } else if (isFile(file)) {
            try {
                return {file, textFile(file, maxBytes)};
            } catch (const core::Error& error) {
                problems.addError(value.place, fmt::format("cannot read this scene: {}", error.what()));
                return {};
            }
        }
        addScenesIn(folder, sceneFile, known);
    }
    if (namesItself) {
        problems.addError(value.place, "this scene names itself");
        return {};
    }
    std::string remedy = suggestion(fileName.substr(0, fileName.size() - 5), known);
    if (remedy.empty()) remedy = fmt::format("looked for {}", joined(searched));
    problems.addError(value.place, fmt::format("there is no scene \"{}\"", value.text), remedy);
    return {};
}

}  // namespace taut::scene
