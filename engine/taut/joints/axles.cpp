#include "taut/joints/private/axles.h"

namespace taut::world {

Axle::Axle(Drive drive, const Mounting& at, const std::array<dvec3, 3>& places) : drive_(drive) {
    for (std::size_t k = 0; k < places.size(); ++k) drive_.a[k] = ends_.of(at.a(places[k]));
    for (std::size_t k = 0; k < places.size(); ++k)
        drive_.b[k] = std::visit([&](const auto& end) { return ends_.of(end); }, at.b(places[k]));
}

}  // namespace taut::world
