#include "contribution.hpp"

#include <rrcb/error.hpp>

#include <cmath>
#include <numeric>
#include <string>

namespace rrcb {

namespace {

[[noreturn]] void reject(const std::string& what) {
    throw Error(ErrorCode::invalid_argument, what);
}

void require(bool condition, const char* what) {
    if (!condition) reject(what);
}

void check_part_sizes(std::span<const double> sizes, int num_parts) {
    require(sizes.size() == static_cast<std::size_t>(num_parts),
            "part_sizes must hold one entry per part, or none for equal parts");
    double sum = 0;
    for (const double size : sizes) {
        require(std::isfinite(size) && size >= 0, "part_sizes must be finite and not negative");
        sum += size;
    }
    require(sum > 0 && std::isfinite(sum), "part_sizes must have a positive, finite sum");
}

void check_lengths(const Points& points) {
    const auto dimension = static_cast<std::size_t>(points.dimension);
    require(points.stride == 1 || points.stride == dimension,
            "points must be interleaved or one array per axis");
    for (std::size_t a = 0; a < dimension && points.count > 0; ++a) {
        const std::size_t expected =
            points.stride == 1 ? points.count : points.count * dimension - a;
        require(points.axes[a].size() == expected,
                points.stride == 1
                    ? "coordinate arrays must all have the same length"
                    : "the length of the coordinate array must be a multiple of the dimension");
    }
    require(points.count > 0 || points.axes[0].empty(),
            "the length of the coordinate array must be a multiple of the dimension");
    require(points.weights.empty() || points.weights.size() == points.count,
            "weights must hold one entry per point, or none for unit weights");
}

std::string tally(std::size_t bad) {
    return " (" + std::to_string(bad) + (bad == 1 ? " such value" : " such values") +
           " on this rank)";
}

void check_coordinates(const Points& points) {
    std::size_t bad = 0;
    for (int axis = 0; axis < points.dimension; ++axis) {
        const double* x = points.axes[static_cast<std::size_t>(axis)].data();
        // x - x is 0 exactly for finite x; counting keeps the loop free of branches.
        for (LocalIndex i = 0; i < points.count; ++i)
            bad += !(x[i * points.stride] - x[i * points.stride] == 0);
    }
    if (bad == 0) return;
    for (LocalIndex i = 0; i < points.count; ++i)
        for (int axis = 0; axis < points.dimension; ++axis)
            if (!std::isfinite(points.coordinate(i, axis)))
                reject("coordinate of object " + std::to_string(i) + " on axis " +
                       std::to_string(axis) + " is NaN or infinite" + tally(bad));
}

void check_weights(const Points& points) {
    std::size_t bad = 0;
    double sum = 0;
    for (const double weight : points.weights) {
        bad += !(weight >= 0 && weight - weight == 0);
        sum += weight;
    }
    if (bad == 0 && std::isfinite(sum)) return;
    for (LocalIndex i = 0; i < points.weights.size(); ++i)
        if (!(points.weights[i] >= 0 && std::isfinite(points.weights[i])))
            reject("weight of object " + std::to_string(i) + " is negative, NaN or infinite" +
                   tally(bad));
    reject("the sum of the weights overflows; scale them down");
}

}  // namespace

void check_options(const Options& options, int dimension) {
    const int most_cells = dimension < 3 ? 4096 : 256;
    require(options.num_parts > 0, "num_parts must be positive, or 0 for one part per rank");
    check_part_sizes(options.part_sizes, options.num_parts);
    if (options.support_mesh < 0 || options.support_mesh > most_cells)
        reject("support_mesh must be 1 ... " + std::to_string(most_cells) +
               " cells per axis, or 0 for the default");
    require(options.imbalance_tolerance >= 1, "imbalance_tolerance must be at least 1");
    require(options.sigma_multiplier >= 0 && std::isfinite(options.sigma_multiplier),
            "sigma_multiplier must be finite and not negative");
    require(options.sample_fraction > 0 && options.sample_fraction <= 1,
            "sample_fraction must be in (0, 1]");
}

void check_points(const Points& points) {
    require(points.dimension >= 1 && points.dimension <= max_dimension,
            "points must have 1, 2 or 3 dimensions, also on a rank without points");
    check_lengths(points);
    check_coordinates(points);
    check_weights(points);
}

}  // namespace rrcb
