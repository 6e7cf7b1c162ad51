// A film as one glTF 2.0 binary file, .glb, for the web, Blender and VTK. Every frame is a morph target of deforming
// meshes, with linearly interpolated keys; rigid parts move as nodes. Time begins at the first frame. It has one
// topology for all frames, and at most 4 GB.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>

#include "taut/geometry/geometry_sink.h"

namespace taut::geometry {

class GlbWriter : public GeometrySink {
  public:
    // Throws core::Error(inputOutput).
    GlbWriter(const std::filesystem::path& path, GeometryOptions options);
    ~GlbWriter() override;

    void write(const view::FrameView& view) override;
    void finish() override;

    // Hands the bytes of the file on, block by block, instead of making one.
    void finish(const std::function<void(std::span<const std::byte>)>& take);

    // Browsers promise room for 256 frames a mesh.
    static constexpr std::size_t mostWebKeys = 255;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::geometry
