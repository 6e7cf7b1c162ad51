// The surfaces of whole bodies as they are now; made once, for many questions. Bodies need not touch.
//
// A cloth, a rope or a net ends at its points, without its thickness. A solid ends where it is drawn, with edges
// rounded by its thickness (mechanics::RigidPart). A block that is made of a mesh ends at that, until it is torn.
#pragma once

#include <memory>
#include <vector>

#include "taut/contact/bvh.h"
#include "taut/contact/carried_points.h"
#include "taut/contact/elements.h"
#include "taut/mechanics/model.h"
#include "taut/world/world_info.h"

namespace taut::world {

class BodySurfaces {
  public:
    // Takes entire bodies, even if the selections name points. Valid until a body comes or goes.
    explicit BodySurfaces(const Selection& bodies) : BodySurfaces(bodies, bodies) {}
    BodySurfaces(const Selection& first, const Selection& second);
    BodySurfaces(const BodySurfaces&) = delete;
    BodySurfaces& operator=(const BodySurfaces&) = delete;

    std::int64_t generation() const { return generation_; }  // of the world's bodies
    // The smallest distance [m] between bodies of the first and others of the second; 0 where one passes through the
    // other. Infinite if there are no two bodies to measure.
    double gap();
    // Whether any two are as near as touching bodies stay apart: within the sum of their thicknesses plus 5 %.
    bool areNear();
    // The highest place of any, or the lowest.
    struct Place {
        const Body* body;
        glm::dvec3 x;  // [m]
    };
    Place highest() { return furthest(1.0); }
    Place lowest() { return furthest(-1.0); }

  private:
    void build();
    void look();
    bool cross(const std::vector<bool>& first, const std::vector<bool>& second);
    double distance(const std::vector<bool>& first, const std::vector<bool>& second);
    double least(std::vector<bool> first, const std::vector<bool>& second);
    // Calls each(a, b, least distance) for the surfaces of one `radius` a of the first with those of one b of the
    // second.
    template <class Radius, class Each>
    void forRadii(const Radius& radius, const Each& each);
    Place furthest(double up);

    std::int64_t generation_;
    // (surfaces) those of one body one after the other
    std::vector<const Body*> bodies_;
    std::vector<mechanics::RigidPart> parts_;
    std::vector<collision::PlacedConvex> pieces_;  // of solids; null: not convex
    std::vector<int> first_;                       // first point of the body
    std::vector<std::size_t> damage_;              // (surfaces) number of severed edges taken into account
    std::size_t goneAround_ = 0;                   // of all bodies
    std::vector<bool> isFirst_, isSecond_;         // (surfaces)
    std::vector<glm::dvec3> x_;                    // (points) one body after the other, then the points that they carry
    contact::CarriedPoints carried_;
    std::unique_ptr<contact::Elements> elements_;
    std::unique_ptr<contact::Bvh> patches_;
};

}  // namespace taut::world
