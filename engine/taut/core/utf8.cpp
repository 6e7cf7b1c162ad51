#include "taut/core/private/utf8.h"

namespace taut::core {
namespace {

bool steers(std::uint32_t code, bool isOneLine) {
    if (code < 0x20) return isOneLine || (code != '\n' && code != '\t');
    return (code >= 0x7F && code < 0xA0) || code == 0x61C || code == 0x200E || code == 0x200F ||
           (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

std::string hexadecimal(std::uint32_t number) {
    constexpr char digits[] = "0123456789ABCDEF";
    std::string text;
    do {
        text.insert(text.begin(), digits[number & 0xFU]);
        number >>= 4U;
    } while (number > 0);
    return text;
}

}  // namespace

Letter firstLetter(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    if (lead < 0x80) return {lead, 1};
    const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < size) return {};
    std::uint32_t code = lead & (0xFFU >> (size + 1));
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return {};
        code = code << 6U | (byte(i) & 0x3FU);
    }
    const bool isOverlong = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
    if (isOverlong || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return {};
    return {code, size};
}

std::string printable(std::string_view text, bool isOneLine) {
    std::string shown;
    shown.reserve(text.size());
    while (!text.empty()) {
        const Letter letter = firstLetter(text);
        if (letter.size == 0)
            shown += "\\x" + hexadecimal(static_cast<unsigned char>(text[0]));
        else if (steers(letter.code, isOneLine))
            shown += "\\u{" + hexadecimal(letter.code) + "}";
        else
            shown += text.substr(0, letter.size);
        text.remove_prefix(letter.size == 0 ? 1 : letter.size);
    }
    return shown;
}

}  // namespace taut::core
