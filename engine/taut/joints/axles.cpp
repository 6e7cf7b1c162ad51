#include "taut/joints/private/axles.h"
#include "taut/joints/private/slide.h"

namespace taut::world {

namespace {

// The same places of both bodies.
void takeSpots(Constraint::Drive& drive, TieEnds& ends, const Mounting& at, const std::array<dvec3, 3>& places) {
    for (std::size_t k = 0; k < places.size(); ++k) drive.a[k] = ends.of(at.a(places[k]));
    for (std::size_t k = 0; k < places.size(); ++k)
        drive.b[k] = std::visit([&](const auto& end) { return ends.of(end); }, at.b(places[k]));
}

}  // namespace

Axle::Axle(Drive drive, const Mounting& at, const std::array<dvec3, 3>& places) : drive_(drive) {
    takeSpots(drive_, ends_, at, places);
}

Slide::Slide(Drive drive, const Mounting& at, const std::array<dvec3, 3>& places) : drive_(drive) {
    drive_.slides = true;
    isDriven_ = drive.damping > 0 || drive.friction > 0 || drive.most > 0;
    const dvec3 beyond = places[2] + places[1] - places[0];
    const bool isRail = std::holds_alternative<Place>(at.b(beyond));
    Spot beside = 0;
    if (!isRail) beside = ends_.of(at.a(beyond));
    takeSpots(drive_, ends_, at, places);
    if (isRail) {
        // Seen from the collider, the body slides the other way.
        beside = ends_.of(std::get<Place>(at.b(beyond)));
        std::swap(drive_.a, drive_.b);
        for (auto* spots : {&drive_.a, &drive_.b}) std::swap((*spots)[0], (*spots)[1]);
    }
    pairs_ = {{drive_.a[0], drive_.b[0], 0, 0.0, false, drive_.a[1]},
              {drive_.a[1], drive_.b[1], 0, 0.0, false, drive_.a[0]},
              {drive_.a[2], drive_.b[2], 0, 0.0, false, beside}};
}

}  // namespace taut::world
