#include "bisection/patches.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"
#include "paper/point_selection.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace rrcb {

namespace {

/// Shares `total` items in proportion to the weights, by the method of largest remainders. Of equal
/// remainders the earlier one comes first.
std::vector<GlobalCount> apportion(std::span<const double> weights, GlobalCount total) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<GlobalCount> shares;
    std::vector<double> remainders;
    for (const double weight : weights) {
        const double quota = static_cast<double>(total) * (weight / sum);
        shares.push_back(static_cast<GlobalCount>(quota));
        remainders.push_back(quota - std::floor(quota));
    }
    std::vector<std::size_t> order(weights.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return remainders[i] > remainders[j]; });
    GlobalCount left = total - std::accumulate(shares.begin(), shares.end(), GlobalCount{0});
    for (std::size_t k = 0; left > 0; k = (k + 1) % order.size(), --left) ++shares[order[k]];
    return shares;
}

/// Returns a number in [0, 1) made of 53 bits of the engine. The standard's distributions are not
/// used, because they differ between libraries.
double uniform(std::mt19937_64& engine) {
    return static_cast<double>(engine() >> 11) * 0x1p-53;
}

/// Returns the box mean +- multiplier * deviation, limited to the largest double.
Box sampling_box(const Moments& moments, double multiplier) {
    constexpr double largest = std::numeric_limits<double>::max();
    Box box;
    for (std::size_t a = 0; a < max_dimension; ++a) {
        const double half_width = multiplier * moments.deviation[a];
        box.lower[a] = std::max(moments.mean[a] - half_width, -largest);
        box.upper[a] = std::min(moments.mean[a] + half_width, largest);
    }
    return box;
}

}  // namespace

void check_sampling(const PaperOptions& options) {
    require(options.sigma_multiplier > 0 && std::isfinite(options.sigma_multiplier),
            "sigma_multiplier must be finite and above 0");
    require(options.sample_fraction > 0 && std::isfinite(options.sample_fraction),
            "sample_fraction must be finite and above 0");
}

std::vector<MassPoint> sample_points(std::span<const CellMoments> cells, int dimension,
                                     const PaperOptions& options) {
    check_dimension(dimension, "the points");
    check_sampling(options);
    if (cells.empty()) return {};
    GlobalCount num_points = 0;
    for (const CellMoments& cell : cells) num_points += cell.moments.count;
    const auto num_samples =
        std::max(GlobalCount{1}, static_cast<GlobalCount>(std::llround(
                                     options.sample_fraction * static_cast<double>(num_points))));
    std::vector<MassPoint> points;
    const std::vector<GlobalCount> shares = locally([&] {
        points.reserve(num_samples);
        return apportion(weights_of(cells), num_samples);
    });
    std::mt19937_64 engine(options.seed);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Box box = sampling_box(cells[i].moments, options.sigma_multiplier);
        for (GlobalCount k = 0; k < shares[i]; ++k) {
            Vector x{};
            for (int a = 0; a < dimension; ++a)
                x[a] = std::lerp(box.lower[a], box.upper[a], uniform(engine));
            points.push_back({x, 1.0});
        }
    }
    return points;
}

std::vector<MassPoint> mass_points(const Points& points) {
    check_arrays(points);
    std::vector<MassPoint> masses;
    locally([&] { masses.reserve(points.count); });
    const bool weightless = std::ranges::all_of(points.weights, [](double w) { return w == 0; });
    for (LocalIndex i = 0; i < points.count; ++i)
        masses.push_back({points.position(i), weightless ? 1.0 : points.weight(i)});
    return masses;
}

}  // namespace rrcb
