#include <mpm/decomposition.hpp>

#include <algorithm>
#include <limits>

namespace mpm {

namespace {

std::vector<double> equal_cuts(double lower, double upper, int num_slabs) {
    std::vector<double> cuts;
    for (int k = 1; k < num_slabs; ++k)
        cuts.push_back(lower + (upper - lower) * (static_cast<double>(k) / num_slabs));
    return cuts;
}

std::size_t longest_axis(const Box& extent) {
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
        if (extent.upper[axis] - extent.lower[axis] > extent.upper[longest] - extent.lower[longest])
            longest = axis;
    return longest;
}

std::span<const double> column(const Positions& positions, std::size_t axis) {
    return axis == 0 ? positions.x : axis == 1 ? positions.y : positions.z;
}

}  // namespace

Decomposition slabs(const Box& extent, int num_ranks) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::size_t axis = longest_axis(extent);
    const std::vector<double> cuts = equal_cuts(extent.lower[axis], extent.upper[axis], num_ranks);

    Decomposition decomposition;
    decomposition.boxes.assign(
        static_cast<std::size_t>(num_ranks),
        Box{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}});
    for (std::size_t k = 0; k < cuts.size(); ++k) {
        decomposition.boxes[k].upper[axis] = cuts[k];
        decomposition.boxes[k + 1].lower[axis] = cuts[k];
    }
    decomposition.owners = [axis, cuts](Positions positions, std::span<int> owners) {
        const std::span<const double> along = column(positions, axis);
        for (std::size_t i = 0; i < along.size(); ++i)
            owners[i] = static_cast<int>(std::ranges::upper_bound(cuts, along[i]) - cuts.begin());
    };
    return decomposition;
}

}  // namespace mpm
