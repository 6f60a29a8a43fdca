#pragma once

#include <rrcb/points.hpp>

#include <algorithm>
#include <vector>

namespace rrcb {

/// One sum per bin, over entries that come in any order of the bins; the same bits for the same
/// entries. `Sum` starts at zero and has +=.
///
/// Neighbours in memory often go to the same bin: a few sums for each, the lanes, let an entry go
/// on without the one before. Lanes are emptied into the totals now and then, as one long running
/// sum would lose a digit for every tenfold of the entries.
template <class Sum>
class LaneSums {
  public:
    explicit LaneSums(std::size_t num_bins)
        : shift_(num_bins <= most_bins_with_lanes ? 2 : 0),
          lanes_(num_bins << shift_),
          totals_(num_bins) {}

    /// How many entries to add before the lanes are emptied.
    LocalIndex interval() const { return std::max<LocalIndex>(4096, 16 * lanes_.size()); }

    /// The sum that entry `i` of a bin goes to.
    Sum& of(std::size_t bin, LocalIndex i) {
        return lanes_[(bin << shift_) + (i & ((std::size_t{1} << shift_) - 1))];
    }

    void empty_lanes() {
        for (std::size_t k = 0; k < lanes_.size(); ++k) {
            totals_[k >> shift_] += lanes_[k];
            lanes_[k] = Sum{};
        }
    }

    /// Of all entries whose lanes have been emptied.
    const std::vector<Sum>& totals() const { return totals_; }

  private:
    static constexpr std::size_t most_bins_with_lanes = 512;  // which the cache holds

    unsigned shift_;
    std::vector<Sum> lanes_;
    std::vector<Sum> totals_;
};

/// Calls `step(first, last)` for consecutive ranges of at most `length` of `count` entries.
template <class Step>
void in_ranges(LocalIndex count, LocalIndex length, Step&& step) {
    for (LocalIndex first = 0; first < count; first += length)
        step(first, std::min(first + length, count));
}

}  // namespace rrcb
