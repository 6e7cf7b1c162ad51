#include "taut/core/bytes.h"

#include <gtest/gtest.h>

#include <limits>

namespace taut::core {
namespace {

TEST(Bytes, ComeBackAsTheyWereWritten) {
    const std::vector<double> numbers = {0.1, -0.0, std::numeric_limits<double>::denorm_min()};
    ByteWriter writer;
    writer.add(std::int64_t{-7});
    writer.add(true);
    writer.add(std::string_view("naïve\0b", 8));
    writer.addList(std::span<const double>(numbers));
    writer.add(1.5F);
    const std::vector<std::byte> bytes = writer.take();

    ByteReader reader(bytes);
    EXPECT_EQ(reader.number<std::int64_t>(), -7);
    EXPECT_TRUE(reader.number<bool>());
    EXPECT_EQ(reader.text(), std::string("naïve\0b", 8));
    const std::vector<double> back = reader.list<double>();
    ASSERT_EQ(back.size(), numbers.size());
    for (std::size_t i = 0; i < back.size(); ++i)
        EXPECT_EQ(std::bit_cast<std::uint64_t>(back[i]), std::bit_cast<std::uint64_t>(numbers[i]));
    EXPECT_EQ(reader.number<float>(), 1.5F);
    EXPECT_TRUE(reader.isAtEnd());
}

TEST(Bytes, AreLittleEndian) {
    ByteWriter writer;
    writer.add(std::uint32_t{0x01020304});
    const std::vector<std::byte> bytes = writer.take();
    EXPECT_EQ(bytes, (std::vector<std::byte>{std::byte{4}, std::byte{3}, std::byte{2}, std::byte{1}}));
}

TEST(Bytes, EndingTooEarlyIsAnError) {
    ByteWriter writer;
    writer.add(std::string_view("twelve bytes"));
    const std::vector<std::byte> bytes = writer.take();
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        ByteReader reader(std::span<const std::byte>(bytes).first(size));
        EXPECT_THROW(reader.text(), Error) << size;
    }
}

// A length that the bytes cannot hold is refused before anything of that size is allocated.
TEST(Bytes, AListCannotClaimMoreThanThereIs) {
    ByteWriter writer;
    writer.add(std::numeric_limits<std::uint64_t>::max() / 2);
    const std::vector<std::byte> bytes = writer.take();
    EXPECT_THROW(ByteReader(bytes).list<double>(), Error);
}

}  // namespace
}  // namespace taut::core
