#include <mpm/decomposition.hpp>

#include <algorithm>

namespace mpm {

namespace {

std::size_t longest_axis(const Box& extent) {
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
        if (extent.upper[axis] - extent.lower[axis] > extent.upper[longest] - extent.lower[longest])
            longest = axis;
    return longest;
}

}  // namespace

Decomposition within(const std::vector<Box>& boxes) {
    const auto look_up = [boxes](Positions at, std::span<int> owners) {
        for (std::size_t p = 0; p < owners.size(); ++p)
            owners[p] = static_cast<int>(
                std::ranges::find_if(boxes, [&](const Box& box) { return contains(box, at[p]); }) -
                boxes.begin());
    };
    return {boxes, look_up, {}};
}

Decomposition slabs(const Box& extent, int num_ranks) {
    const std::size_t axis = longest_axis(extent);
    const double lower = extent.lower[axis], width = extent.upper[axis] - lower;
    std::vector<Box> boxes(static_cast<std::size_t>(num_ranks), everywhere);
    for (std::size_t k = 1; k < boxes.size(); ++k)
        boxes[k].lower[axis] = boxes[k - 1].upper[axis] =
            lower + width * (static_cast<double>(k) / num_ranks);
    return within(boxes);
}

}  // namespace mpm
