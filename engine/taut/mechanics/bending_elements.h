// From a triangle mesh or a rope to elements that resist bending, on any triangulation. It knows no force.
//
//        *-------c-------*      The curvature of a triangle is constant: by the divergence theorem that of the
//        gradients
//         \     / \     /       at the middles of its sides, κ = 1/A Σ l n ∂x. Along a side the gradient is that of its
//          \   / A \   /        ends; across, it is the mean of two quadratic fits, one over each of the two triangles
//           \ /     \ /         and their neighbours, which are laid flat for it.
//            a-------b
//             \     /           Both sides of an edge see the same gradient, so that a constant curvature is in
//              \   /            equilibrium (the patch test), which a fit of the curvature itself does not give: that
//               \ /             errs by up to a third however fine the mesh is. Rotation-free triangles with mean
//                *              gradients are those of Oñate and Zárate (2000) and Flores and Oñate (2005).
#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "taut/mechanics/model.h"

namespace taut::mechanics {

// Vectors κ_k = Σ_j w_jk x_j + held_k, the second derivatives of place along uu, vv and uv; of a rope only the first.
// E = ½ Σ_kl modulus_kl d_k·d_l with d = κ - rest n, where n is the normal of a triangle or, of a rope, the direction
// of κ itself. So it is free of force at rest, and does not change when all turns.
struct BendingElement {
    std::vector<int> points;
    std::vector<glm::dvec3> weights;  // (points) of uu, vv, uv [1/m²]; they sum to 0
    glm::dmat3 held{0.0};             // columns uu, vv, uv [1/m]: of held directions; they turn with their carrier
    bool isOfRope = false;
    std::array<int, 3> corners{};  // of a triangle, in its order
    glm::dvec3 rest{0.0};          // of uu, vv, uv [1/m]; of a flat patch 0
    glm::dmat3 modulus{0.0};       // [N m³]; of a rope [N m³] too: EI times a length

    bool isCurved() const { return rest != glm::dvec3(0.0); }
};

// Without triangles that have a severed edge, and those whose corners are all held. The direction is held across an
// edge of two clamped points, and where the triangle beyond is held: there the gradient is known. isHeld, isClamped
// (points). Of a rope as clamped() in bending.h has it. Expects a freeform bending that is not empty.
std::vector<BendingElement> bendingElements(const Model& model, const std::vector<bool>& isHeld,
                                            const std::vector<bool>& isClamped,
                                            const std::function<bool(int, int)>& isSevered);

}  // namespace taut::mechanics
