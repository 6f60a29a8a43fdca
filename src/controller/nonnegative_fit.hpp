#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace rrcb {

inline constexpr int most_cost_columns = 16;

/// A number for each column. It holds them itself: a step allocates no memory.
class CostVector {
  public:
    explicit CostVector(std::size_t size) : size_(size) {}

    std::size_t size() const { return size_; }
    double& operator[](std::size_t j) { return numbers_[j]; }
    double operator[](std::size_t j) const { return numbers_[j]; }
    double* begin() { return numbers_.data(); }
    double* end() { return begin() + size_; }
    const double* begin() const { return numbers_.data(); }
    const double* end() const { return begin() + size_; }

  private:
    std::array<double, most_cost_columns> numbers_{};
    std::size_t size_;
};

/// A symmetric matrix with a row for each column of costs.
class CostMatrix {
  public:
    explicit CostMatrix(std::size_t size) : size_(size) {}

    double& operator()(std::size_t i, std::size_t j) { return numbers_[i * size_ + j]; }
    double operator()(std::size_t i, std::size_t j) const { return numbers_[i * size_ + j]; }
    std::span<double> numbers() { return std::span(numbers_).first(size_ * size_); }

  private:
    std::array<double, std::size_t{most_cost_columns} * most_cost_columns> numbers_{};
    std::size_t size_;
};

/// Returns the x >= 0 that minimizes x'Ax / 2 - b'x, for a symmetric positive definite A whose
/// diagonal is about 1. Source: C. L. Lawson and R. J. Hanson, Solving Least Squares Problems
/// (1974), chapter 23.
CostVector nonnegative_minimum(const CostMatrix& a, const CostVector& b);

/// Sums of the normal equations over all observations of seconds = columns * costs.
struct NormalEquations {
    explicit NormalEquations(std::size_t num_columns)
        : squares(num_columns), products(num_columns) {}

    CostMatrix squares;   ///< sum of columns * columns'
    CostVector products;  ///< sum of columns * seconds
};

/// Returns the least-squares costs, none of which is negative. The cost of a column of zeros is 0.
///
/// If the observations do not determine the costs uniquely, takes those nearest to counting, for
/// which seconds are proportional to the first column.
CostVector fitted_costs(const NormalEquations& sums);

}  // namespace rrcb
