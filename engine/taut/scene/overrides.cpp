#include "taut/scene/private/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "taut/core/error.h"
#include "taut/scene/private/document.h"

namespace taut::scene {

namespace {

constexpr std::size_t maxParts = 16;

std::string withoutBlanks(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return "";
    return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

std::vector<std::string> partsOf(std::string_view key) {
    std::vector<std::string> parts;
    while (true) {
        const std::size_t dot = key.find('.');
        parts.emplace_back(key.substr(0, dot));
        if (dot == std::string_view::npos) return parts;
        key.remove_prefix(dot + 1);
    }
}

bool isWord(std::string_view text) {
    return !text.empty() && std::all_of(
                                text.begin(), text.end(),
                                [](char c) {
                                    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                                           std::string_view("0123456789-_./@#%*").find(c) != std::string_view::npos;
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

std::vector<std::string> keysOf(const Node& table) {
    std::vector<std::string> keys;
    for (const Member& member : table.members) keys.push_back(member.key);
    return keys;
}

// The element of a list that a part of a key names.
Node* itemOf(Node& list, const std::string& part, const std::string& path, Place place, Problems& problems) {
    const bool isIndex = !part.empty() && part.size() < 9 && part.find_first_not_of("0123456789") == std::string::npos;
    const std::size_t index = isIndex ? static_cast<std::size_t>(std::stoul(part)) : list.items.size();
    if (index < list.items.size()) return &list.items[index];
    const std::string remedy =
        list.items.empty() ? "the list is empty" : fmt::format("write {}.0 … {}.{}", path, path, list.items.size() - 1);
    problems.addError(place, fmt::format("{} has no element \"{}\"", path, part), remedy);
    return nullptr;
}

}  // namespace

std::string overrideLabel(const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::string key = withoutBlanks(std::string_view(text).substr(0, equals));
    if (equals == std::string::npos || key.empty() ||
        withoutBlanks(std::string_view(text).substr(equals + 1)).empty()) {
        throw core::Error(core::ErrorKind::usage,
                          fmt::format("--set {}: error: write KEY=VALUE, e.g. --set cloth.flag.cells=[72,48]", text));
    }
    return "--set " + key;
}

void applyOverride(const std::string& text, int origin, const std::vector<SceneSection>& sections, Node& root,
                   Problems& problems) {
    const Place place{origin, 1, 1};
    const std::size_t equals = text.find('=');
    const std::vector<std::string> parts = partsOf(withoutBlanks(std::string_view(text).substr(0, equals)));
    const std::optional<Node> value =
        valueOf(withoutBlanks(std::string_view(text).substr(equals + 1)), place, problems);
    if (!value) return;
    if (parts.size() > maxParts) return problems.addError(place, "this key has too many parts");

    const auto section = std::find_if(sections.begin(), sections.end(),
                                      [&](const Section& s) { return !s.name.empty() && s.name == parts.front(); });
    Node* node = &root;
    std::string path;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::string& part = parts[i];
        const bool isLast = i + 1 == parts.size();
        if (node->kind == NodeKind::list) {
            node = itemOf(*node, part, path, place, problems);
            if (node == nullptr) return;
            if (isLast) *node = *value;
        } else if (node->kind == NodeKind::table) {
            Member* member = node->find(part);
            if (member == nullptr && i == 0 && section != sections.end() && section->layout == Layout::list)
                return problems.addError(place, fmt::format("the scene has no [[{}]]", part));
            // A new body, collider, … cannot be made of one value: this is a slip.
            if (member == nullptr && i == 1 && section != sections.end() && section->layout == Layout::named) {
                const std::string remedy = suggestion(part, keysOf(*node));
                return problems.addError(place, fmt::format("there is no {} \"{}\"", section->name, part), remedy);
            }
            if (member == nullptr) {
                node->members.push_back({part, place, Node{}});
                member = &node->members.back();
                member->value.place = place;
            }
            node = &member->value;
            if (isLast) {
                member->place = place;
                *node = *value;
            }
        } else {
            return problems.addError(place, fmt::format("{} is {}: it has no \"{}\"", path, description(*node), part));
        }
        path += (path.empty() ? "" : ".") + part;
    }
}

}  // namespace taut::scene
