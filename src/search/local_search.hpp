#pragma once

#include "search/cut_search.hpp"
#include "search/fragments.hpp"

#include <span>
#include <vector>

namespace rrcb {

/// One rank's part in the search for one cut.
class LocalSearch {
  public:
    /// `fragments` and `points` are borrowed and must not change during the search.
    LocalSearch(std::span<const Fragment> fragments, const SortedPoints& points)
        : fragments_(fragments), points_(points) {}

    /// Adds the points of this rank to `histogram` (length layout.length()): weights in multiples
    /// of the quantum of the search, counts and extents.
    void count(const CutSearch& search, const HistogramLayout& layout,
               std::span<double> histogram) const;

    /// Keeps the points in the slot that the root chose for the search as it was `before`.
    void keep_chosen(const CutSearch& before, const CutSearch& after,
                     const HistogramLayout& layout);

    /// Adds position and weight of each candidate.
    void append_candidates(std::vector<double>& records) const;

  private:
    void count_fragments(const CutSearch& search, const HistogramLayout& layout,
                         std::span<double> histogram) const;

    std::span<const Fragment> fragments_;
    const SortedPoints& points_;
    std::vector<LocalIndex> candidates_;
};

}  // namespace rrcb
