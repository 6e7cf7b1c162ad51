#include "taut/core/private/utf8.h"

#include <gtest/gtest.h>

namespace taut::core {
namespace {

// By the table of RFC 3629, section 4.
TEST(Utf8, LettersAreThoseOfTheStandard) {
    const std::pair<const char*, Letter> letters[] = {
        {"a", {'a', 1}},      {"é", {0xE9, 2}}, {"€", {0x20AC, 3}},       {"😀", {0x1F600, 4}},
        {"\x80", {}},         {"\xC3", {}},     {"\xC0\xAF", {}},         {"\xE0\x80\xAF", {}},
        {"\xED\xA0\x80", {}}, {"\xC3(", {}},    {"\xF4\x90\x80\x80", {}}, {"\xF8\x88\x80\x80\x80", {}}};
    for (const auto& [text, expected] : letters) {
        const Letter letter = firstLetter(text);
        EXPECT_EQ(letter.size, expected.size) << text;
        if (expected.size > 0) EXPECT_EQ(letter.code, expected.code) << text;
    }
}

TEST(Utf8, ControlCharactersAreShownAsText) {
    EXPECT_EQ(printable("größe 3 µm\tend\n"), "größe 3 µm\tend\n");
    EXPECT_EQ(printable("two\tor\nmore", true), "two\\u{9}or\\u{A}more");
    EXPECT_EQ(printable("\x1b]0;title\x07 \x7f\r"), "\\u{1B}]0;title\\u{7} \\u{7F}\\u{D}");
    EXPECT_EQ(printable("\xC2\x9B"
                        "31m \xE2\x80\xAE"
                        "gnp.toml\xE2\x81\xA9 \x9B"),
              "\\u{9B}31m \\u{202E}gnp.toml\\u{2069} \\x9B");
}

}  // namespace
}  // namespace taut::core
