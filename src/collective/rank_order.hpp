#pragma once

#include <rrcb/plan.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace rrcb {

/// The order of entries by their ranks; entries of one rank keep their order.
///
/// By radix sort, in time proportional to the entries. Memory: at most 8 kB up to 1024 ranks;
/// beyond that 16 bytes an entry while it is made and 8 later.
class RankOrder {
  public:
    /// `ranks` are below `num_ranks`, not negative, and outlive it. Throws std::bad_alloc.
    RankOrder(std::span<const int> ranks, int num_ranks);

    /// Returns how often each rank occurs, ascending, without those that do not.
    const std::vector<RankCount>& counts() const { return counts_; }

    /// Calls visit(k, place) for each entry k and its place in the order. Call it once.
    template <class Visit>
    void for_each(Visit&& visit) {
        for (std::size_t place = 0; place < order_.size(); ++place) visit(order_[place], place);
        if (!order_.empty()) return;
        // A copy, so that the compiler knows that visits do not change it.
        const std::span<const int> ranks = ranks_;
        LocalIndex* const next = next_.data();
        for (std::size_t k = 0; k < ranks.size(); ++k) visit(k, next[ranks[k]]++);
    }

  private:
    void count_each();
    void sort_by_digits(int num_ranks);

    std::span<const int> ranks_;
    std::vector<LocalIndex> next_;   ///< place of each digit's next entry
    std::vector<LocalIndex> order_;  ///< empty if ranks have a single digit
    std::vector<RankCount> counts_;
};

/// Returns how often each rank occurs in an ascending list. The time is proportional to the ranks
/// in it, times the logarithm of its length. Throws std::bad_alloc.
std::vector<RankCount> count_ascending(std::span<const int> ranks);

}  // namespace rrcb
