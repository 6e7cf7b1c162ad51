#include "taut/scene/private/asset_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <memory>
#include <system_error>

#include "taut/bodies/block.h"
#include "taut/bodies/cloth.h"
#include "taut/core/error.h"
#include "taut/scene/private/gltf_file.h"
#include "taut/scene/private/obj_file.h"
#include "taut/spec/ticks.h"

namespace taut::scene {

namespace {

using std::filesystem::path;

// A file that a scene names: its path, and its contents if it is a mesh or a state.
struct Asset {
    std::string found;
    std::shared_ptr<const world::MeshData> mesh;
    std::shared_ptr<const world::StartState> state;
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

world::MeshData meshIn(const path& file, const Confinement& confinement) {
    std::string ending = file.extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (ending == ".obj") return objMesh(file);
    if (ending == ".glb" || ending == ".gltf") return gltfMesh(file, confinement);
    throw core::Error(core::ErrorKind::badContent,
                      core::at({file.string()}) + "only OBJ and glTF are read: export it as Wavefront OBJ or as GLB");
}

// Why a found file cannot be used; empty if it can. Stores the contents of a mesh in the asset.
std::string faultOf(const NameReference& reference, const LoadOptions& options, const Confinement& confinement,
                    Asset& asset) {
    if (reference.role == Role::state) {
        if (!options.stateIn) return "this program does not read kept states";
        try {
            asset.state = std::make_shared<const world::StartState>(options.stateIn(asset.found));
        } catch (const core::Error& error) {
            return fmt::format("cannot start from {}: {}", asset.found, error.what());
        }
        return "";
    }
    if (reference.role != Role::mesh) {
        const std::string fault =
            options.pictureFault ? options.pictureFault(asset.found, reference.role == Role::environment) : "";
        return fault.empty() ? "" : "cannot use this picture: " + fault;
    }
    try {
        asset.mesh = std::make_shared<const world::MeshData>(meshIn(asset.found, confinement));
    } catch (const core::Error& error) {
        return fmt::format("cannot use this mesh: {}", error.what());
    }
    return "";
}

// The folders for a file named at this place: that of the file that names it, then of the scene and of its bases.
std::vector<path> foldersFor(Place place, const world::SceneSpec& spec) {
    std::vector<path> folders{path(spec.file).parent_path()};
    for (const std::string& base : spec.bases) folders.push_back(path(base).parent_path());
    if (place.origin < 0 && -place.origin < static_cast<int>(folders.size()))
        folders.insert(folders.begin(), folders[-place.origin]);
    std::vector<path> once;
    for (const path& folder : folders)
        if (std::find(once.begin(), once.end(), folder) == once.end()) once.push_back(folder);
    return once;
}

// Without texture coordinates a mesh has no warp, and its material resists bending equally in all directions.
void warnOfLostDirections(const ReadScene& scene, Problems& problems) {
    for (const world::BodySpec& body : scene.spec.bodies) {
        const world::MeshSource* source = body.meshSource();
        const auto material = scene.spec.materials.find(std::string(body.materialName()));
        if (source == nullptr || source->meshData == nullptr || !source->meshData->cornerUv.empty() ||
            material == scene.spec.materials.end())
            continue;
        const world::BendingSpec& of = material->second.rigidity;
        if (!of.warp || (!of.weft && !of.bias)) continue;  // without warp it is refused
        problems.addWarning(
            scene.owners.at("material." + material->first),
            fmt::format("bending_rigidity_N_m is {:.3g} all ways in {}: {} has no texture coordinates for the warp to "
                        "run along",
                        std::sqrt(*of.warp * of.weft.value_or(*of.warp)), body.fullName(), source->mesh),
            "unwrap the mesh, or give one number");
    }
}

// Only grids whose warp runs along them have threads that rub at each other.
void warnOfLostFriction(const ReadScene& scene, Problems& problems) {
    for (const world::BodySpec& body : scene.spec.bodies) {
        const auto material = scene.spec.materials.find(std::string(body.materialName()));
        const auto* cloth = dynamic_cast<const world::ClothSpec*>(&body);
        const bool isTurned = cloth != nullptr && std::abs(std::sin(2.0 * cloth->grain)) > 1e-9;
        const bool isMesh = body.meshSource() != nullptr && body.meshSource()->meshData != nullptr;
        if ((!isMesh && !isTurned) || material == scene.spec.materials.end() ||
            !(material->second.friction.hysteresis.value_or(0) > 0))
            continue;
        problems.addWarning(scene.owners.at(body.fullName()),
                            fmt::format("bending_hysteresis_N of material.{} does nothing in {}: only threads along "
                                        "the lines of a grid rub at each other",
                                        material->first, body.fullName()),
                            fmt::format("{}, or give the material bending_hysteresis_N = 0",
                                        isMesh ? "make it a grid" : "give it a grain_deg that is a multiple of 90"));
    }
}

void fillMesh(const ReadScene& scene, world::BlockSpec& block, Problems& problems) {
    if (block.meshData == nullptr) return;
    try {
        block.fillMesh();
    } catch (const core::Error& error) {
        problems.addError(scene.owners.at(block.fullName()), error.what());
    }
}

void setSkin(Place place, world::BodySpec& body, const Assets& meshes, Problems& problems) {
    const auto found = meshes.find(body.finish.skin);
    if (found == meshes.end()) return;
    body.finish.skin = found->second.found;
    if (body.kind() != "cloth" && body.kind() != "block")
        return problems.addWarning(
            place, fmt::format("finish.skin does nothing in {}: cloths and blocks have one", body.fullName()),
            "leave it out");
    body.finish.skinData = found->second.mesh;
}

// The pictures of a run are of whole frames, from its start to its end.
void useState(const Asset& asset, Place place, world::RunSpec& run, Problems& problems) {
    const world::Ticks ticks(run);
    const double seconds = ticks.secondsOf(asset.state->tick);
    run.start = asset.found;
    run.startState = asset.state;
    run.startSource = {problems.fileOf(place), place.line, place.column};
    if (asset.state->tick % ticks.perFrame != 0)
        problems.addError(place, fmt::format("this state was kept at {:.6g} s, between two frames", seconds),
                          "keep it at a frame");
    else if (asset.state->tick > ticks.last())
        problems.addError(place,
                          fmt::format("this state was kept at {:.6g} s, when the run is over: seconds is {:.6g}",
                                      seconds, run.seconds),
                          "the run continues from the time of the state: make seconds larger");
}

// Replaces names by the files found.
void useAssets(const Assets& meshes, const Assets& textures, ReadScene& scene, Problems& problems) {
    for (world::BodySpec& body : scene.spec.bodies) {
        const Place place = scene.owners.at(body.fullName());
        for (world::BodySpec* shape : body.shapes()) {
            world::MeshSource* source = shape->meshSource();
            if (source != nullptr) setMesh(*source, meshes);
            if (shape->finish.weave > 0 && source != nullptr && source->meshData != nullptr &&
                source->meshData->uv.empty()) {
                shape->finish.weave = 0;
                problems.addWarning(
                    place,
                    fmt::format("{} has no texture coordinates for threads to run along: no weave", source->mesh),
                    "unwrap the mesh, or leave weave out");
            }
            setTexture(shape->finish.texture, textures);
            setSkin(place, *shape, meshes, problems);
        }
        if (auto* block = dynamic_cast<world::BlockSpec*>(&body)) fillMesh(scene, *block, problems);
    }
    warnOfLostDirections(scene, problems);
    warnOfLostFriction(scene, problems);
    for (world::ColliderSpec& collider : scene.spec.colliders) {
        setMesh(collider, meshes);
        for (world::ColliderSpec& part : collider.parts) {
            setMesh(part, meshes);
            if (part.ownFinish) setTexture(part.ownFinish->texture, textures);
        }
        setTexture(collider.finish.texture, textures);
    }
}

}  // namespace

void loadAssets(const LoadOptions& options, const Confinement& confinement, ReadScene& scene, Problems& problems) {
    // Each file is looked for once; a second reference takes the same.
    Assets meshes, textures, environments, states;
    for (const NameReference& reference : scene.references) {
        Assets* of = nullptr;
        if (reference.role == Role::mesh) of = &meshes;
        if (reference.role == Role::texture) of = &textures;
        if (reference.role == Role::environment) of = &environments;
        if (reference.role == Role::state) of = &states;
        if (of == nullptr) continue;
        Assets& assets = *of;
        if (assets.contains(reference.text)) continue;
        problems.about(reference.owner);

        // The first place that has the file wins.
        Asset asset;
        std::vector<std::string> searched;
        const std::vector<path> folders = foldersFor(reference.place, scene.spec);
        for (const path& place : placesFor(reference.text, folders, options.assetFolders)) {
            std::error_code code;
            searched.push_back(place.string());
            if (!asset.found.empty() || !std::filesystem::is_regular_file(place, code)) continue;
            asset.found = place.string();
        }
        // Missing, outside of the allowed folders, or unusable.
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
        if (const std::string fault = faultOf(reference, options, confinement, asset); !fault.empty()) {
            problems.addError(reference.place, fault);
            scene.faulty.insert(reference.owner);
            continue;
        }
        if (asset.state != nullptr) useState(asset, reference.place, scene.spec.run, problems);
        assets.emplace(reference.text, asset);
    }
    problems.about("");

    setTexture(scene.spec.environment.image, environments);
    useAssets(meshes, textures, scene, problems);
}

}  // namespace taut::scene
