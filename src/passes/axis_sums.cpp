#include "passes/axis_sums.hpp"

#include <cstddef>

namespace rrcb {

void add_along(int axis, const Bins& bins, const Collected& points,
               std::span<const LocalIndex> entries, bool is_weighted, std::span<double> sums) {
    const Bins of_axis = bins;  // a copy, which no sum can overlap
    const auto weights = sums.first(is_weighted ? sums.size() / 2 : 0);
    const auto counts = sums.subspan(weights.size());
    for (const LocalIndex i : entries) {
        const auto slot = static_cast<std::size_t>(of_axis.slot_of(points.coordinate(i, axis)));
        if (is_weighted) weights[slot] += points.weight(i);
        counts[slot] += 1;
    }
}

}  // namespace rrcb
