#pragma once

#include "../support/common.hpp"
#include "passes/histogram.hpp"
#include "search/cut_search.hpp"

namespace rrcb::test {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr HistogramLayout layout{4};  // six slots

/// A histogram with these weights and as many points in each slot, without extents.
inline std::vector<double> histogram_of(std::vector<double> weights, double count) {
    std::vector<double> histogram(layout.length());
    clear_histogram(histogram);
    weights.resize(layout.num_slots());
    std::copy(weights.begin(), weights.end(), histogram.begin() + layout.num_extents);
    std::fill_n(histogram.end() - static_cast<std::ptrdiff_t>(layout.num_slots()),
                layout.num_slots(), count);
    return histogram;
}

/// In the bracket [0, 4) of axis 0: four bins of width one.
inline CutSearch search_in(CutSearch::Stage stage, std::int32_t num_axes = 1) {
    CutSearch search;
    search.stage = stage;
    search.num_axes = num_axes;
    search.cut.at.fill(-infinity);
    search.upper = 4;
    return search;
}

inline CutTarget target_of(double weight, double slack = 0, double weight_before = 0) {
    CutTarget target;
    target.target = weight;
    target.slack = slack;
    target.weight_before = weight_before;
    return target;
}

}  // namespace rrcb::test
