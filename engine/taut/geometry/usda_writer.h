// A film as USD text, .usda, for Houdini, Omniverse, Unreal and Blender. Time codes are frame numbers. Meshes have
// points and normals at every frame that changes them, and new triangles after a tear.
#pragma once

#include <filesystem>
#include <memory>

#include "taut/geometry/geometry_sink.h"

namespace taut::geometry {

class UsdaWriter : public GeometrySink {
  public:
    // Throws core::Error(inputOutput).
    UsdaWriter(const std::filesystem::path& path, GeometryOptions options);
    ~UsdaWriter() override;

    void write(const view::FrameView& view) override;
    void finish() override;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::geometry
