// A TOML text as a tree that keeps the position of every key and value. It knows nothing of scenes.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace taut::scene {

// Where something was written. Origin 0 is the file, -1 the file that it builds on; origin k is the k-th override,
// which has no lines.
struct Place {
    int origin = 0;
    int line = 0;    // from 1
    int column = 0;  // from 1, in characters
};

enum class NodeKind { flag, whole, number, text, time, list, table };

struct Member;

struct Node {
    NodeKind kind = NodeKind::table;
    Place place;  // of a table under a header the header's
    Place end;    // behind it; of a table without braces nothing in particular
    bool flag = false;
    std::int64_t whole = 0;
    double number = 0;  // of a whole number too
    std::string text;
    std::vector<Node> items;      // list
    std::vector<Member> members;  // table, in the order of the file

    const Member* find(std::string_view key) const;
    Member* find(std::string_view key);
};

struct Member {
    std::string key;
    Place place;
    Node value;
};

// What a value is, for messages: "7", "\"red\"", "a list of 3", …
std::string description(const Node& node);

// The first thing in a text that is not TOML.
struct SyntaxError : std::runtime_error {
    SyntaxError(Place where, const std::string& message) : std::runtime_error(message), place(where) {}
    Place place;
};

// The tree of a text. Throws SyntaxError, also for zero bytes, invalid UTF-8, UTF-16, a key given twice,
// and nesting so deep that it can only be an accident or an attack.
Node documentTree(std::string_view text, int origin);

}  // namespace taut::scene
