// A film as one glTF 2.0 binary file, .glb: what the web, Blender and VTK read. Every frame is a morph target of what
// changes shape, with keys between which programs move evenly; what is rigid moves as a node. Time begins at the first
// frame. It holds one topology for all frames, and at most 4 GB.
#pragma once

#include <filesystem>
#include <memory>

#include "taut/geometry/geometry_sink.h"

namespace taut::geometry {

class GlbWriter : public GeometrySink {
  public:
    // Throws core::Error(inputOutput).
    GlbWriter(const std::filesystem::path& path, GeometryOptions options);
    ~GlbWriter() override;

    void write(const view::FrameView& view) override;
    void finish() override;

    // Browsers promise room for 256 frames a mesh.
    static constexpr std::size_t mostWebKeys = 255;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::geometry
