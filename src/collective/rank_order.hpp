#pragma once

#include <rrcb/plan.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace rrcb {

/// The order of entries by their ranks; entries of one rank keep their order.
///
/// Uses radix sort, in time proportional to the number of entries. Memory: at most 8 kB for up to
/// 1024 ranks; for more ranks 16 bytes an entry during the sort, and 8 bytes afterwards.
class RankOrder {
  public:
    /// Sorts `ranks`, which are at least 0 and less than `num_ranks`, and which must outlive this
    /// object. Throws std::bad_alloc.
    RankOrder(std::span<const int> ranks, int num_ranks);

    /// Returns how often each rank occurs, in ascending order, without ranks that do not occur.
    const std::vector<RankCount>& counts() const { return counts_; }

    /// Calls visit(k, place) for each entry k and its place in the order. May be called only once.
    template <class Visit>
    void for_each(Visit&& visit) {
        for (std::size_t place = 0; place < order_.size(); ++place) visit(order_[place], place);
        if (!order_.empty()) return;
        // This copy lets the compiler assume that visits do not change the span.
        const std::span<const int> ranks = ranks_;
        LocalIndex* const next = next_.data();
        for (std::size_t k = 0; k < ranks.size(); ++k) visit(k, next[ranks[k]]++);
    }

  private:
    void count_each();
    void sort_by_digits(int num_ranks);

    std::span<const int> ranks_;
    std::vector<LocalIndex> next_;   ///< place of the next entry with each digit
    std::vector<LocalIndex> order_;  ///< empty if ranks have a single digit
    std::vector<RankCount> counts_;
};

/// Returns how often each rank occurs in an ascending list. The time is proportional to the number
/// of different ranks, times the logarithm of the length of the list. Throws std::bad_alloc.
std::vector<RankCount> count_ascending(std::span<const int> ranks);

}  // namespace rrcb
