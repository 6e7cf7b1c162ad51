#include "taut/scene/private/splice.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "taut/core/error.h"
#include "taut/scene/private/document.h"

namespace taut::scene {

namespace {

using fields::KeyPath;

[[noreturn]] void fail(const Change& change, const std::string& why) {
    throw core::Error(core::ErrorKind::badContent,
                      fmt::format("{} = {} cannot be written into the file: {}", change.key, change.value, why));
}

Node treeOf(std::string_view text) {
    try {
        return documentTree(text, 0);
    } catch (const SyntaxError& error) {
        throw core::Error(core::ErrorKind::badContent,
                          fmt::format("line {}, column {}: {}", error.place.line, error.place.column, error.what()));
    }
}

bool isSame(const Node& a, const Node& b) {
    if (a.kind != b.kind || a.flag != b.flag || a.whole != b.whole || a.text != b.text ||
        a.items.size() != b.items.size() || a.members.size() != b.members.size())
        return false;
    if (a.number != b.number && (a.number == a.number || b.number == b.number)) return false;
    for (std::size_t i = 0; i < a.items.size(); ++i)
        if (!isSame(a.items[i], b.items[i])) return false;
    return std::all_of(a.members.begin(), a.members.end(), [&](const Member& member) {
        const Member* other = b.find(member.key);
        return other != nullptr && isSame(member.value, other->value);
    });
}

// Sets a value in a tree; makes missing tables on the way.
void set(Node& root, const KeyPath& path, const Node& value, const Change& change) {
    Node* node = &root;
    for (const std::string& key : path) {
        if (node->kind == NodeKind::table && node->find(key) == nullptr) node->members.push_back({key, {}, Node{}});
        Node* next = node->at(key);
        if (next == nullptr)
            fail(change,
                 node->kind == NodeKind::list ? "the list has no such element" : "there is a plain value on its way");
        node = next;
    }
    *node = value;
}

std::string keyText(const KeyPath& path, std::size_t from) {
    std::string text;
    for (std::size_t i = from; i < path.size(); ++i) {
        const bool isBare = !path[i].empty() && std::all_of(path[i].begin(), path[i].end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
        });
        text += (i == from ? "" : ".") + (isBare ? path[i] : "\"" + path[i] + "\"");
    }
    return text;
}

// A text, and the places of everything in it.
class Written {
  public:
    // Throws SyntaxError.
    explicit Written(std::string_view text) : text_(text), tree_(documentTree(text, 0)) {
        lines_.push_back(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
        for (std::size_t i = 0; i < text.size(); ++i)
            if (text[i] == '\n') lines_.push_back(i + 1);
    }

    const Node& tree() const { return tree_; }
    std::string textOf(const Node& node) const {
        return std::string(text_.substr(at(node.place), at(node.end) - at(node.place)));
    }

    // Whether a header of its own or of an inner table introduces it, or it is a list of such tables.
    bool hasHeader(const Node& node) const {
        if (node.kind == NodeKind::table) return sign(node) == '[';
        return node.kind == NodeKind::list && !node.items.empty() && at(node.items.front().place) == at(node.place);
    }

    // The text with that value in its place, or else after the last value of its table, in that table's style.
    std::string with(const KeyPath& path, const std::string& value) const {
        if (const Node* there = tree_.along(path)) return replaced(at(there->place), at(there->end), value);
        const auto pair = [&](std::size_t from) { return keyText(path, from) + " = " + value; };
        // The innermost table on the way that has braces, a header of its own, or dotted keys.
        const Node* table = path.size() == 1 ? &tree_ : nullptr;
        std::size_t depth = 0, header = 0;  // number of keys that lead to it, and to the header above it
        for (std::size_t d = 1; d < path.size(); ++d) {
            const Node* next = tree_.along(KeyPath(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(d)));
            if (next == nullptr) break;
            const bool isInBraces = table != nullptr && sign(*table) == '{';
            if (next->kind != NodeKind::table || (isInBraces && sign(*next) != '{') || isImplied(*next)) continue;
            table = next;
            depth = d;
            if (hasHeader(*next)) header = d;
        }
        if (table == nullptr) return withNewTable(path, pair(path.size() - 1));
        const Statement last = lastOf(*table);
        if (table != &tree_ && sign(*table) == '{')
            return last.value == nullptr ? replaced(at(table->place), at(table->end), "{ " + pair(depth) + " }")
                                         : replaced(at(last.value->end), at(last.value->end), ", " + pair(depth));
        if (last.value != nullptr) return withLineBehind(at(last.value->end), indentationOf(last.key), pair(header));
        if (table != &tree_) return withLineBehind(at(table->place), "", pair(header));
        return replaced(lines_[0], lines_[0], pair(0) + lineEnd());
    }

  private:
    std::size_t at(Place place) const {
        std::size_t byte = lines_[static_cast<std::size_t>(place.line) - 1];
        for (int column = 1; column < place.column && byte < text_.size(); ++column) do
                ++byte;
            while (byte < text_.size() && (static_cast<unsigned char>(text_[byte]) & 0xC0U) == 0x80U);
        return byte;
    }
    // Its first character: { for braces, [ for a header or a list, else that of a value or of dotted keys.
    char sign(const Node& node) const { return at(node.place) < text_.size() ? text_[at(node.place)] : '\0'; }

    // A table that exists only because of the header of an inner table.
    bool isImplied(const Node& table) const {
        return std::any_of(
            table.members.begin(), table.members.end(),
            [&](const Member& member) { return hasHeader(member.value) && at(member.value.place) == at(table.place); });
    }

    // One `key = value` of a table, or of a table that dotted keys make in it.
    struct Statement {
        const Node* value = nullptr;
        Place key{};
    };
    Statement lastOf(const Node& table) const {
        Statement last;
        for (const Member& member : table.members) {
            if (hasHeader(member.value)) continue;
            const bool isDotted = member.value.kind == NodeKind::table && sign(member.value) != '{';
            const Statement next = isDotted ? lastOf(member.value) : Statement{&member.value, member.place};
            if (next.value != nullptr && (last.value == nullptr || at(next.value->place) > at(last.value->place)))
                last = next;
        }
        return last;
    }

    std::string replaced(std::size_t begin, std::size_t end, const std::string& by) const {
        return std::string(text_.substr(0, begin)) + by + std::string(text_.substr(end));
    }

    std::string lineEnd() const {
        const std::size_t first = text_.find('\n');
        return first != std::string_view::npos && first > 0 && text_[first - 1] == '\r' ? "\r\n" : "\n";
    }

    // Adds a line after the line of `place`.
    std::string withLineBehind(std::size_t place, const std::string& indentation, const std::string& pair) const {
        const std::size_t end = text_.find('\n', place);
        if (end == std::string_view::npos) return std::string(text_) + lineEnd() + indentation + pair;
        return replaced(end + 1, end + 1, indentation + pair + lineEnd());
    }

    std::string indentationOf(Place place) const {
        const std::size_t line = lines_[static_cast<std::size_t>(place.line) - 1];
        return std::string(text_.substr(line, text_.find_first_not_of(" \t", line) - line));
    }

    std::string withNewTable(const KeyPath& path, const std::string& pair) const {
        const std::string end = lineEnd();
        std::string text(text_);
        if (!text.empty() && text.back() != '\n') text += end;
        const KeyPath table(path.begin(), path.end() - 1);
        return text + (text.empty() ? "" : end) + "[" + keyText(table, 0) + "]" + end + pair + end;
    }

    std::string_view text_;
    Node tree_;
    std::vector<std::size_t> lines_;  // byte at which each begins
};

struct PartChange {
    KeyPath path;
    std::string value;
};

// Splits a change of a list with the same length into changes of its elements; else keeps the change itself.
void addParts(const Written& file, const Node* before, const Written& given, const Node& after, const KeyPath& path,
              std::vector<PartChange>& parts) {
    const bool isElementwise = before != nullptr && before->kind == NodeKind::list && after.kind == NodeKind::list &&
                               before->items.size() == after.items.size() && !file.hasHeader(*before);
    if (!isElementwise) return parts.push_back({path, given.textOf(after)});
    for (std::size_t i = 0; i < after.items.size(); ++i) {
        if (isSame(before->items[i], after.items[i])) continue;
        KeyPath item = path;
        item.push_back(std::to_string(i));
        addParts(file, &before->items[i], given, after.items[i], item, parts);
    }
}

}  // namespace

std::string spliced(std::string_view text, std::span<const Change> changes) {
    std::string result(text);
    Node expected = treeOf(text);
    for (const Change& change : changes) {
        const KeyPath path = fields::keyPath(change.key);
        try {
            const std::string alone = "value = " + change.value;
            const Written given(alone);
            if (given.tree().members.size() != 1) fail(change, "it is more than one value");
            const Node& value = *given.tree().at("value");
            set(expected, path, value, change);
            const Written file(result);
            std::vector<PartChange> parts;
            addParts(file, file.tree().along(path), given, value, path, parts);
            for (const auto& [place, part] : parts) result = Written(result).with(place, part);
            if (!isSame(documentTree(result, 0), expected)) fail(change, "other values would change with it");
        } catch (const SyntaxError& error) {
            fail(change, error.what());
        }
    }
    return result;
}

}  // namespace taut::scene
