// Where the keys, values and tables of a TOML text begin and end, in bytes. It does not say what the values are.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace taut::scene {

// Keys from the root; elements of a list by their number.
using KeyPath = std::vector<std::string>;

struct OutlineValue {
    KeyPath path;
    std::size_t keyBegin = 0;        // where its own (dotted) key is written; of a list's element, the value
    std::size_t begin = 0, end = 0;  // of the value
    std::size_t section = 0;         // the header under which it stands, 0: the top of the file
    bool isStatement = false;        // key = value on lines of its own; else inside a list or braces
};

struct OutlineHeader {
    KeyPath path;
    std::size_t end = 0;  // behind its bracket
};

struct Outline {
    std::vector<OutlineHeader> headers;  // [0] is the top of the file, with an empty path
    std::vector<OutlineValue> values;    // in the order of the text, a table or list before what is in it
};

// Expects a text that is valid TOML.
Outline outlineOf(std::string_view text);

}  // namespace taut::scene
