// The content of a file as a tree that keeps the position of every key and value. It knows no file format.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace taut::fields {

// The place where something was written. Origin 0 is the file, -1 the file that it builds on, -2 the file below that,
// and so on. Origin k is the k-th override, which has no lines.
struct Place {
    int origin = 0;
    int line = 0;    // from 1
    int column = 0;  // from 1, in characters
};

enum class NodeKind { flag, whole, number, text, time, list, table };

struct Member;

// Keys one inside another: "cloth.flag.cells" at its dots. Elements of lists go by their number, from 0.
using KeyPath = std::vector<std::string>;
KeyPath keyPath(std::string_view key);

struct Node {
    NodeKind kind = NodeKind::table;
    Place place;  // for a table under a header: the header's
    Place end;    // behind it; not defined for a table without braces
    bool flag = false;
    std::int64_t whole = 0;
    double number = 0;  // of a whole number too
    std::string text;
    std::vector<Node> items;      // list
    std::vector<Member> members;  // table, in the order of the file

    const Member* find(std::string_view key) const;
    std::string textAt(std::string_view key) const;  // empty if it has no such text
    Member* find(std::string_view key);

    // The member with that key; null: none.
    const Node* at(std::string_view key) const;
    Node* at(std::string_view key);
    const Node* along(const KeyPath& path) const;
    // All that at() finds, in order.
    std::vector<std::string> keys() const;
};

struct Member {
    std::string key;
    Place place;
    Node value;
};

// A description of a value for messages: "7", "\"red\"", "a list of 3", …
std::string description(const Node& node);

}  // namespace taut::fields
