#include "controller/nonnegative_fit.hpp"

#include <cmath>
#include <utility>

namespace rrcb {

namespace {

using Active = std::array<bool, most_cost_columns>;

/// Returns the minimum with all other columns than the free ones held at 0, by a Cholesky
/// decomposition. Rows and columns that are not free remain 0.
CostVector free_minimum(const CostMatrix& a, const CostVector& b, const Active& is_free) {
    const std::size_t size = b.size();
    CostMatrix lower(size);
    CostVector x(size);
    for (std::size_t i = 0; i < size; ++i) {
        if (!is_free[i]) continue;
        double square = a(i, i);
        x[i] = b[i];
        for (std::size_t j = 0; j < i; ++j) {
            if (!is_free[j]) continue;
            double product = a(i, j);
            for (std::size_t k = 0; k < j; ++k) product -= lower(i, k) * lower(j, k);
            lower(i, j) = product / lower(j, j);
            square -= lower(i, j) * lower(i, j);
            x[i] -= lower(i, j) * x[j];
        }
        lower(i, i) = std::sqrt(square);
        x[i] /= lower(i, i);
    }
    for (std::size_t i = size; i-- > 0;) {
        if (!is_free[i]) continue;
        for (std::size_t k = i + 1; k < size; ++k) x[i] -= lower(k, i) * x[k];
        x[i] /= lower(i, i);
    }
    return x;
}

/// Returns the share of the way from `from` to `to` on which no free number turns negative.
double allowed_share(const CostVector& from, const CostVector& to, const Active& is_free) {
    double share = 1;
    for (std::size_t j = 0; j < to.size(); ++j)
        if (is_free[j] && to[j] <= 0) share = std::min(share, from[j] / (from[j] - to[j]));
    return share;
}

/// Returns the column whose number lowers the sum fastest if it grows, and how fast.
std::pair<std::size_t, double> steepest(const CostMatrix& a, const CostVector& b,
                                        const CostVector& x, const Active& is_free) {
    std::pair<std::size_t, double> found{0, -1};
    for (std::size_t i = 0; i < x.size(); ++i) {
        double descent = b[i];
        for (std::size_t j = 0; j < x.size(); ++j) descent -= a(i, j) * x[j];
        if (!is_free[i] && descent > found.second) found = {i, descent};
    }
    return found;
}

}  // namespace

CostVector nonnegative_minimum(const CostMatrix& a, const CostVector& b) {
    CostVector x(b.size());
    Active is_free{};
    double largest = 0;
    for (const double product : b) largest = std::max(largest, std::abs(product));
    // Each turn of the outer loop lowers the sum, so none repeats, except by round-off.
    for (std::size_t turn = 0; turn < 4 * b.size(); ++turn) {
        const auto [next, descent] = steepest(a, b, x, is_free);
        if (descent <= 1e-14 * largest) break;
        is_free[next] = true;
        // x >= 0 throughout: each turn reaches the minimum, or fixes a column at 0 on the way.
        for (;;) {
            const CostVector to = free_minimum(a, b, is_free);
            const double share = allowed_share(x, to, is_free);
            if (share == 1) {
                x = to;
                break;
            }
            for (std::size_t j = 0; j < b.size(); ++j) {
                const double reached = x[j] + share * (to[j] - x[j]);
                if (is_free[j] && to[j] <= 0 && reached <= 1e-14 * x[j]) is_free[j] = false;
                x[j] = is_free[j] ? reached : 0;
            }
        }
    }
    return x;
}

CostVector fitted_costs(const NormalEquations& sums) {
    // So small that it changes no cost, unless noise hides the difference of two columns.
    constexpr double draw = 1e-6;
    const std::size_t size = sums.products.size();
    CostVector scales(size);
    for (std::size_t j = 0; j < size; ++j) {
        const double square = sums.squares(j, j);
        scales[j] = square > 0 ? 1 / std::sqrt(square) : 0;
    }
    CostMatrix a(size);
    CostVector b(size);
    for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t j = 0; j < size; ++j)
            a(i, j) = i == j ? 1 + draw : scales[i] * sums.squares(i, j) * scales[j];
        b[i] = scales[i] * sums.products[i];
    }
    b[0] += draw * b[0];
    CostVector costs = nonnegative_minimum(a, b);
    for (std::size_t j = 0; j < size; ++j) costs[j] *= scales[j];
    return costs;
}

}  // namespace rrcb
