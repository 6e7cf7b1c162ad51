// A rigid body made of point masses: the model that has its mass properties, and the places and velocities of a rigid
// motion that keep the momenta of free points.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "taut/core/mass_properties.h"
#include "taut/mechanics/model.h"

namespace taut::mechanics {

using glm::dmat3;
using glm::dvec3;

struct RigidShape {
    std::vector<dvec3> positions;  // [m] of contact surfaces, in the body's own axes
    std::vector<std::array<int, 3>> triangles;
    std::vector<std::array<int, 2>> lines;           // a capsule's
    std::vector<RigidPart> parts;                    // of these positions
    std::map<std::string, std::vector<int>> groups;  // of these positions; in a compound "part0", "part0-top"
    core::MassProperties properties;                 // mass / volume times its spread is the spread of its mass
    double mass = 1;                                 // [kg]
    dmat3 axes{1.0};                                 // columns: the body's axes in the scene
    dvec3 place{0.0};                                // [m] of its origin
    double dragRate = 0;                             // [1/s]
};
// Makes a shape a part of a compound, which has no mass before its first. Shapes that overlap weigh twice there.
void join(RigidShape& compound, const RigidShape& shape);
// The points of a rigid model come after six inner ones that touch nothing: they have nearly all of the mass, stand in
// pairs on both sides of the centre, and make mass, centre and inertia those of the body.
inline constexpr int innerPoints = 6;
// Throws core::Error(badContent) if most positions are so far from the mass that inner points cannot make up for
// theirs.
Model buildRigid(const RigidShape& shape);

// The corners of the polyhedron whose faces lie `outward` [m] farther out than these triangles, which have areas.
std::vector<dvec3> withFacesOutward(std::span<const dvec3> positions, std::span<const std::array<int, 3>> triangles,
                                    double outward);

// The rotation, as orthonormal columns, in which three points with places `now` stand that have places `rest` in the
// body's axes, nearly.
dmat3 rotationBetween(const std::array<dvec3, 3>& rest, const std::array<dvec3, 3>& now);

// Moves x to the rigid placement of `rest` that has the same sums of m x and of m from × x: so the constraint forces
// added no momentum (Σ m Δ = 0) and no angular momentum (Σ m from × Δ = 0). After a step of leap-frog this is the
// discrete rigid body of Moser and Veselov 1991, which is symplectic and keeps angular momentum; McLachlan and Zanna
// 2005 show that it is SHAKE for any set of points. All arrays (points).
void placeRigidly(std::span<const double> masses, std::span<const dvec3> rest, std::span<const dvec3> from,
                  std::span<dvec3> x);
// Makes v [m/s] the velocities of a rigid motion with the same momentum and angular momentum.
void moveRigidly(std::span<const double> masses, std::span<const dvec3> x, std::span<dvec3> v);

}  // namespace taut::mechanics
