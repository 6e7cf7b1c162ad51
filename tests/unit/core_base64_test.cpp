#include "taut/core/private/base64.h"

#include <gtest/gtest.h>

#include <string_view>

namespace taut::core {
namespace {

std::span<const std::byte> bytes(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

// RFC 4648, section 10; in one piece and letter by letter.
TEST(Base64, IsThatOfTheStandardHoweverItComes) {
    const std::string_view text = "foobar";
    const std::string_view expected[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
    for (std::size_t length = 0; length <= text.size(); ++length) {
        EXPECT_EQ(base64(bytes(text.substr(0, length))), expected[length]);
        Base64 writer;
        std::string out;
        for (std::size_t i = 0; i < length; ++i) writer.append(out, bytes(text.substr(i, 1)));
        writer.finish(out);
        EXPECT_EQ(out, expected[length]);
        std::vector<unsigned char> back;
        EXPECT_TRUE(fromBase64(out, back));
        EXPECT_EQ(std::string(back.begin(), back.end()), text.substr(0, length));
    }
    std::vector<unsigned char> back;
    for (const std::string_view wrong : {"Zg=v", "Zm 9", "Z", "Zm9vY", "===="})
        EXPECT_FALSE(fromBase64(wrong, back)) << wrong;
}

}  // namespace
}  // namespace taut::core
