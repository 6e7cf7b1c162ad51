// The damage of a body by cuts and tears, in points of its model: severed edges, and the triangles and tetrahedra that
// are gone with them. It knows neither islands nor the cause.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "taut/mechanics/model.h"

namespace taut::world {

class Damage {
  public:
    using Edge = std::pair<int, int>;  // points of the model, the lower first

    bool isEmpty() const { return edges_.empty(); }
    bool isSevered(int a, int b) const { return edges_.count({a < b ? a : b, a < b ? b : a}) > 0; }
    // Where an edge is severed, as a share of the way from a to b; a half if not known.
    double share(int a, int b) const;
    const std::map<Edge, double>& edges() const { return edges_; }  // with the share from the lower point
    // Always false for a triangle that is not of the model.
    bool isTriangleGone(std::size_t triangle) const { return triangle < triangles_.size() && triangles_[triangle]; }
    // A tetrahedron of a cell, 0 to 5. The cell is gone with the first of them.
    bool isTetrahedronGone(std::size_t cell, std::size_t number) const {
        return !tetrahedra_.empty() && tetrahedra_[cellTetrahedra * cell + number];
    }
    bool isCellGone(std::size_t cell) const;
    std::size_t goneTetrahedra() const { return goneTetrahedra_; }  // how many
    // Of a body with cells, a number that grows with every change of its surface up to the cuts; 0 without a cut.
    std::size_t goneAround() const {
        return goneTetrahedra_ > 0 ? goneTetrahedra_ + goneTriangles_ + edges_.size() : 0;
    }

    // Severs an edge at a share 0 … 1 of the way from a to b. An edge that is severed already stays as it is.
    void sever(int a, int b, double share);
    // Finds the effects of sever(). Expects the same model in every call. A bending spring goes with the
    // springs along it. Triangles and tetrahedra go when no springs hold their corners together. The cost grows only
    // with new damage.
    void assess(const mechanics::Model& model);

  private:
    struct Index;  // of the model

    std::map<Edge, double> edges_;
    std::vector<Edge> fresh_;             // not assessed yet
    std::shared_ptr<const Index> index_;  // made when first needed
    static constexpr std::size_t cellTetrahedra = mechanics::cellTetrahedra.size();
    std::vector<bool> triangles_, tetrahedra_;  // (of the model) gone; empty while no edge is severed
    std::size_t goneTetrahedra_ = 0, goneTriangles_ = 0;
};

}  // namespace taut::world
