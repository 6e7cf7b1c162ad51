#include "taut/core/file_part.h"

#include <charconv>
#include <optional>

#include "taut/core/error.h"
#include "taut/core/whole_file.h"

namespace taut::core {
namespace {

constexpr std::uint64_t mostAround = std::uint64_t{256} << 20U;  // [bytes] of the file around a part

struct FilePart {
    std::string file;
    std::size_t offset = 0, length = 0;
};

std::optional<FilePart> parse(const std::string& name) {
    const std::size_t mark = name.rfind('#');
    if (mark == std::string::npos) return std::nullopt;
    FilePart part;
    part.file = name.substr(0, mark);
    const char* const end = name.data() + name.size();
    const auto [plus, first] = std::from_chars(name.data() + mark + 1, end, part.offset);
    if (first != std::errc() || plus == end || *plus != '+') return std::nullopt;
    const auto [dot, second] = std::from_chars(plus + 1, end, part.length);
    if (second != std::errc() || dot == end || *dot != '.') return std::nullopt;
    return part;
}

}  // namespace

std::string filePartName(const std::filesystem::path& file, std::size_t offset, std::size_t length,
                         std::string_view ending) {
    return file.string() + "#" + std::to_string(offset) + "+" + std::to_string(length) + std::string(ending);
}

bool isFilePart(const std::filesystem::path& name) {
    return parse(name.string()).has_value() && !isThere(name);
}

std::string filePartContent(const std::filesystem::path& name, std::uint64_t maxBytes) {
    if (!isFilePart(name)) return fileContent(name, maxBytes);
    const FilePart part = *parse(name.string());
    const std::string content = fileContent(part.file, mostAround);
    if (part.length > maxBytes || part.offset > content.size() || part.length > content.size() - part.offset)
        throw Error(ErrorKind::badContent, name.string() + ": there is no such part of the file");
    return content.substr(part.offset, part.length);
}

}  // namespace taut::core
