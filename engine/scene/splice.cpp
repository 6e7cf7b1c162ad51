#include "taut/scene/splice.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "taut/core/error.h"
#include "taut/scene/document.h"
#include "taut/scene/toml_outline.h"

namespace taut::scene {

namespace {

[[noreturn]] void fail(const Change& change, const std::string& why) {
    throw core::Error(core::ExitCode::badContent,
                      fmt::format("{} = {} cannot be written into the file: {}", change.key, change.value, why));
}

Node treeOf(std::string_view text) {
    try {
        return documentTree(text, 0);
    } catch (const SyntaxError& error) {
        throw core::Error(core::ExitCode::badContent,
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

// Sets a value in a tree; tables on the way are made.
void set(Node& root, const KeyPath& path, const Node& value, const Change& change) {
    Node* node = &root;
    for (const std::string& key : path) {
        if (node->kind == NodeKind::list) {
            const bool isNumber = !key.empty() && key.size() < 9 &&
                                  std::all_of(key.begin(), key.end(), [](char c) { return c >= '0' && c <= '9'; });
            const std::size_t index = isNumber ? std::stoul(key) : node->items.size();
            if (index >= node->items.size()) fail(change, "the list has no such element");
            node = &node->items[index];
        } else if (node->kind == NodeKind::table) {
            if (node->find(key) == nullptr) node->members.push_back({key, {}, Node{}});
            node = &node->find(key)->value;
        } else {
            fail(change, "there is a plain value on its way");
        }
    }
    *node = value;
}

bool startsWith(const KeyPath& path, const KeyPath& prefix) {
    return path.size() >= prefix.size() && std::equal(prefix.begin(), prefix.end(), path.begin());
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

// One change of one text.
class Splicer {
  public:
    Splicer(std::string_view text, KeyPath path, const std::string& value)
        : text_(text), path_(std::move(path)), value_(value), outline_(outlineOf(text)) {}

    std::string result() const {
        for (const OutlineValue& there : outline_.values)
            if (there.path == path_) return replaced(there.begin, there.end, value_);
        for (std::size_t depth = path_.size() - 1; depth > 0; --depth) {
            const KeyPath table(path_.begin(), path_.begin() + static_cast<std::ptrdiff_t>(depth));
            if (auto text = intoBraces(table)) return *text;
            if (auto text = besideDotted(table)) return *text;
            if (auto text = underHeader(table)) return *text;
        }
        return path_.size() == 1 ? underTop() : withNewTable();
    }

  private:
    std::string replaced(std::size_t begin, std::size_t end, const std::string& by) const {
        return std::string(text_.substr(0, begin)) + by + std::string(text_.substr(end));
    }

    std::string lineEnd() const {
        const std::size_t first = text_.find('\n');
        return first != std::string_view::npos && first > 0 && text_[first - 1] == '\r' ? "\r\n" : "\n";
    }

    // key = value on a line of its own, behind the line in which `place` lies and with the indentation given.
    std::string withLineBehind(std::size_t place, const std::string& indentation, std::size_t from) const {
        const std::string line = indentation + keyText(path_, from) + " = " + value_;
        const std::size_t end = text_.find('\n', place);
        if (end == std::string_view::npos) return std::string(text_) + lineEnd() + line;
        return replaced(end + 1, end + 1, line + lineEnd());
    }

    std::string indentationOf(const OutlineValue& value) const {
        const std::size_t before = text_.substr(0, value.keyBegin).rfind('\n');
        const std::size_t start = before == std::string_view::npos ? 0 : before + 1;
        const std::string_view blanks = text_.substr(start, value.keyBegin - start);
        return blanks.find_first_not_of(" \t") == std::string_view::npos ? std::string(blanks) : "";
    }

    std::optional<std::string> intoBraces(const KeyPath& table) const {
        const auto braces = std::find_if(outline_.values.begin(), outline_.values.end(), [&](const OutlineValue& v) {
            return v.path == table && text_[v.begin] == '{';
        });
        if (braces == outline_.values.end()) return std::nullopt;
        const std::string pair = keyText(path_, table.size()) + " = " + value_;
        std::size_t last = 0;
        for (const OutlineValue& inside : outline_.values)
            if (inside.begin > braces->begin && inside.end < braces->end) last = std::max(last, inside.end);
        if (last == 0) return replaced(braces->begin, braces->end, "{ " + pair + " }");
        return replaced(last, last, ", " + pair);
    }

    // Where others of the table are written as table.key = value.
    std::optional<std::string> besideDotted(const KeyPath& table) const {
        const OutlineValue* last = nullptr;
        for (const OutlineValue& value : outline_.values)
            if (value.isStatement && value.path.size() > table.size() && startsWith(value.path, table) &&
                outline_.headers[value.section].path.size() < table.size())
                last = &value;
        if (last == nullptr) return std::nullopt;
        return withLineBehind(last->end, indentationOf(*last), outline_.headers[last->section].path.size());
    }

    std::optional<std::string> underHeader(const KeyPath& table) const {
        for (std::size_t i = 1; i < outline_.headers.size(); ++i)
            if (outline_.headers[i].path == table) return underSection(i);
        return std::nullopt;
    }

    std::string underSection(std::size_t section) const {
        const OutlineHeader& header = outline_.headers[section];
        const OutlineValue* last = nullptr;
        for (const OutlineValue& value : outline_.values)
            if (value.section == section && value.isStatement) last = &value;
        return last == nullptr ? withLineBehind(header.end, "", header.path.size())
                               : withLineBehind(last->end, indentationOf(*last), header.path.size());
    }

    std::string underTop() const {
        for (const OutlineValue& value : outline_.values)
            if (value.section == 0) return underSection(0);
        const std::size_t start = text_.starts_with("\xEF\xBB\xBF") ? 3 : 0;
        return replaced(start, start, keyText(path_, 0) + " = " + value_ + lineEnd());
    }

    std::string withNewTable() const {
        const std::string end = lineEnd();
        std::string text(text_);
        if (!text.empty() && text.back() != '\n') text += end;
        const KeyPath table(path_.begin(), path_.end() - 1);
        return text + (text.empty() ? "" : end) + "[" + keyText(table, 0) + "]" + end +
               keyText(path_, path_.size() - 1) + " = " + value_ + end;
    }

    std::string_view text_;
    KeyPath path_;
    const std::string& value_;
    Outline outline_;
};

// The changes of the single elements that a change of a list comes to where it keeps its length; else itself.
class Elements {
  public:
    Elements(std::string_view text, const std::string& value)
        : value_("value = " + value), inFile_(outlineOf(text)), inValue_(outlineOf(value_)) {}

    struct Element {
        KeyPath path;
        std::string value;
    };

    std::vector<Element> changed(const KeyPath& path, const Node* before, const Node& after) {
        add(path, {"value"}, before, after);
        return std::move(found_);
    }

  private:
    static const OutlineValue* find(const Outline& outline, const KeyPath& path) {
        for (const OutlineValue& value : outline.values)
            if (value.path == path) return &value;
        return nullptr;
    }

    void add(const KeyPath& path, const KeyPath& pathInValue, const Node* before, const Node& after) {
        const bool isElementwise = before != nullptr && before->kind == NodeKind::list &&
                                   after.kind == NodeKind::list && before->items.size() == after.items.size() &&
                                   find(inFile_, path) != nullptr;
        if (!isElementwise) {
            const OutlineValue& value = *find(inValue_, pathInValue);
            return found_.push_back({path, value_.substr(value.begin, value.end - value.begin)});
        }
        for (std::size_t i = 0; i < after.items.size(); ++i) {
            if (isSame(before->items[i], after.items[i])) continue;
            KeyPath item = path, itemInValue = pathInValue;
            item.push_back(std::to_string(i));
            itemInValue.push_back(std::to_string(i));
            add(item, itemInValue, &before->items[i], after.items[i]);
        }
    }

    std::string value_;
    Outline inFile_, inValue_;
    std::vector<Element> found_;
};

const Node* nodeAt(const Node& root, const KeyPath& path) {
    const Node* node = &root;
    for (const std::string& key : path) {
        if (node->kind == NodeKind::list) {
            node = &node->items[std::stoul(key)];  // set() has refused what is no element
            continue;
        }
        const Member* member = node->find(key);
        if (member == nullptr) return nullptr;
        node = &member->value;
    }
    return node;
}

KeyPath pathOf(const std::string& key) {
    KeyPath path;
    std::size_t begin = 0;
    while (true) {
        const std::size_t dot = key.find('.', begin);
        path.push_back(key.substr(begin, dot == std::string::npos ? dot : dot - begin));
        if (dot == std::string::npos) return path;
        begin = dot + 1;
    }
}

}  // namespace

std::string spliced(std::string_view text, std::span<const Change> changes) {
    std::string result(text);
    Node expected = treeOf(text);
    for (const Change& change : changes) {
        const KeyPath path = pathOf(change.key);
        Node value;
        try {
            const Node alone = documentTree("value = " + change.value, 0);
            if (alone.members.size() != 1) fail(change, "it is more than one value");
            value = alone.find("value")->value;
        } catch (const SyntaxError& error) {
            fail(change, error.what());
        }
        const Node before = expected;
        set(expected, path, value, change);
        for (const auto& [place, part] : Elements(result, change.value).changed(path, nodeAt(before, path), value))
            result = Splicer(result, place, part).result();
        try {
            if (!isSame(documentTree(result, 0), expected)) fail(change, "other values would change with it");
        } catch (const SyntaxError& error) {
            fail(change, error.what());
        }
    }
    return result;
}

}  // namespace taut::scene
