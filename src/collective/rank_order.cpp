#include "collective/rank_order.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace rrcb {

namespace {

constexpr int digit_bits = 10;
constexpr int num_digits = 1 << digit_bits;

}  // namespace

RankOrder::RankOrder(std::span<const int> ranks, int num_ranks)
    : ranks_(ranks), next_(static_cast<std::size_t>(std::min(num_ranks, num_digits))) {
    if (num_ranks <= num_digits) {
        count_each();
    } else {
        sort_by_digits(num_ranks);
    }
}

void RankOrder::count_each() {
    for (const int rank : ranks_) ++next_[rank];
    for (int rank = 0; rank < std::ssize(next_); ++rank)
        if (const LocalIndex count = next_[rank]; count > 0) counts_.push_back({rank, count});
    std::exclusive_scan(next_.begin(), next_.end(), next_.begin(), LocalIndex{0});
}

/// Sorts by the digits of the ranks, the lowest digit first. Entries with equal digits keep their
/// order.
void RankOrder::sort_by_digits(int num_ranks) {
    order_.resize(ranks_.size());
    std::iota(order_.begin(), order_.end(), LocalIndex{0});
    std::vector<LocalIndex> sorted(ranks_.size());
    int shift = 0;
    for (int largest = num_ranks - 1; largest > 0; largest >>= digit_bits, shift += digit_bits) {
        const auto digit_of = [&](LocalIndex k) {
            return static_cast<std::size_t>((ranks_[k] >> shift) % num_digits);
        };
        std::ranges::fill(next_, 0);
        for (const LocalIndex k : order_) ++next_[digit_of(k)];
        std::exclusive_scan(next_.begin(), next_.end(), next_.begin(), LocalIndex{0});
        for (const LocalIndex k : order_) sorted[next_[digit_of(k)]++] = k;
        std::swap(order_, sorted);
    }
    for (const LocalIndex k : order_) {
        if (counts_.empty() || counts_.back().rank != ranks_[k]) counts_.push_back({ranks_[k], 0});
        ++counts_.back().count;
    }
}

std::vector<RankCount> count_ascending(std::span<const int> ranks) {
    std::vector<RankCount> counts;
    for (auto begin = ranks.begin(); begin != ranks.end();) {
        const auto end = std::upper_bound(begin, ranks.end(), *begin);
        counts.push_back({*begin, static_cast<LocalIndex>(end - begin)});
        begin = end;
    }
    return counts;
}

}  // namespace rrcb
