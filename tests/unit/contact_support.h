// Points that fly freely from one instant of contact to the next, with surfaces between them and no springs: all that
// changes their velocities is contact.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "support/piercings.h"
#include "taut/contact/contact_group.h"

namespace taut::contact {

struct Flight {
    std::vector<ContactSurface> surfaces;
    std::vector<dvec3> x, v;          // (points) [m], [m/s]
    std::vector<double> inverseMass;  // (points) [1/kg]
    ContactOptions options;
    std::unique_ptr<ContactGroup> group;  // made by the first instant
    std::vector<dvec3> rest;              // [m] none: as they are at the first instant

    int addPoint(const dvec3& place, const dvec3& speed, double mass) {
        x.push_back(place);
        v.push_back(speed);
        inverseMass.push_back(mass > 0 ? 1.0 / mass : 0.0);  // of nothing: held
        return static_cast<int>(x.size()) - 1;
    }
    // A surface of its own bond, which meets others alone.
    ContactSurface& addSurface(double thickness) {
        ContactSurface surface;
        surface.thickness = thickness;
        surface.meetsItself = false;
        surface.bond = static_cast<int>(surfaces.size());
        surfaces.push_back(surface);
        return surfaces.back();
    }
    void addBall(const dvec3& place, const dvec3& speed, double mass, double thickness) {
        const int i = addPoint(place, speed, mass);
        addSurface(thickness).points = {i};
    }
    void addTriangle(const std::array<dvec3, 3>& places, const dvec3& speed, double massOfEach, double thickness) {
        std::array<int, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = addPoint(places[k], speed, massOfEach);
        ContactSurface& surface = addSurface(thickness);
        surface.points = {corners[0], corners[1], corners[2]};
        surface.triangles = {corners};
    }
    void addLine(const dvec3& a, const dvec3& b, const dvec3& speed, double massOfEach, double thickness) {
        const int p = addPoint(a, speed, massOfEach), q = addPoint(b, speed, massOfEach);
        ContactSurface& surface = addSurface(thickness);
        surface.points = {p, q};
        surface.lines = {{p, q}};
    }
    // Of cells × cells squares, row by row from the origin.
    ContactSurface& addSheet(const dvec3& origin, const dvec3& across, const dvec3& down, int cells, const dvec3& speed,
                             double massOfEach, double thickness) {
        const int first = static_cast<int>(x.size()), n = cells + 1;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                addPoint(origin + (static_cast<double>(i) / cells) * across + (static_cast<double>(j) / cells) * down,
                         speed, massOfEach);
        ContactSurface& surface = addSurface(thickness);
        for (int k = 0; k < n * n; ++k) surface.points.push_back(first + k);
        for (int j = 0; j < cells; ++j)
            for (int i = 0; i < cells; ++i) {
                const int a = first + j * n + i;
                surface.triangles.push_back({a, a + 1, a + n});
                surface.triangles.push_back({a + 1, a + n + 1, a + n});
            }
        return surface;
    }

    // Flies for h [s], in a block of one step or more.
    const BlockResult& fly(double h, int steps = 1) {
        if (!group) {
            group = std::make_unique<ContactGroup>(surfaces, rest.empty() ? x : rest, options);
            group->begin(x);
        }
        const std::vector<dvec3> start = x;
        std::vector<dvec3> ahead = x;
        for (std::size_t i = 0; i < x.size(); ++i) ahead[i] += h * v[i];
        Block block;
        block.h = h / steps;
        block.steps = steps;
        block.x0 = start;
        block.ahead = ahead;
        block.inverseMass = inverseMass;
        group->open(block);
        for (int step = 0; step < steps; ++step) {
            const std::vector<dvec3> before = x, vBefore = v;
            for (std::size_t i = 0; i < x.size(); ++i) x[i] += block.h * v[i];
            group->step({before, x, v, vBefore});
        }
        group->close(x, v);
        group->finish(x);
        return group->result();
    }

    double mass(std::size_t i) const { return inverseMass[i] > 0 ? 1.0 / inverseMass[i] : 0.0; }
    double kinetic() const {
        double sum = 0;
        for (std::size_t i = 0; i < x.size(); ++i) sum += 0.5 * mass(i) * glm::dot(v[i], v[i]);
        return sum;
    }
    dvec3 momentum() const {
        dvec3 sum(0.0);
        for (std::size_t i = 0; i < x.size(); ++i) sum += mass(i) * v[i];
        return sum;
    }
    // About the origin.
    dvec3 angularMomentum() const {
        dvec3 sum(0.0);
        for (std::size_t i = 0; i < x.size(); ++i) sum += mass(i) * glm::cross(x[i], v[i]);
        return sum;
    }
    test::Skin skin() const {
        test::Skin skin;
        for (const ContactSurface& surface : surfaces) {
            for (const auto& t : surface.triangles) skin.addTriangle(t[0], t[1], t[2]);
            for (const auto& line : surface.lines) skin.addEdge(line[0], line[1]);
        }
        return skin;
    }
};

// A block of one step from x0 to x1, straight on (points).
inline const BlockResult& resolve(ContactGroup& group, double h, std::span<const dvec3> x0, std::span<dvec3> x1,
                                  std::span<dvec3> v, std::span<const double> inverseMass) {
    const std::vector<dvec3> ahead(x1.begin(), x1.end()), before(v.begin(), v.end());
    Block block;
    block.h = h;
    block.x0 = x0;
    block.ahead = ahead;
    block.inverseMass = inverseMass;
    group.begin(x0);
    group.open(block);
    group.step({x0, x1, v, before});
    group.close(x1, v);
    group.finish(x1);
    return group.result();
}

// Numbers from -1 to 1, the same on all machines.
class Dice {
  public:
    explicit Dice(unsigned seed) : engine_(seed) {}
    double number() { return 2.0 * static_cast<double>(engine_()) / 4294967295.0 - 1.0; }
    double between(double low, double high) { return low + 0.5 * (number() + 1.0) * (high - low); }
    dvec3 vector() {
        const double a = number(), b = number(), c = number();
        return {a, b, c};
    }
    dvec3 direction() {
        for (;;) {
            const dvec3 d = vector();
            const double square = glm::dot(d, d);
            if (square > 0.01 && square < 1) return d / std::sqrt(square);
        }
    }

  private:
    std::mt19937 engine_;
};

}  // namespace taut::contact
