#include "taut/scene/asset_files.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <system_error>

#include "taut/core/error.h"
#include "taut/scene/obj_file.h"

namespace taut::scene {

namespace {

using std::filesystem::path;

// A file that a scene names: as found, and what it holds if it is a mesh.
struct Asset {
    std::string found;
    std::shared_ptr<const world::MeshData> mesh;
};
using Assets = std::map<std::string, Asset>;

std::vector<path> placesFor(const path& name, const std::vector<path>& folders, const std::vector<path>& assetFolders) {
    if (name.is_absolute()) return {name};
    std::vector<path> places;
    for (const path& folder : folders) places.push_back(folder / name);
    for (const path& folder : assetFolders) {
        places.push_back(folder / name);
        places.push_back(folder / "models" / name);
        places.push_back(folder / "textures" / name);
    }
    return places;
}

void setTexture(std::string& path, const Assets& textures) {
    if (const auto found = textures.find(path); found != textures.end()) path = found->second.found;
}

void setMesh(world::MeshSource& spec, const Assets& meshes) {
    const auto found = meshes.find(spec.mesh);
    if (found == meshes.end()) return;
    spec.mesh = found->second.found;
    spec.meshData = found->second.mesh;
}

}  // namespace

void loadAssets(const path& sceneFolder, const path& baseFolder, const std::vector<path>& assetFolders,
                const Confinement& confinement, ReadScene& scene, Problems& problems) {
    Assets meshes, textures;
    for (const Reference& reference : scene.references) {
        const bool isMesh = reference.role == Role::mesh;
        if (!isMesh && reference.role != Role::texture) continue;
        Assets& assets = isMesh ? meshes : textures;
        if (assets.contains(reference.text)) continue;

        Asset asset;
        std::vector<std::string> searched;
        std::vector<path> folders{sceneFolder};
        if (!scene.spec.base.empty() && baseFolder != sceneFolder)
            folders.insert(reference.place.origin < 0 ? folders.begin() : folders.end(), baseFolder);
        for (const path& place : placesFor(reference.text, folders, assetFolders)) {
            std::error_code code;
            searched.push_back(place.string());
            if (!asset.found.empty() || !std::filesystem::is_regular_file(place, code)) continue;
            asset.found = place.string();
        }
        if (asset.found.empty()) {
            problems.addError(reference.place, fmt::format("there is no file \"{}\"", reference.text),
                              fmt::format("looked for {}", joined(searched)));
            scene.faulty.insert(reference.owner);
            continue;
        }
        if (!confinement.allows(asset.found)) {
            problems.addError(reference.place, outsideMessage(asset.found));
            scene.faulty.insert(reference.owner);
            continue;
        }
        if (isMesh) {
            try {
                asset.mesh = std::make_shared<const world::MeshData>(objMesh(asset.found));
            } catch (const core::Error& error) {
                problems.addError(reference.place, fmt::format("cannot use this mesh: {}", error.what()));
                scene.faulty.insert(reference.owner);
                continue;
            }
        }
        assets.emplace(reference.text, asset);
    }

    setTexture(scene.spec.environment.image, textures);
    for (world::BodySpec& body : scene.spec.bodies) {
        if (world::MeshSource* source = body.meshSource()) setMesh(*source, meshes);
        setTexture(body.finish.texture, textures);
    }
    for (world::ColliderSpec& collider : scene.spec.colliders) {
        setMesh(collider, meshes);
        for (world::ColliderSpec& part : collider.parts) setMesh(part, meshes);
        setTexture(collider.finish.texture, textures);
    }
}

}  // namespace taut::scene
