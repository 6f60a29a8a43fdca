#include "share.hpp"

#include <algorithm>
#include <numeric>

namespace rrcb::hard_test {

std::vector<int> owners_of(const Cloud& cloud, int count, Layout layout, int num_ranks) {
    std::vector<int> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    if (layout == Layout::sorted)
        std::ranges::stable_sort(order, {}, [&](int i) { return cloud.position(i); });
    std::vector<int> owners(order.size());
    for (int place = 0; place < count; ++place) {
        const int owner =
            layout == Layout::scattered ? place % num_ranks : place * num_ranks / count;
        owners[static_cast<std::size_t>(order[static_cast<std::size_t>(place)])] =
            cloud.on_last_rank ? num_ranks - 1 : owner;
    }
    return owners;
}

Share share_of(const Cloud& cloud, std::span<const int> owners, int rank) {
    Share share;
    share.dimension = cloud.dimension;
    for (std::size_t i = 0; i < owners.size(); ++i) {
        if (owners[i] != rank) continue;
        const int point = static_cast<int>(i);
        const Vector x = cloud.position(point);
        share.numbers.push_back(point);
        share.coordinates.insert(share.coordinates.end(), x.begin(), x.begin() + cloud.dimension);
        if (cloud.weight != nullptr) share.weights.push_back(cloud.weight(point));
    }
    return share;
}

}  // namespace rrcb::hard_test
