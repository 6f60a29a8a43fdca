#pragma once

#include <Eigen/Core>

namespace rrcb {

inline constexpr int most_cost_columns = 16;

/// One number for each column.
using CostVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_cost_columns, 1>;
using CostMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_cost_columns, most_cost_columns>;

/// Returns the x >= 0 that minimizes x'Ax / 2 - b'x, for a symmetric positive definite A whose
/// diagonal is about 1. Source: C. L. Lawson and R. J. Hanson, Solving Least Squares Problems
/// (1974), chapter 23.
CostVector nonnegative_minimum(const CostMatrix& a, const CostVector& b);

/// Sums of the normal equations over all observations of seconds = columns * costs.
struct NormalEquations {
    explicit NormalEquations(Eigen::Index num_columns)
        : squares(CostMatrix::Zero(num_columns, num_columns)),
          products(CostVector::Zero(num_columns)) {}

    CostMatrix squares;   ///< sum of columns * columns'
    CostVector products;  ///< sum of columns * seconds
};

/// Returns the least-squares costs, none of which is negative. The cost of a column of zeros is 0.
///
/// If the observations do not determine the costs uniquely, takes those nearest to counting, for
/// which seconds are proportional to the first column.
CostVector fitted_costs(const NormalEquations& sums);

}  // namespace rrcb
