#include "taut/image/png.h"

#include <gtest/gtest.h>

#include "image_support.h"
#include "taut/image/read.h"

namespace taut::image {
namespace {

using core::ErrorKind;
using test::contentOf;
using test::messageOf;
using test::TemporaryFolder;
using test::testPicture;

TEST(Png, ReadsBackEveryByteAtAnySize) {
    const TemporaryFolder folder;
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 37}, {37, 1}, {64, 48}, {257, 129}}) {
        const Image picture = testPicture(width, height);
        writePng(folder / "a.png", picture);
        const Image back = readImage(folder / "a.png");
        EXPECT_EQ(back.width, width);
        EXPECT_EQ(back.height, height);
        EXPECT_EQ(back.rgb, picture.rgb);
    }
}

TEST(Png, HasTheChunksOfAnEightBitColourPicture) {
    const std::vector<std::byte> bytes = pngBytes(testPicture(3, 2));
    const std::string content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    EXPECT_EQ(content.substr(0, 8), "\x89PNG\r\n\x1a\n");
    // IHDR: width, height, 8 bits, colour type 2 (RGB).
    EXPECT_EQ(content.substr(12, 14), std::string("IHDR\0\0\0\3\0\0\0\2\x08\x02", 14));
    EXPECT_EQ(content.substr(content.size() - 12), std::string("\0\0\0\0IEND\xAE\x42\x60\x82", 12));
}

TEST(Png, ReadsBackColoursBesideAlpha) {
    const TemporaryFolder folder;
    Image picture = testPicture(31, 17);
    for (std::size_t i = 0; i < picture.rgb.size() / 3; ++i) picture.alpha.push_back(static_cast<std::uint8_t>(i));
    writePng(folder / "a.png", picture);
    EXPECT_EQ(readImage(folder / "a.png").rgb, picture.rgb);
    EXPECT_EQ(readImageWithAlpha(folder / "a.png").rgb, picture.rgb);
    EXPECT_EQ(readImageWithAlpha(folder / "a.png").alpha, picture.alpha);
    EXPECT_EQ(contentOf(folder / "a.png")[25], 6);  // colour type: RGBA
    writePng(folder / "opaque.png", testPicture(3, 2));
    EXPECT_TRUE(readImageWithAlpha(folder / "opaque.png").alpha.empty());
}

TEST(Png, SixteenBitsReadBackByTheirUpperByte) {
    const TemporaryFolder folder;
    for (const std::size_t channels : {1U, 3U}) {
        std::vector<std::uint16_t> numbers;
        std::vector<std::uint8_t> upper;
        for (unsigned i = 0; i < channels * 40 * 30; ++i) {
            numbers.push_back(static_cast<std::uint16_t>(i * i * 37U));
            upper.insert(upper.end(), 3 / channels, static_cast<std::uint8_t>(numbers.back() >> 8));
        }
        const std::vector<std::byte> bytes = widePngBytes(40, 30, numbers, "metres per unit: 0.001");
        const std::string content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        test::writeText(folder / "a.png", content);
        EXPECT_EQ(readImage(folder / "a.png").rgb, upper);  // which looks at the checksums too
        EXPECT_EQ(content.substr(24, 2), std::string("\x10") + (channels == 1 ? '\0' : '\2'));
        EXPECT_NE(content.find(std::string("tEXtDescription\0metres per unit: 0.001", 37)), std::string::npos);
    }
}

TEST(Png, IsTheSameBytesEveryTime) {
    EXPECT_EQ(pngBytes(testPicture(80, 60)), pngBytes(testPicture(80, 60)));
}

TEST(Png, FullDiskIsReportedAndLeavesNoPicture) {
    const TemporaryFolder folder;
    const auto path = folder / "a.png";
    const test::FileSizeLimit limit(100);
    const std::string message = messageOf(ErrorKind::inputOutput, [&] { writePng(path, testPicture(64, 64)); });
    EXPECT_NE(message.find("File too large"), std::string::npos) << message;
    EXPECT_EQ(folder.entryCount(), 0);
}

TEST(Png, BrokenOffAnywhereIsAnErrorAndNeverAPicture) {
    const TemporaryFolder folder;
    writePng(folder / "whole.png", testPicture(40, 30));
    const std::string content = contentOf(folder / "whole.png");
    for (std::size_t length = 0; length < content.size(); length += 1 + content.size() / 97) {
        test::writeText(folder / "cut.png", content.substr(0, length));
        const std::string message = messageOf(ErrorKind::badContent, [&] { readImage(folder / "cut.png"); });
        EXPECT_NE(message.find("cut.png: not a whole PNG or JPEG"), std::string::npos) << message;
    }
}

TEST(Png, DamagedByteIsAnError) {
    const TemporaryFolder folder;
    writePng(folder / "a.png", testPicture(40, 30));
    std::string content = contentOf(folder / "a.png");
    content[content.size() / 2] = static_cast<char>(content[content.size() / 2] ^ 1);
    test::writeText(folder / "a.png", content);
    messageOf(ErrorKind::badContent, [&] { readImage(folder / "a.png"); });
}

