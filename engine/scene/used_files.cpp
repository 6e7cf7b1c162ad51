#include "taut/scene/used_files.h"

#include <algorithm>
#include <utility>

#include "taut/core/error.h"
#include "taut/core/hash.h"
#include "taut/core/whole_file.h"

namespace taut::scene {
namespace {

std::uint64_t contentOf(const std::string& path) {
    constexpr std::uint64_t most = std::uint64_t{1} << 30U;  // [bytes] of a texture
    try {
        core::Hash hash;
        hash.add(core::fileContent(path, most));
        return hash.value();
    } catch (const core::Error&) {
        return 0;
    }
}

}  // namespace

std::vector<UsedFile> usedFiles(const world::SceneSpec& scene) {
    std::vector<UsedFile> files;
    const auto add = [&](const std::string& path) {
        const bool isKnown =
            std::any_of(files.begin(), files.end(), [&](const auto& file) { return file.path == path; });
        if (!path.empty() && !isKnown) files.push_back({path, contentOf(path)});
    };
    add(scene.file);
    add(scene.base);
    add(scene.environment.image);
    for (const world::BodySpec& body : scene.bodies) {
        if (const world::MeshSource* mesh = body.meshSource()) add(mesh->mesh);
        add(body.finish.texture);
    }
    for (const world::ColliderSpec& collider : scene.colliders) {
        add(collider.mesh);
        add(collider.finish.texture);
        for (const world::ColliderSpec& part : collider.parts) add(part.mesh);
    }
    return files;
}

std::vector<std::string> changedSince(std::span<const UsedFile> files) {
    std::vector<std::string> changes;
    for (const UsedFile& file : files)
        if (!core::isThere(file.path))
            changes.push_back(file.path + " is gone");
        else if (contentOf(file.path) != file.content)
            changes.push_back(file.path + " has changed");
    return changes;
}

void addUsedFiles(core::ByteWriter& writer, std::span<const UsedFile> files) {
    writer.add(static_cast<std::uint64_t>(files.size()));
    for (const UsedFile& file : files) {
        writer.add(file.path);
        writer.add(file.content);
    }
}

std::vector<UsedFile> nextUsedFiles(core::ByteReader& reader) {
    std::vector<UsedFile> files;
    // Not reserved: a count that is not true ends with the bytes.
    for (auto left = reader.number<std::uint64_t>(); left > 0; --left) {
        UsedFile file{reader.text()};
        file.content = reader.number<std::uint64_t>();
        files.push_back(std::move(file));
    }
    return files;
}

}  // namespace taut::scene
