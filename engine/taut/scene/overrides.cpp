#include "taut/scene/private/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "taut/core/error.h"
#include "taut/core/glob.h"
#include "taut/scene/private/document.h"
#include "taut/scene/private/inheritance.h"

namespace taut::scene {

namespace {

constexpr std::size_t maxParts = 16;

std::string withoutBlanks(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return "";
    return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

bool isWord(std::string_view text) {
    return !text.empty() && std::all_of(
                                text.begin(), text.end(),
                                [](char c) {
                                    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                                           std::string_view("0123456789-_./:@#%*").find(c) != std::string_view::npos;
                                });
}

std::optional<Node> valueOf(const std::string& text, Place place, Problems& problems) {
    try {
        Node tree = documentTree("value = " + text, place.origin);
        if (tree.members.size() == 1) return tree.members.front().value;
        problems.addError(place, "the value must be one value");
    } catch (const SyntaxError& error) {
        if (isWord(text)) {
            Node node;
            node.kind = NodeKind::text;
            node.place = place;
            node.text = text;
            return node;
        }
        problems.addError(place, fmt::format("{} is not a value: {}", text, error.what()));
    }
    return std::nullopt;
}

// Puts one value at the place of a key.
class Override {
  public:
    Override(std::vector<std::string> parts, const Node& value, Place place, const std::vector<SceneSection>& sections,
             Node& root, Problems& problems)
        : parts_(std::move(parts)),
          value_(value),
          place_(place),
          sections_(sections),
          root_(root),
          problems_(problems) {
        const auto section = std::find_if(sections.begin(), sections.end(), [&](const Section& s) {
            return !s.name.empty() && s.name == parts_.front();
        });
        if (section != sections.end()) section_ = &*section;
    }

    void apply() { setIn(root_, 0, ""); }

  private:
    // Goes on below a node at `path`, which the first `depth` parts of the key lead to.
    void setIn(Node& node, std::size_t depth, const std::string& path) {
        if (depth == parts_.size())
            node = value_;
        else if (node.kind == NodeKind::list)
            setInList(node, depth, path);
        else if (node.kind == NodeKind::table)
            setInTable(node, depth, path);
        else
            report(fmt::format("{} is {}: it has no \"{}\"", path, description(node), parts_[depth]));
    }

    void setInList(Node& list, std::size_t depth, const std::string& path) {
        const std::string& part = parts_[depth];
        bool isThere = false;
        for (const std::string& number : list.keys()) {
            if (!core::matches(part, number)) continue;
            isThere = true;
            setIn(*list.at(number), depth + 1, path + "." + number);
        }
        if (isThere) return;
        report(fmt::format("{} has no element \"{}\"", path, part),
               list.items.empty() ? "the list is empty"
                                  : fmt::format("write {}.0 … {}.{}", path, path, list.items.size() - 1));
    }

    void setInTable(Node& table, std::size_t depth, const std::string& path) {
        const std::string& part = parts_[depth];
        const bool isNameOfElement = depth == 1 && section_ != nullptr && section_->layout == Layout::named;
        bool isThere = false;
        for (Member& member : table.members) {
            if (isNameOfElement ? !core::matches(part, member.key) : part != member.key) continue;
            isThere = true;
            setMember(member, depth, path);
        }
        if (isThere) return;
        if (depth == 0 && section_ != nullptr && section_->layout == Layout::list)
            return report(fmt::format("the scene has no [[{}]]", part));
        // One value cannot make a new body, collider, …, so this is a slip.
        if (isNameOfElement)
            return report(fmt::format("there is no {} \"{}\"", section_->name, part), suggestion(part, table.keys()));
        Member fresh{part, place_, Node{}};
        fresh.value.place = place_;
        if (depth == 2 && depth + 1 < parts_.size()) takeList(path, fresh);
        table.members.push_back(std::move(fresh));
        setMember(table.members.back(), depth, path);
    }

    void setMember(Member& member, std::size_t depth, const std::string& path) {
        if (depth + 1 == parts_.size()) member.place = place_;
        setIn(member.value, depth + 1, path + (path.empty() ? "" : ".") + member.key);
    }

    // Copies a list that an element inherits, so that one element of it can be set.
    void takeList(const std::string& path, Member& fresh) const {
        if (section_ == nullptr || section_->layout != Layout::named) return;
        Node whole = root_;
        Problems unheard("", "", {});
        inherit(sections_, whole, unheard);
        const Node* taken = whole.along({section_->name, path.substr(section_->name.size() + 1), fresh.key});
        if (taken != nullptr && taken->kind == NodeKind::list) fresh.value = *taken;
    }

    void report(const std::string& message, const std::string& remedy = "") {
        problems_.addError(place_, message, remedy);
    }

    const std::vector<std::string> parts_;
    const Node& value_;
    const Place place_;
    const std::vector<SceneSection>& sections_;
    Node& root_;
    Problems& problems_;
    const SceneSection* section_ = nullptr;  // null: the key is in no section
};

}  // namespace

std::string overrideLabel(const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::string key = withoutBlanks(std::string_view(text).substr(0, equals));
    if (equals == std::string::npos || key.empty() ||
        withoutBlanks(std::string_view(text).substr(equals + 1)).empty()) {
        throw core::Error(core::ErrorKind::usage,
                          core::at({"--set " + text}) + "write KEY=VALUE, e.g. --set cloth.flag.cells=[72,48]");
    }
    const std::size_t flag = text.rfind(" # --");
    return flag != std::string::npos ? text.substr(flag + 3) : "--set " + key;
}

void applyOverride(const std::string& text, int origin, const std::vector<SceneSection>& sections, Node& root,
                   Problems& problems) {
    const Place place{origin, 1, 1};
    const std::size_t equals = text.find('=');
    const std::vector<std::string> parts = fields::keyPath(withoutBlanks(std::string_view(text).substr(0, equals)));
    const std::optional<Node> value =
        valueOf(withoutBlanks(std::string_view(text).substr(equals + 1)), place, problems);
    if (!value) return;
    if (parts.size() > maxParts) return problems.addError(place, "this key has too many parts");

    Override(parts, *value, place, sections, root, problems).apply();
}

}  // namespace taut::scene