TEST(Png, OtherFilesAreRefused) {
    const TemporaryFolder folder;
    test::writeText(folder / "a.png", "this is no picture");
    messageOf(ErrorKind::badContent, [&] { readImage(folder / "a.png"); });
    test::writeText(folder / "b.png", "GIF89a\1\0\1\0\0\0\0;");
    messageOf(
        ErrorKind::badContent, [&] { readImage(folder / "b.png"); });
    messageOf(ErrorKind::inputOutput, [&] { readImage(folder / "none.png"); });
}

// 1 x 1 grey JPEG written by hand: quantisation of ones, one Huffman code a table, DC category 0 and end of block.
std::string smallestJpeg() {
    std::string jpeg("\xFF\xD8\xFF\xDB\x00\x43\x00", 7);
    jpeg += std::string(64, '\1');
    jpeg += std::string("\xFF\xC0\x00\x0B\x08\x00\x01\x00\x01\x01\x01\x11\x00", 13);
    for (const char table : {'\x00', '\x10'})
        jpeg += std::string("\xFF\xC4\x00\x14", 4) + table + '\1' + std::string(15, '\0') + '\0';
    jpeg += std::string("\xFF\xDA\x00\x08\x01\x01\x00\x00\x3F\x00", 10);
    jpeg += "\x3F";
    jpeg += "\xFF\xD9";
    return jpeg;
}

TEST(Png, OfMorePixelsThanMayBeIsRefusedBeforeItIsDecoded) {
    const TemporaryFolder folder;
    writePng(folder / "a.png", testPicture(5, 4));
    EXPECT_EQ(readImage(folder / "a.png", 20).width, 5);
    const std::string message = messageOf(ErrorKind::badContent, [&] { readImage(folder / "a.png", 19); });
    EXPECT_NE(message.find("this picture has 5 x 4 pixels"), std::string::npos) << message;
}

// Sixteen counts of 17 are 272 symbols, where 256 are possible.
std::string impossibleTable() {
    return std::string("\xFF\xC4\x01\x23\x00", 5) + std::string(16, '\x11') + std::string(272, '\0');
}

TEST(Jpeg, WithAHuffmanTableThatCannotBeIsRefused) {
    const TemporaryFolder folder;
    test::writeText(folder / "a.jpg", smallestJpeg().insert(2, impossibleTable()));
    EXPECT_NE(messageOf(ErrorKind::badContent, [&] { readImage(folder / "a.jpg"); }).find("damaged"),
              std::string::npos);
}

// Tables 0 and 1 have standard contents, which Motion JPEG leaves out.
TEST(Jpeg, WithoutATableThatItsScanNamesIsRefused) {
    const TemporaryFolder folder;
    for (const char* other : {"\x20", "\x02"}) {
        std::string jpeg = smallestJpeg();
        test::writeText(folder / "a.jpg", jpeg.replace(jpeg.find("\xFF\xDA") + 6, 1, other));
        EXPECT_NE(messageOf(ErrorKind::badContent, [&] { readImage(folder / "a.jpg"); }).find("damaged"),
                  std::string::npos);
    }
}

// In coded data FF FF 00 equals FF 00, no segment with a length: the bytes after it are not skipped.
TEST(Jpeg, BehindBytesThatFillUpNoTableIsOverlooked) {
    const TemporaryFolder folder;
    const std::string hidden = std::string("\xFF\xFF\x00\x01\x27", 5) + impossibleTable();
    std::string jpeg = smallestJpeg();
    test::writeText(folder / "a.jpg", jpeg.insert(jpeg.size() - 2, hidden));
    EXPECT_NE(messageOf(ErrorKind::badContent, [&] { readImage(folder / "a.jpg"); }).find("damaged"),
              std::string::npos);
}

TEST(Jpeg, ThatBeginsWithBytesThatFillUpIsRefused) {
    const TemporaryFolder folder;
    test::writeText(folder / "a.jpg", "\xFF" + smallestJpeg());
    EXPECT_NE(messageOf(ErrorKind::badContent, [&] { readImage(folder / "a.jpg"); }).find("begins as neither"),
              std::string::npos);
}

TEST(Jpeg, OfFourInksIsRefusedByName) {
    const TemporaryFolder folder;
    std::string jpeg = smallestJpeg();
    const std::string one("\x00\x0B\x08\x00\x01\x00\x01\x01\x01\x11\x00", 11);
    const std::string four("\x00\x14\x08\x00\x01\x00\x01\x04\x01\x11\x00\x02\x11\x00\x03\x11\x00\x04\x11\x00", 20);
    jpeg.replace(jpeg.find(one), one.size(), four);
    test::writeText(folder / "a.jpg", jpeg);
    EXPECT_NE(messageOf(ErrorKind::badContent, [&] { readImage(folder / "a.jpg"); }).find("CMYK"), std::string::npos);
}

TEST(Jpeg, IsReadAndBrokenOffIsAnError) {
    const TemporaryFolder folder;
    test::writeText(folder / "a.jpg", smallestJpeg());
    const Image picture = readImage(folder / "a.jpg");
    ASSERT_EQ(picture.width, 1);
    // A block of zeros is the middle of the range.
    EXPECT_EQ(picture.rgb, (std::vector<std::uint8_t>{128, 128, 128}));
    test::writeText(folder / "cut.jpg", smallestJpeg().substr(0, smallestJpeg().size() - 2));
    EXPECT_NE(messageOf(ErrorKind::badContent, [&] { readImage(folder / "cut.jpg"); }).find("breaks off"),
              std::string::npos);
}

}  // namespace
}  // namespace taut::image
