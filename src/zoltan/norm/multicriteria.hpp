#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rrcb::zoltan {

/// Further weights of an object are ignored, as in Zoltan.
inline constexpr int most_weights = 4;

/// Weights of some objects, each in whole units of its own, and at the end how many they are. Sums
/// of whole numbers are the same bits in whatever order they are made.
using Load = std::array<std::int64_t, most_weights + 1>;

/// One factor per entry of a load.
using Factors = std::array<double, most_weights + 1>;

Load operator+(const Load& a, const Load& b);
Load operator-(const Load& a, const Load& b);

/// Several weights per object, and how they are to be balanced (RCB_MULTICRITERIA_NORM).
struct Criteria {
    int norm = 1;
    std::span<const float> weights;  ///< of all objects, one after another; finite, not negative
    std::size_t stride = 1;   ///< weights of an object; those beyond most_weights are ignored
    bool comparable = false;  ///< not divided by their totals
    /// Sizes of the parts of the second weight and so on, empty: equal; the first's are the
    /// options'.
    std::span<const std::vector<double>> further_sizes{};
    double max_aspect_ratio = 10;  ///< axes shorter than the longest by more are not cut
};

/// What a cut of objects with several weights aims at: that the norms of the loads on its two
/// sides, each weight over the side's share of it, are the same.
struct Aim {
    int norm = 1;     ///< 1: sum of the weights, 2: Euclidean, otherwise: the largest
    Factors below{};  ///< of the loads below the cut
    Factors above{};
    Load all{};  ///< on both sides together
};

double norm_below(const Aim& aim, const Load& below);
double norm_above(const Aim& aim, const Load& below);

/// The larger of the two norms: falls while the cut moves up to where they meet, then rises.
double larger_norm(const Aim& aim, const Load& below);

/// Norm of the larger side of each weight, by which cuts across different axes are compared.
double quality(const Aim& aim, const Load& below);

/// The aim of a node of the tree.
///
/// `values` is what a unit of each weight counts, `shares` the share of each that belongs below.
/// A node without any weight is divided by the number of its objects.
Aim aim_of(int norm, const Factors& values, const std::array<double, most_weights>& shares,
           const Load& all);

/// Where the norms meet: index of the first of `slots`, the loads from `base` upwards, at whose end
/// no less lies below than above. Adds the loads before it to `base`. The last slot ends the node.
std::size_t find_slot(const Aim& aim, std::span<const Load> slots, Load& base);

}  // namespace rrcb::zoltan
