#include "taut/scene/fabrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "taut/core/error.h"
#include "taut/scene/private/fabrics.h"
#include "taut/scene/private/text_file.h"

namespace taut::scene {

namespace {

using fields::Problems;
using std::filesystem::path;

constexpr std::uint64_t mostBytes = 1U << 20U;  // of a fabric's file

// Calls visit(name, place) for each fabric that a table of named elements has under `key`.
template <class Visit>
void eachFabricIn(const Member* elements, std::string_view key, const Visit& visit) {
    if (elements == nullptr || elements->value.kind != NodeKind::table) return;
    for (const Member& element : elements->value.members) {
        if (element.value.kind != NodeKind::table) continue;
        const Member* name = element.value.find(std::string(key));
        if (name != nullptr && name->value.kind == NodeKind::text && isFabric(name->value.text))
            visit(name->value.text, name->value.place);
    }
}

template <class Visit>
void eachFabric(const Node& root, const Visit& visit) {
    for (const Member& section : root.members)
        if (section.key != "material") eachFabricIn(&section, "material", visit);  // of bodies, and [defaults.cloth]
    eachFabricIn(root.find("material"), "like", visit);
}

Node& materialsOf(Node& root) {
    for (Member& member : root.members)
        if (member.key == "material") return member.value;
    Member materials{"material", {0, 1, 1}, Node{}};
    materials.value.place = materials.place;
    root.members.push_back(std::move(materials));
    return root.members.back().value;
}

class Library {
  public:
    Library(const std::vector<path>& assetFolders, Problems& problems)
        : files_(fabricFiles(assetFolders)), problems_(problems) {}

    // The fabric's table, with no members where there is a fault.
    Member fabric(const std::string& name, Place place) {
        const std::string stem = name.substr(std::string_view(fabricPrefix).size());
        Member member{name, place, Node{}};
        member.value.place = place;
        const auto file =
            std::find_if(files_.begin(), files_.end(), [&](const path& p) { return p.stem().string() == stem; });
        if (file == files_.end()) {
            std::vector<std::string> known;
            for (const path& p : files_) known.push_back(p.stem().string());
            const std::string meant = fields::suggestion(stem, known);
            problems_.addError(place, fmt::format("there is no fabric \"{}\"", stem),
                               meant.empty() ? "taut materials lists them" : meant);
            return member;
        }
        try {
            const std::string text = textFile(*file, mostBytes);
            const Node tree = treeOf(text, problems_.addBase(text, file->string()), problems_);
            const Node* found = tree.along({"material", stem});
            if (found == nullptr)
                problems_.addError(place, fmt::format("{} has no [material.{}]", file->string(), stem));
            else
                member.value = *found;
            used_.push_back(file->string());
        } catch (const core::Error& error) {
            if (problems_.errorCount() > 0) throw;  // not TOML
            problems_.addError(place, fmt::format("cannot read this fabric: {}", error.what()));
        }
        return member;
    }

    std::vector<std::string> takeUsed() { return std::move(used_); }

  private:
    std::vector<path> files_;
    std::vector<std::string> used_;
    Problems& problems_;
};

}  // namespace

bool isFabric(std::string_view name) {
    return name.starts_with(fabricPrefix);
}

std::vector<path> fabricFiles(const std::vector<path>& assetFolders) {
    std::vector<path> files;
    for (const path& folder : assetFolders) {
        std::error_code ignored;
        const auto earlier = static_cast<std::ptrdiff_t>(files.size());
        for (const auto& entry : std::filesystem::directory_iterator(folder / "fabrics", ignored))
            if (entry.path().extension() == ".toml" &&
                std::none_of(files.begin(), files.begin() + earlier,
                             [&](const path& file) { return file.stem() == entry.path().stem(); }))
                files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end(), [](const path& a, const path& b) { return a.stem() < b.stem(); });
    return files;
}

std::vector<std::string> addFabrics(const std::vector<path>& assetFolders, Node& root, Problems& problems) {
    Library library(assetFolders, problems);
    while (true) {  // a fabric may be like another
        std::vector<Member> added;
        eachFabric(root, [&](const std::string& name, Place place) {
            const bool isThere =
                root.along({"material", name}) != nullptr ||
                std::any_of(added.begin(), added.end(), [&](const Member& m) { return m.key == name; });
            if (!isThere) added.push_back(library.fabric(name, place));
        });
        if (added.empty()) return library.takeUsed();
        Node& into = materialsOf(root);
        for (Member& member : added) into.members.push_back(std::move(member));
    }
}

}  // namespace taut::scene
