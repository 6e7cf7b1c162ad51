#include "taut/pipeline/sealed_file.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <memory>

#include "taut/core/bytes.h"
#include "taut/core/error.h"
#include "taut/core/private/hash.h"
#include "taut/core/whole_file.h"

namespace taut::pipeline {
namespace {

constexpr std::size_t markSize = 8, versionSize = 4, checksumSize = 8;
constexpr std::size_t headSize = markSize + versionSize + checksumSize;
constexpr int level = 1;                        // of compression: the fastest
constexpr std::uint64_t mostCompressed = 1100;  // deflate makes nothing smaller than 1/1032

std::uint64_t checksum(std::span<const std::byte> bytes) {
    core::Hash hash;
    core::ByteReader reader(bytes);
    for (std::size_t i = 0; i + 8 <= bytes.size(); i += 8) hash.add(reader.number<std::uint64_t>());
    for (std::size_t i = bytes.size() / 8 * 8; i < bytes.size(); ++i) hash.addByte(static_cast<std::uint8_t>(bytes[i]));
    return hash.value();
}

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
    throw core::Error(core::ErrorKind::badContent, fmt::format("{}: {}", name, why));
}

std::span<const std::byte> bytesOf(const std::string& text) {
    return std::as_bytes(std::span<const char>(text.data(), text.size()));
}

}  // namespace

std::vector<std::byte> sealed(const SealedKind& kind, std::span<const std::byte> content) {
    TAUT_EXPECTS(kind.mark.size() == markSize);
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
        libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
    std::vector<std::byte> packed(libdeflate_deflate_compress_bound(compressor.get(), content.size()));
    packed.resize(
        libdeflate_deflate_compress(compressor.get(), content.data(), content.size(), packed.data(), packed.size()));
    core::ByteWriter body;
    body.add(static_cast<std::uint64_t>(content.size()));
    body.addList(std::span<const std::byte>(packed));
    const std::vector<std::byte> sealedPart = body.take();

    core::ByteWriter head;
    for (char c : kind.mark) head.add(c);
    head.add(kind.version);
    head.add(checksum(sealedPart));
    std::vector<std::byte> all = head.take();
    all.insert(all.end(), sealedPart.begin(), sealedPart.end());
    return all;
}

std::vector<std::byte> unsealed(const SealedKind& kind, std::span<const std::byte> bytes, const std::string& name) {
    const std::span<const std::byte> mark = bytesOf(kind.mark);
    if (bytes.size() < markSize || !std::equal(mark.begin(), mark.end(), bytes.begin()))
        refuse(name, fmt::format("this is no {} of taut", kind.title));
    if (bytes.size() < headSize) refuse(name, fmt::format("this {} is cut short", kind.title));
    core::ByteReader head(bytes.subspan(markSize));
    const auto version = head.number<std::uint32_t>();
    if (version > kind.version || version < (kind.oldest > 0 ? kind.oldest : kind.version))
        refuse(name, fmt::format("this {} has format {}, and this taut reads format {}: it was written by {} one",
                                 kind.title, version, kind.version, version > kind.version ? "a newer" : "an older"));
    const std::span<const std::byte> body = bytes.subspan(headSize);
    if (checksum(body) != head.number<std::uint64_t>())
        refuse(name, fmt::format("this {} is damaged or cut short: its checksum does not fit", kind.title));

    core::ByteReader reader(body);
    const auto size = reader.number<std::uint64_t>();
    const std::vector<std::byte> packed = reader.list<std::byte>();
    if (size / mostCompressed > packed.size())
        refuse(name, fmt::format("this {} is damaged: its length cannot be", kind.title));
    if (size > kind.maxContent)
        refuse(name, fmt::format("unpacked, this {} would take {:.4g} MB; up to {:.4g} MB are taken", kind.title,
                                 1e-6 * static_cast<double>(size), 1e-6 * static_cast<double>(kind.maxContent)));
    std::vector<std::byte> content(size);
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
        libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
    if (libdeflate_deflate_decompress(decompressor.get(), packed.data(), packed.size(), content.data(), content.size(),
                                      nullptr) != LIBDEFLATE_SUCCESS)
        refuse(name, fmt::format("this {} is damaged: it does not unpack", kind.title));
    return content;
}

void writeSealed(const std::filesystem::path& path, const SealedKind& kind, std::span<const std::byte> content) {
    core::WholeFile file(path);
    file.write(sealed(kind, content));
    file.commit();
}

std::vector<std::byte> readSealed(const std::filesystem::path& path, const SealedKind& kind) {
    return unsealed(kind, bytesOf(core::fileContent(path, kind.maxContent + (std::uint64_t{1} << 20U))), path.string());
}

}  // namespace taut::pipeline
