// Where the geometry of frames goes, one after the other: to a file that other programs read. It does not know where
// the frames come from.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "taut/core/error.h"
#include "taut/view/frame_view.h"

namespace taut::geometry {

struct GeometryOptions {
    double fps = 60.0;               // frames a second of scene time
    double aspect = 16.0 / 9.0;      // width of the picture over its height
    bool normals = true;             // written with every frame
    bool isCompact = false;          // GLB for taut's own pages: moves of 16 bits, normals of the first frame alone
    int digits = 5;                  // behind the point, in formats of text; 1 … 9
    std::string generator = "taut";  // named in the file
    // Selects parts by their full names: "cloth.flag", "collider.ball", "ground"; null: everything.
    std::function<bool(const std::string& name)> isWanted{};
};

// The triangles of something change, where a format has the same ones for all frames.
class TopologyChanged : public core::Error {
  public:
    TopologyChanged(const std::string& file, std::string name, std::int64_t frame)
        : Error(core::ErrorKind::badContent, file + ": " + name + " tears or is cut before frame " +
                                                 std::to_string(frame) +
                                                 ", and such a file keeps the triangles of the first frame"),
          name_(std::move(name)),
          frame_(frame) {}
    const std::string& name() const { return name_; }  // "cloth.flag"
    std::int64_t frame() const { return frame_; }      // the first one that shows it

  private:
    std::string name_;
    std::int64_t frame_;
};

class GeometrySink {
  public:
    virtual ~GeometrySink() = default;

    // Writes a frame; frames come in ascending order. Throws core::Error: inputOutput, a full disk included; badContent
    // if the format cannot hold it; TopologyChanged.
    virtual void write(const view::FrameView& view) = 0;

    // Gives the file its name; expects at least one frame, and none afterwards. Without it no file is created, and an
    // old one stays. Throws core::Error(inputOutput).
    virtual void finish() = 0;
};

}  // namespace taut::geometry
