#include "controller/load_window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rrcb {

namespace {

/// Rank of the order statistic that lies below the median of `count` independent values in 96 % of
/// all cases or more, from 5 values on; the smallest where there is none.
///
/// Those below the median are binomially distributed, count / 2 +- sqrt(count) / 2.
std::size_t rank_below_median(std::size_t count) {
    const auto n = static_cast<double>(count);
    return static_cast<std::size_t>(std::max(0.0, n / 2 - 0.9 * std::sqrt(n)));
}

}  // namespace

double median(const std::array<double, 3>& values, std::size_t count) {
    const auto [a, b, c] = values;
    if (count == 1) return a;
    if (count == 2) return std::min(a, b);
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

void LoadWindow::add(double excess, double mean) {
    excess_[count_ % longest] = excess;
    mean_[count_ % longest] = mean;
    ++count_;
}

double LoadWindow::lower_bound() const {
    double bound = -std::numeric_limits<double>::infinity();
    // A short window follows a jump, a long one sees growth in spite of noise.
    for (std::size_t length = 3; length <= std::min(count_, longest); length *= 2)
        bound = std::max(bound, order_statistic(length, rank_below_median(length)));
    return bound;
}

double LoadWindow::upper_bound() const {
    constexpr std::size_t length = 12;
    if (count_ < length) return std::numeric_limits<double>::infinity();
    return order_statistic(length, length - 1 - rank_below_median(length));
}

double LoadWindow::order_statistic(std::size_t length, std::size_t rank) const {
    Values last{};
    for (std::size_t ago = 0; ago < length; ++ago) last[ago] = latest(excess_, ago);
    const auto place = last.begin() + rank;
    std::nth_element(last.begin(), place, last.begin() + length);
    return *place;
}

}  // namespace rrcb
