#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rrcb::zoltan {

/// Largest number of weights that count. Further ones of an object are ignored, as in Zoltan.
inline constexpr int most_weights = 4;

/// Weights of some objects, each in whole units of its own, and at the end the number of objects.
/// Sums of whole numbers have the same bits in any order.
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
    /// Sizes of the parts for the second weight and so on; empty: equal. The options have those for
    /// the first.
    std::span<const std::vector<double>> further_sizes{};
    double max_aspect_ratio = 10;  ///< axes shorter than the longest by more are not cut
};

/// Aim of a cut of objects with several weights: equal norms of the loads on its two sides, each
/// weight divided by the side's share of it.
struct Aim {
    int norm = 1;     ///< 1: sum of the weights, 2: Euclidean, otherwise: the largest
    Factors below{};  ///< of the loads below the cut
    Factors above{};
    Load all{};  ///< on both sides together
};

double norm_below(const Aim& aim, const Load& below);
double norm_above(const Aim& aim, const Load& below);

/// Larger of the two norms. While a cut moves up it falls until they meet, then rises.
double larger_norm(const Aim& aim, const Load& below);

/// Norm of the larger side of each weight. Cuts across different axes are compared by it.
double quality(const Aim& aim, const Load& below);

/// The aim of a node of the tree.
///
/// `values`: value of a unit of each weight. `shares`: share of each weight that belongs below. A
/// node without any weight is divided by the number of its objects.
Aim aim_of(int norm, const Factors& values, const std::array<double, most_weights>& shares,
           const Load& all);

/// Index of the slot where the norms meet: the first at whose end no less lies below than above.
///
/// `slots` are the loads from `base` upwards; the last one ends the node. Adds the loads before the
/// found slot to `base`.
std::size_t find_slot(const Aim& aim, std::span<const Load> slots, Load& base);

}  // namespace rrcb::zoltan
