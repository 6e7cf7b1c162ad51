// The parts of claims, and their evaluation. Does not parse.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "taut/check/check.h"
#include "taut/island/report.h"
#include "taut/world/world_info.h"

namespace taut::check {

struct Function;

// A number, or three in x.
struct Quantity {
    glm::dvec3 x{0.0};
};

// The world at one moment, each thing measured once.
class Now {
  public:
    // The selections may be those of moments before, in the same world.
    Now(const world::World& world, Selections& selections) : world_(world), selections_(selections) {}
    const world::World& world() const { return world_; }
    const world::Metrics& metrics(const std::string& bodies, world::Measures what) const;  // empty: of all
    // Throws core::Error(badContent) if there are none.
    const world::PointsNow& points(const std::string& target) const;
    // (triangles) corners [m]; none if there are no such bodies.
    std::vector<std::array<glm::dvec3, 3>> triangles(const std::string& bodies) const;
    // Of a target that names whole bodies, with solids or meshes among them, which end elsewhere than at their points;
    // null for others.
    world::BodySurfaces* surfaces(const std::string& target) const;
    // Throws core::Error(badContent) if there are no such bodies, or if they are one and the same.
    world::BodySurfaces& gap(const std::string& first, const std::string& second) const;

  private:
    const world::Selection& selection(const std::string& target) const;
    world::BodySurfaces& surfacesOf(const std::string& first, const std::string& second) const;

    const world::World& world_;
    Selections& selections_;
    mutable std::map<std::pair<std::string, world::Measures>, world::Metrics> metrics_;
    mutable std::map<std::string, world::PointsNow> points_;
};

enum class Part { number, vector, call, negative, sum, difference, product, quotient, component, target };

struct Expression {
    Part part = Part::number;
    std::size_t begin = 0, end = 0;  // bytes of the text
    bool isVector = false;
    double number = 0;
    int axis = 0;                        // of a component, or an argument that is one
    std::string target;                  // of a target
    const Function* function = nullptr;  // of a call
    std::vector<Expression> inside;      // operands or arguments

    // Whether it speaks of the world.
    bool isMeasured() const;
};

Quantity valueOf(const Expression& expression, const Now& now);

// Where the first function inside that has a place finds its value; empty: none has.
std::string placeOf(const Expression& expression, const Now& now);

// Of an expression that is one function, or a part or a multiple of one; else empty.
std::string unitOf(const Expression& expression);

// A comparison of two numbers. No relation holds with a NaN.
struct Relation {
    std::string_view sign, flipped;  // "<", and the relation with exchanged sides
    int way;                         // of a chain: 1 upwards, -1 downwards, 0 neither
    bool (*holds)(double a, double b);
    double (*margin)(double a, double b);  // how far they are inside; negative where it does not hold
};
std::span<const Relation> relations();  // no sign comes before a longer one that it begins

// terms[0] relations[0] terms[1] relations[1] …
struct Claim {
    std::string text;
    std::vector<Expression> terms;
    std::vector<const Relation*> relations;
};

}  // namespace taut::check
