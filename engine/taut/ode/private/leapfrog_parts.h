// Shared by leap-frog and its form with dashpots split off.
#pragma once

#include <memory>
#include <span>

#include "taut/ode/method.h"

namespace taut::ode {

template <class Real>
std::unique_ptr<Method<Real>> makeSplitLeapfrog();

// After a contact the velocity predicted for the time of the positions, memory[0], is unknown. The new velocity
// replaces it.
template <class Real>
void takeAsPredicted(State<Real>& state, std::span<const int> points) {
    for (int p = 0; p < state.layout.planes; ++p) {
        const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(p) * state.layout.stride;
        for (int i : points) state.memory[0][plane + i] = state.v[plane + i];
    }
}

}  // namespace taut::ode
