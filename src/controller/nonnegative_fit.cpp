#include "controller/nonnegative_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace rrcb {

namespace {

using Active = Eigen::Array<bool, Eigen::Dynamic, 1, 0, most_cost_columns, 1>;

/// Returns the minimum if all columns except the free ones are 0.
CostVector free_minimum(const CostMatrix& a, const CostVector& b, const Active& is_free) {
    CostMatrix equations = a;
    CostVector right = b;
    for (Eigen::Index j = 0; j < b.size(); ++j) {
        if (is_free[j]) continue;
        equations.row(j).setZero();
        equations.col(j).setZero();
        equations(j, j) = 1;
        right[j] = 0;
    }
    return equations.ldlt().solve(right);
}

/// Returns the share of the way from `from` to `to` along which no free number becomes negative.
double allowed_share(const CostVector& from, const CostVector& to, const Active& is_free) {
    double share = 1;
    for (Eigen::Index j = 0; j < to.size(); ++j)
        if (is_free[j] && to[j] <= 0) share = std::min(share, from[j] / (from[j] - to[j]));
    return share;
}

}  // namespace

CostVector nonnegative_minimum(const CostMatrix& a, const CostVector& b) {
    CostVector x = CostVector::Zero(b.size());
    if (b.size() == 0) return x;
    Active is_free = Active::Constant(b.size(), false);
    const double least = 1e-14 * b.cwiseAbs().maxCoeff();
    // Each turn of the outer loop lowers the objective, so no set of free columns is repeated,
    // except because of round-off; therefore the limit.
    for (Eigen::Index turn = 0; turn < 4 * b.size(); ++turn) {
        // Frees the column along which the objective decreases fastest.
        Eigen::Index next = 0;
        const CostVector descent = b - a * x;
        if (is_free.select(-1.0, descent.array()).maxCoeff(&next) <= least) break;
        is_free[next] = true;
        // Invariant: x >= 0. Each turn either reaches the minimum, or fixes a column at 0 on the
        // way.
        for (;;) {
            const CostVector to = free_minimum(a, b, is_free);
            const double share = allowed_share(x, to, is_free);
            if (share == 1) {
                x = to;
                break;
            }
            for (Eigen::Index j = 0; j < b.size(); ++j) {
                const double reached = x[j] + share * (to[j] - x[j]);
                if (is_free[j] && to[j] <= 0 && reached <= 1e-14 * x[j]) is_free[j] = false;
                x[j] = is_free[j] ? reached : 0;
            }
        }
    }
    return x;
}

CostVector fitted_costs(const NormalEquations& sums) {
    // This is so small that it changes no cost, unless noise hides the difference between two
    // columns.
    constexpr double draw = 1e-6;
    const CostVector lengths = sums.squares.diagonal().cwiseMax(0).cwiseSqrt();
    CostVector scales = lengths;
    for (double& scale : scales) scale = scale > 0 ? 1 / scale : 0;
    CostMatrix a = scales.asDiagonal() * sums.squares * scales.asDiagonal();
    CostVector b = scales.cwiseProduct(sums.products);
    b[0] += draw * b[0];
    a.diagonal().setConstant(1 + draw);
    return scales.cwiseProduct(nonnegative_minimum(a, b));
}

}  // namespace rrcb
