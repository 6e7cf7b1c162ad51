#include "taut/core/private/base64.h"

namespace taut::core {
namespace {

constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

void appendGroup(std::string& text, const std::byte* bytes, std::size_t count) {
    const auto byte = [&](std::size_t at) { return at < count ? std::to_integer<unsigned>(bytes[at]) : 0U; };
    const unsigned three = byte(0) << 16U | byte(1) << 8U | byte(2);
    for (unsigned k = 0; k < 4; ++k) text += k > count ? '=' : letters[(three >> (18U - 6U * k)) & 63U];
}

}  // namespace

void Base64::append(std::string& text, std::span<const std::byte> bytes) {
    while (count_ > 0 && !bytes.empty()) {
        waiting_[count_++] = bytes.front();
        bytes = bytes.subspan(1);
        if (count_ < 3) continue;
        appendGroup(text, waiting_.data(), 3);
        count_ = 0;
    }
    for (; bytes.size() >= 3; bytes = bytes.subspan(3)) appendGroup(text, bytes.data(), 3);
    for (const std::byte byte : bytes) waiting_[count_++] = byte;
}

void Base64::finish(std::string& text) {
    if (count_ > 0) appendGroup(text, waiting_.data(), count_);
    count_ = 0;
}

std::string base64(std::span<const std::byte> bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    Base64 writer;
    writer.append(text, bytes);
    writer.finish(text);
    return text;
}

bool fromBase64(std::string_view text, std::vector<unsigned char>& bytes) {
    for (int padding = 0; padding < 2 && text.ends_with('='); ++padding) text.remove_suffix(1);
    static const std::array<unsigned, 256> valueOf = [] {
        std::array<unsigned, 256> values{};
        values.fill(64);
        for (unsigned i = 0; i < 64; ++i) values[static_cast<unsigned char>(letters[i])] = i;
        return values;
    }();
    bytes.reserve(bytes.size() + text.size() / 4 * 3 + 2);
    unsigned waiting = 0, bits = 0;
    for (const char letter : text) {
        const unsigned value = valueOf[static_cast<unsigned char>(letter)];
        if (value > 63) return false;
        waiting = (waiting << 6U | value) & 0xFFFFU;
        if ((bits += 6) < 8) continue;
        bits -= 8;
        bytes.push_back(static_cast<unsigned char>(waiting >> bits));
    }
    return bits < 6;
}

}  // namespace taut::core
