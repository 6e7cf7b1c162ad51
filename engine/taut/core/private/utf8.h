// UTF-8, letter by letter. Independent of the meaning of texts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace taut::core {

struct Letter {
    std::uint32_t code = 0;  // of Unicode
    std::size_t size = 0;    // [bytes]; 0: these bytes are no UTF-8
};

// The first letter of a text, which is not empty; by RFC 3629, so neither overlong nor a surrogate.
Letter firstLetter(std::string_view text);

// The text, safe to print on a terminal: control sequences and marks that reorder letters are escaped. Controls except
// line ends and tabs (U+0000 to U+001F, U+007F to U+009F), line separators and the marks of the bidirectional algorithm
// (Unicode Annex 9) become "\u{202E}", invalid bytes "\x9B". For a single line, line ends and tabs are escaped too.
std::string printable(std::string_view text, bool isOneLine = false);

}  // namespace taut::core
