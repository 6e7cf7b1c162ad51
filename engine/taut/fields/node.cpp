#include "taut/fields/node.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

namespace taut::fields {

const Member* Node::find(std::string_view key) const {
    const auto found = std::find_if(members.begin(), members.end(), [&](const Member& m) { return m.key == key; });
    return found == members.end() ? nullptr : &*found;
}

std::string Node::textAt(std::string_view key) const {
    const Member* member = find(key);
    return member != nullptr && member->value.kind == NodeKind::text ? member->value.text : "";
}

Member* Node::find(std::string_view key) {
    return const_cast<Member*>(std::as_const(*this).find(key));
}

const Node* Node::at(std::string_view key) const {
    if (kind != NodeKind::list) {
        const Member* member = find(key);
        return member == nullptr ? nullptr : &member->value;
    }
    std::size_t i = items.size();
    std::from_chars(key.data(), key.data() + key.size(), i);
    return i < items.size() && key == std::to_string(i) ? &items[i] : nullptr;
}

Node* Node::at(std::string_view key) {
    return const_cast<Node*>(std::as_const(*this).at(key));
}

const Node* Node::along(const KeyPath& path) const {
    const Node* node = this;
    for (const std::string& key : path)
        if (node != nullptr) node = node->at(key);
    return node;
}

std::vector<std::string> Node::keys() const {
    std::vector<std::string> names;
    for (const Member& member : members) names.push_back(member.key);
    for (std::size_t i = 0; i < items.size(); ++i) names.push_back(std::to_string(i));
    return names;
}

KeyPath keyPath(std::string_view key) {
    KeyPath path;
    while (true) {
        const std::size_t dot = key.find('.');
        path.emplace_back(key.substr(0, dot));
        if (dot == std::string_view::npos) return path;
        key.remove_prefix(dot + 1);
    }
}

std::string description(const Node& node) {
    constexpr std::size_t maxLength = 40;
    switch (node.kind) {
        case NodeKind::flag: return node.flag ? "true" : "false";
        case NodeKind::whole: return fmt::format("{}", node.whole);
        case NodeKind::number: return fmt::format("{}", node.number);
        case NodeKind::text:
            if (node.text.size() > maxLength) return "a long text";
            return fmt::format("\"{}\"", node.text);
        case NodeKind::time: return "a date or time";
        case NodeKind::list: return fmt::format("a list of {}", node.items.size());
        case NodeKind::table: return "a table";
    }
    return "";
}

}  // namespace taut::fields
