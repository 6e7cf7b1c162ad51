// A symmetric matrix of which each row has elements from its first column to the diagonal, factored as L D Lᵀ. A row
// that follows from others has no pivot, and no share of a solution.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace taut::world {

class EnvelopeMatrix {
  public:
    void addRow(int firstColumn) {
        start_.push_back(lower_.size());
        first_.push_back(firstColumn);
        lower_.resize(lower_.size() + static_cast<std::size_t>(static_cast<int>(first_.size()) - 1 - firstColumn));
        inversePivot_.push_back(0.0);
    }
    void clear() { lower_.assign(lower_.size(), 0.0); }
    // Expects an element within the envelope, left of the diagonal.
    double& at(int row, int column) { return lower_[start_[row] + static_cast<std::size_t>(column - first_[row])]; }
    double at(int row, int column) const { return const_cast<EnvelopeMatrix&>(*this).at(row, column); }
    // diagonal: (rows)
    void factor(std::span<const double> diagonal) {
        for (int i = 0; i < rows(); ++i) {
            const int first = first_[i];
            for (int j = first; j < i; ++j) {
                double sum = at(i, j);
                for (int k = first < firstOf(j) ? firstOf(j) : first; k < j; ++k) sum -= at(i, k) * at(j, k);
                at(i, j) = sum;
            }
            double pivot = diagonal[i];
            for (int j = first; j < i; ++j) {
                const double scaled = at(i, j) * inversePivot_[j];
                pivot -= scaled * at(i, j);
                at(i, j) = scaled;
            }
            inversePivot_[i] = pivot > leastPivot * diagonal[i] ? 1.0 / pivot : 0.0;
        }
    }
    // (rows) right-hand sides, then the solution.
    template <class Value>
    void solve(std::span<Value> values) const {
        for (int i = 0; i < rows(); ++i)
            for (int j = firstOf(i); j < i; ++j) values[i] -= at(i, j) * values[j];
        for (int i = 0; i < rows(); ++i) values[i] *= inversePivot_[i];
        for (int i = rows() - 1; i >= 0; --i)
            for (int j = firstOf(i); j < i; ++j) values[j] -= at(i, j) * values[i];
    }

  private:
    static constexpr double leastPivot = 1e-10;  // of the diagonal element

    int rows() const { return static_cast<int>(first_.size()); }
    int firstOf(int row) const { return first_[row]; }

    std::vector<int> first_;            // (rows) first column of the envelope
    std::vector<std::size_t> start_;    // (rows) start in lower_
    std::vector<double> lower_;         // L, row by row, without its diagonal
    std::vector<double> inversePivot_;  // (rows) 1/D; 0 without a pivot
};

}  // namespace taut::world
