#pragma once

#include <rrcb/points.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace rrcb {

/// Adds up one sum per bin; entries may come in any order of the bins. The same entries in the same
/// order give bit-identical sums. `Sum` starts at zero and has +=. Running sums may have a type
/// `Running` derived from it; empty() keeps the additional members.
///
/// A single running sum over many entries would lose a digit of accuracy with every factor of ten
/// in their number. The running sums are therefore emptied into intermediate sums from time to
/// time, and those into the totals less often.
template <class Sum, class Running = Sum>
class RunningSums {
  public:
    explicit RunningSums(std::size_t num_bins)
        : running_(num_bins), emptied_(num_bins), totals_(num_bins) {}

    /// Returns the number of entries to add between calls of empty().
    LocalIndex interval() const { return std::max<LocalIndex>(128, 8 * running_.size()); }

    Running& operator[](std::size_t bin) { return running_[bin]; }

    void empty() {
        constexpr std::size_t most_emptied = 64;
        pour(running_, emptied_);
        if (++num_emptied_ == most_emptied) totals();
    }

    /// Returns the sums of all entries added before the last empty(). A repeated call costs
    /// nothing.
    const std::vector<Sum>& totals() {
        if (std::exchange(num_emptied_, 0) > 0) pour(emptied_, totals_);
        return totals_;
    }

  private:
    static void pour(auto& from, std::vector<Sum>& into) {
        for (std::size_t k = 0; k < from.size(); ++k) {
            Sum& sum = from[k];
            into[k] += sum;
            sum = Sum{};
        }
    }

    std::vector<Running> running_;
    std::vector<Sum> emptied_;
    std::size_t num_emptied_ = 0;  ///< calls of empty() since the totals were last updated
    std::vector<Sum> totals_;
};

/// Calls `step(first, last)` for consecutive ranges of at most `length` of `count` entries.
template <class Step>
void in_ranges(LocalIndex count, LocalIndex length, Step&& step) {
    for (LocalIndex first = 0; first < count; first += length)
        step(first, std::min(first + length, count));
}

}  // namespace rrcb
