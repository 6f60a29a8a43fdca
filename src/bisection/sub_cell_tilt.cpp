#include "bisection/sub_cell_tilt.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace rrcb {

namespace {

constexpr double width = 1.0 / num_sub;
constexpr double variance_within = width * width / 12;

using Four = Eigen::Vector4d;
using Statistics = Eigen::Matrix<double, num_sub * num_sub, 4>;

constexpr double centre_of(int sub_cell) {
    return (sub_cell + 0.5) * width - 0.5;
}

/// Deviations of x, y, x^2, y^2 where all is even: all four become about 1.
const Four& scale() {
    static const Four scale(std::sqrt(1.0 / 12), std::sqrt(1.0 / 12), std::sqrt(1.0 / 180),
                            std::sqrt(1.0 / 180));
    return scale;
}

/// x, y, x^2, y^2 at the centre of each sub-cell, scaled.
const Statistics& statistics() {
    static const Statistics all = [] {
        Statistics values;
        for (int k = 0; k < num_sub * num_sub; ++k) {
            const double x = centre_of(k / num_sub);
            const double y = centre_of(k % num_sub);
            values.row(k) = Four(x, y, x * x, y * y).cwiseQuotient(scale()).transpose();
        }
        return values;
    }();
    return all;
}

/// Whether weights on the centres have this mean and mean square, with some room: the tilt grows
/// beyond bounds towards the ends.
bool is_reachable(double mean, double square) {
    constexpr double room = 0.004;
    constexpr double room_of_mean = 0.01;
    constexpr double last = centre_of(num_sub - 1);
    if (!(std::abs(mean) < last - room_of_mean)) return false;
    const int below =
        std::clamp(static_cast<int>(std::floor((mean + last) * num_sub)), 0, num_sub - 2);
    const double chord =
        (centre_of(below) + centre_of(below + 1)) * mean - centre_of(below) * centre_of(below + 1);
    return square > chord + room && square < last * last - room;
}

/// The function to minimise, log sum exp(prior + c . statistics) - c . aim, at some c, and its
/// gradient.
struct State {
    double value = 0;
    SubCells shares;
    Four gradient;
};

State state_at(const SubCells& prior, const Four& aim, const Four& c) {
    State state;
    const SubCells exponents = prior + statistics() * c;
    const double largest = exponents.maxCoeff();
    state.shares = (exponents.array() - largest).exp();
    const double sum = state.shares.sum();
    state.shares /= sum;
    state.value = largest + std::log(sum) - c.dot(aim);
    state.gradient = statistics().transpose() * state.shares - aim;
    return state;
}

Four newton_step(const State& state, const Four& aim) {
    constexpr double against_singularity = 1e-9;
    const Four means = state.gradient + aim;
    Eigen::Matrix4d second = statistics().transpose() * state.shares.asDiagonal() * statistics() -
                             means * means.transpose();
    second.diagonal().array() += against_singularity;
    return second.ldlt().solve(state.gradient);
}

}  // namespace

std::optional<SubCells> tilted(const SubCells& prior, const CellSpread& spread) {
    constexpr double exact = 1e-14;
    constexpr double good_enough = 1e-11;
    constexpr int most_steps = 40;
    Four aim;
    for (int a = 0; a < 2; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        const double mean = spread.mean[axis];
        const double square =
            spread.deviation[axis] * spread.deviation[axis] + mean * mean - variance_within;
        if (!is_reachable(mean, square)) return std::nullopt;
        aim[a] = mean;
        aim[a + 2] = square;
    }
    aim = aim.cwiseQuotient(scale());
    Four c = Four::Zero();
    State state = state_at(prior, aim, c);
    double length = 1;
    // The value never grows, and it is concave upwards, so that short steps lower it.
    for (int k = 0; k < most_steps && state.gradient.cwiseAbs().maxCoeff() > exact; ++k) {
        const Four next_c = c - length * newton_step(state, aim);
        const State next = state_at(prior, aim, next_c);
        const bool is_better = next.value <= state.value + good_enough;
        if (is_better) {
            c = next_c;
            state = next;
        }
        length = is_better ? std::min(1.0, 2 * length) : length / 4;
    }
    if (!(state.gradient.cwiseAbs().maxCoeff() <= good_enough)) return std::nullopt;
    return state.shares;
}

}  // namespace rrcb
