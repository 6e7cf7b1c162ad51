// The parts of a frame for formats of geometry: parts keep one name from the first frame to the last, and their
// pointers stay the same while they do not change. Independent of formats.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "taut/view/frame_view.h"

namespace taut::geometry {

// The same with underscores for all but letters and digits.
std::string identifierOf(const std::string& name);

struct Part {
    std::string identifier;  // letters, digits and underscores; unique: "cloth_flag"
    std::string name;        // "cloth.flag", of several pieces of one thing the same
    std::shared_ptr<const view::Topology> topology;
    std::shared_ptr<const view::Geometry> geometry;
    std::shared_ptr<const view::Finish> finish;
    glm::mat4 transform{1.0F};
    bool isTwoSided = false;
};

class PartFinder {
  public:
    // By full name; null: everything is wanted.
    explicit PartFinder(std::function<bool(const std::string& name)> isWanted) : isWanted_(std::move(isWanted)) {}

    // The parts of a frame, in its order: surfaces that follow each other with one name, one finish and no place of
    // their own are one, such as the rods of a net. The ground is a square below the camera's first target.
    std::vector<Part> partsOf(const view::FrameView& view);

    // The name of a surface in scenes: those of colliders come without their kind.
    static std::string fullName(const view::Surface& surface);

  private:
    using Group = std::vector<const view::Surface*>;
    struct Known {
        Part part;
        std::vector<std::shared_ptr<const view::Topology>> topologies;  // (surfaces) that are joined
    };
    Part partOf(const Group& group, const std::string& name, std::size_t ordinal);
    Known& known(const std::string& name, std::size_t ordinal);
    void addGround(const view::FrameView& view, std::vector<Part>& parts);

    std::function<bool(const std::string&)> isWanted_;
    std::map<std::pair<std::string, std::size_t>, Known> known_;  // by name and ordinal under that name
    std::set<std::string> identifiers_;
};

}  // namespace taut::geometry
