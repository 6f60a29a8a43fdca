// Costs by non-negative least squares: worked by hand, in long double, and over all active sets.
#include "controller/nonnegative_fit.hpp"

#include "../support/common.hpp"

#include <Eigen/Dense>

namespace rrcb {
namespace {

CostVector vector_of(std::initializer_list<double> values) {
    CostVector vector(values.size());
    std::copy(values.begin(), values.end(), vector.begin());
    return vector;
}

Eigen::VectorXd in_eigen(const CostVector& vector) {
    return Eigen::Map<const Eigen::VectorXd>(vector.begin(), std::ssize(vector));
}

Eigen::VectorXd minimum(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
    const auto size = static_cast<std::size_t>(b.size());
    CostMatrix matrix(size);
    std::copy_n(a.data(), a.size(), matrix.numbers().begin());
    CostVector vector(size);
    std::copy_n(b.data(), b.size(), vector.begin());
    return in_eigen(nonnegative_minimum(matrix, vector));
}

void add(const CostVector& columns, double seconds, NormalEquations& sums) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
        sums.products[i] += columns[i] * seconds;
        for (std::size_t j = 0; j < columns.size(); ++j)
            sums.squares(i, j) += columns[i] * columns[j];
    }
}

/// x'Ax / 2 - b'x
double sum_at(const Eigen::VectorXd& x, const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
    return 0.5 * x.dot(a * x) - b.dot(x);
}

/// Least sum over all choices of columns that are not 0.
double least_sum(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
    double least = 0;
    for (unsigned chosen = 1; chosen < 1U << b.size(); ++chosen) {
        std::vector<Eigen::Index> columns;
        for (Eigen::Index j = 0; j < b.size(); ++j)
            if ((chosen >> j & 1U) != 0) columns.push_back(j);
        const Eigen::VectorXd part =
            Eigen::MatrixXd(a(columns, columns)).fullPivLu().solve(Eigen::VectorXd(b(columns)));
        if (part.minCoeff() < 0) continue;
        Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
        for (std::size_t k = 0; k < columns.size(); ++k)
            x[columns[k]] = part[static_cast<Eigen::Index>(k)];
        least = std::min(least, sum_at(x, a, b));
    }
    return least;
}

// Two unknowns: 2x + y = 3, x + 2y = 0 has y = -1, so y is 0 and x = 3/2.
TEST(NonnegativeMinimum, holds_at_zero_what_would_be_negative) {
    Eigen::Matrix2d a;
    a << 2, 1, 1, 2;
    using Pair = Eigen::Vector2d;
    EXPECT_TRUE(minimum(a, Pair(3, 3)).isApprox(Pair(1, 1), 1e-14));
    EXPECT_TRUE(minimum(a, Pair(3, 0)).isApprox(Pair(1.5, 0), 1e-14));
    EXPECT_EQ(minimum(a, Pair(-1, -2)), Pair(0, 0));
}

TEST(NonnegativeMinimum, is_the_best_of_all_active_sets) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 2000; ++trial) {
        const Eigen::Index size = 1 + trial % 7;
        // Some with fewer rows than columns, made definite by little.
        const Eigen::MatrixXd rows = Eigen::MatrixXd::NullaryExpr(
            1 + trial % 11, size, [&] { return normal(random) + (trial % 2 == 0 ? 1 : 0); });
        const Eigen::VectorXd right =
            Eigen::VectorXd::NullaryExpr(rows.rows(), [&] { return normal(random); });
        Eigen::MatrixXd a = rows.transpose() * rows;
        a.diagonal().array() += 1e-6;
        const Eigen::VectorXd b = rows.transpose() * right;
        const Eigen::VectorXd x = minimum(a, b);
        EXPECT_GE(x.minCoeff(), 0);
        EXPECT_LE(sum_at(x, a, b), least_sum(a, b) + 1e-9) << trial;
    }
}

// Ranks of 10 points and 4 cells, 20 and 1, 15 and 8; a point costs 2, a cell 5.
TEST(FittedCosts, finds_costs_that_explain_all) {
    NormalEquations sums(2);
    for (const auto& [points, cells] : {std::pair(10.0, 4.0), {20.0, 1.0}, {15.0, 8.0}})
        add(vector_of({points, cells}), 2 * points + 5 * cells, sums);
    const CostVector costs = fitted_costs(sums);
    EXPECT_NEAR(costs[0], 2, 1e-4);
    EXPECT_NEAR(costs[1], 5, 1e-4);
}

TEST(FittedCosts, counts_what_the_columns_leave_open) {
    NormalEquations none(3);
    EXPECT_EQ(in_eigen(fitted_costs(none)), Eigen::Vector3d(0, 0, 0));
    // The second column repeats the first, the third is 0: all goes to the first.
    NormalEquations repeated(3);
    for (const double points : {10.0, 30.0})
        add(vector_of({points, points, 0}), 2 * points, repeated);
    const CostVector costs = fitted_costs(repeated);
    EXPECT_NEAR(costs[0], 2, 1e-9);
    EXPECT_NEAR(costs[1], 0, 1e-9);
    EXPECT_EQ(costs[2], 0);
}

// Columns of sizes that differ by ten powers of ten, solved again with 64 bits of mantissa.
TEST(FittedCosts, agrees_with_long_double) {
    using Vector = Eigen::Matrix<long double, 3, 1>;
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> flat(0.5, 1.5);
    for (int trial = 0; trial < 100; ++trial) {
        NormalEquations sums(3);
        Eigen::Matrix<long double, 3, 3> squares = decltype(squares)::Zero();
        Vector products = Vector::Zero();
        for (int row = 0; row < 40; ++row) {
            const CostVector columns =
                vector_of({1e6 * flat(random), 1e2 * flat(random), 1e-4 * flat(random)});
            const double seconds =
                in_eigen(columns).dot(Eigen::Vector3d(1e-6, 1e-2, 1e4)) * flat(random);
            add(columns, seconds, sums);
            const Vector exact = in_eigen(columns).cast<long double>();
            squares += exact * exact.transpose();
            products += exact * static_cast<long double>(seconds);
        }
        // The same draw to counting, a millionth of each column's square.
        for (int j = 0; j < 3; ++j) squares(j, j) *= 1 + 1e-6L;
        products(0) *= 1 + 1e-6L;
        const Vector exact = squares.inverse() * products;
        if (exact.minCoeff() <= 0) continue;
        const CostVector costs = fitted_costs(sums);
        for (int j = 0; j < 3; ++j)
            EXPECT_NEAR(in_eigen(costs)(j) / static_cast<double>(exact(j)), 1, 1e-9);
    }
}

}  // namespace
}  // namespace rrcb
