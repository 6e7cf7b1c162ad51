#include "taut/core/private/file_batch.h"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "taut/core/error.h"
#include "taut/core/whole_file.h"

namespace taut::core {
namespace {

using std::filesystem::path;

constexpr std::string_view replaceWord = "replace ", removeWord = "remove ";

path listIn(const path& folder) {
    return folder / ".changes";
}

path newOf(const path& file) {
    return file.string() + ".new";
}

[[noreturn]] void failOn(const path& file, const std::string& what) {
    throw Error(ErrorKind::inputOutput, file.string() + ": " + what);
}

// A name in the list is one of a file in the folder, or below.
path checked(const path& folder, const std::string& name) {
    const path relative(name);
    const bool isBelow = !name.empty() && relative.is_relative() &&
                         std::none_of(relative.begin(), relative.end(), [](const path& part) { return part == ".."; });
    std::error_code error;
    const path root = std::filesystem::canonical(folder, error);
    const path parent = std::filesystem::weakly_canonical((folder / relative).parent_path(), error);
    if (!isBelow || error || std::mismatch(root.begin(), root.end(), parent.begin(), parent.end()).first != root.end())
        throw Error(ErrorKind::badContent,
                    listIn(folder).string() + ": names a file that is not in this folder: '" + name + "'");
    return folder / relative;
}

void removeFile(const path& file) {
    std::error_code error;
    std::filesystem::remove(file, error);
    if (error) failOn(file, "cannot remove: " + error.message());
}

}  // namespace

FileBatch::FileBatch(path folder) : folder_(std::move(folder)) {}

FileBatch::~FileBatch() {
    if (isListed_) return;
    std::error_code ignored;
    for (const path& file : replaced_) std::filesystem::remove(newOf(folder_ / file), ignored);
}

path FileBatch::replace(const path& file) {
    replaced_.push_back(file.lexically_relative(folder_));
    prepareFolderOf(file);
    return newOf(file);
}

void FileBatch::remove(const path& file) {
    removed_.push_back(file.lexically_relative(folder_));
}

void FileBatch::commit() {
    std::string list;
    for (const path& file : replaced_) list += std::string(replaceWord) + file.string() + "\n";
    for (const path& file : removed_) list += std::string(removeWord) + file.string() + "\n";
    writeWholeFile(listIn(folder_), list);
    isListed_ = true;
    recover(folder_);
}

bool FileBatch::isPending(const path& folder) {
    return isThere(listIn(folder));
}

void FileBatch::recover(const path& folder) {
    if (!isPending(folder)) return;
    std::istringstream lines(fileContent(listIn(folder)));
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(removeWord)) {
            removeFile(checked(folder, line.substr(removeWord.size())));
        } else if (line.starts_with(replaceWord)) {
            const path file = checked(folder, line.substr(replaceWord.size()));
            std::error_code error;
            std::filesystem::rename(newOf(file), file, error);
            if (error == std::errc::no_such_file_or_directory) continue;  // it was renamed before
            if (error) failOn(file, "cannot rename the finished file: " + error.message());
        } else {
            throw Error(ErrorKind::badContent, listIn(folder).string() + ": cannot be understood: '" + line + "'");
        }
    }
    removeFile(listIn(folder));
}

}  // namespace taut::core
