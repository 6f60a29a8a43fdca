#pragma once

#include <Eigen/Core>

namespace rrcb {

inline constexpr int most_cost_columns = 16;

/// A number for each column.
using CostVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_cost_columns, 1>;
using CostMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_cost_columns, most_cost_columns>;

/// Returns the x >= 0 of least x'Ax / 2 - b'x, for a symmetric positive definite A of diagonal
/// about 1: C. L. Lawson and R. J. Hanson, Solving Least Squares Problems (1974), chapter 23.
CostVector nonnegative_minimum(const CostMatrix& a, const CostVector& b);

/// Sums of the normal equations over observations: seconds = columns * costs.
struct NormalEquations {
    explicit NormalEquations(Eigen::Index num_columns)
        : squares(CostMatrix::Zero(num_columns, num_columns)),
          products(CostVector::Zero(num_columns)) {}

    CostMatrix squares;   ///< sum of columns * columns'
    CostVector products;  ///< sum of columns * seconds
};

/// Returns the least-squares costs, none of them negative; 0 for a column of zeros.
///
/// If the observations leave costs open, these are drawn towards counting: seconds proportional to
/// the first column.
CostVector fitted_costs(const NormalEquations& sums);

}  // namespace rrcb
