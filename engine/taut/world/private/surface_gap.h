// The distance between surfaces of bodies; made once, for many questions. Bodies need not touch.
#pragma once

#include <memory>
#include <vector>

#include "taut/contact/elements.h"
#include "taut/contact/bvh.h"
#include "taut/world/world_info.h"

namespace taut::world {

class SurfaceGap {
  public:
    // Measures whole bodies, whatever points the selections name, and no body against itself. Valid until a body comes
    // or goes.
    SurfaceGap(const Selection& first, const Selection& second);
    SurfaceGap(const SurfaceGap&) = delete;
    SurfaceGap& operator=(const SurfaceGap&) = delete;

    std::int64_t generation() const { return generation_; }  // of the world's bodies
    // The smallest distance [m]; 0 where one passes through the other. Infinite if there are no two bodies to measure.
    double measure();
    // Whether any two are as near as touching bodies stay apart: within the sum of their thicknesses plus 5 %.
    bool areNear();

  private:
    void build();
    void look();
    bool cross(const std::vector<bool>& first, const std::vector<bool>& second);
    double distance(const std::vector<bool>& first, const std::vector<bool>& second);
    double least(std::vector<bool> first, const std::vector<bool>& second);

    std::int64_t generation_;
    std::vector<const Body*> bodies_;       // (surfaces)
    std::vector<std::size_t> damage_;       // (surfaces) number of severed edges taken into account
    std::size_t goneAround_ = 0;            // of all bodies
    std::vector<bool> isFirst_, isSecond_;  // (surfaces)
    std::vector<glm::dvec3> x_;             // (points) one body after the other
    std::unique_ptr<contact::Elements> elements_;
    std::unique_ptr<contact::Bvh> patches_;
};

}  // namespace taut::world
