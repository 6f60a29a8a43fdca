#pragma once

#include "fragments.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rrcb {

/// What every rank knows of the search for one cut; broadcast by the root after each round.
///
/// The cut lies in [lower, upper) of the axis number `tied` of its axes: its own first, then the
/// others in ascending order. Along the axes before that one it is already fixed in `cut`.
struct CutSearch {
    enum Stage : std::int32_t { over_fragments, over_candidates, gathering, done, abandoned };
    Stage stage = over_fragments;
    std::int32_t tied = 0;
    std::int32_t num_axes = 1;  ///< that may break ties, its own included
    Cut cut;
    double lower = 0;
    double upper = 0;
    std::int32_t chosen = 0;      ///< slot of the histogram that the search goes on in
    double below = 0;             ///< weight of the node below the cut, once done
    std::int32_t coincident = 0;  ///< 1: points that no cut tells apart hold the target, once done
};

/// What only the root knows of it.
struct CutTarget {
    double target = 0;               ///< weight that belongs below the cut
    double slack = 0;                ///< how far from it the weight below may be
    double base = 0;                 ///< weight of the node below `lower`
    GlobalCount num_candidates = 0;  ///< points of all ranks that are left, once gathering
};

/// Number of the axis a search works on.
int current_axis(const CutSearch& search);

/// Weights and counts along the bracket of one search, added up over the ranks.
///
/// Slot 0 is what lies below the bracket, the last slot what lies above it. A message is
/// num_extents entries of which the largest counts (minus the lower, then the upper ends of the
/// extent, then 1 where the rank has failed) and 2 * num_slots entries to be summed.
struct HistogramLayout {
    int num_bins = 64;

    std::size_t num_slots() const { return static_cast<std::size_t>(num_bins) + 2; }
    static constexpr std::size_t failed = 2 * max_dimension;
    static constexpr std::size_t num_extents = failed + 1;
    std::size_t length() const { return num_extents + 2 * num_slots(); }
};

/// Edge number k of the num_bins + 1 edges of a bracket.
double bin_edge(const CutSearch& search, int num_bins, int k);

/// Slot of a value: 0 below the bracket, num_bins + 1 above it.
std::int32_t slot_of(const CutSearch& search, int num_bins, double value);

/// One rank's part in the search for one cut.
class LocalSearch {
  public:
    /// `fragments` and `points` are borrowed and must not change during the search.
    LocalSearch(std::span<const Fragment> fragments, const SortedPoints& points)
        : fragments_(fragments), points_(points) {}

    /// Adds what this rank holds to `histogram` (length layout.length()).
    void count(const CutSearch& search, const HistogramLayout& layout,
               std::span<double> histogram) const;

    /// Keeps the points in the slot that the root chose with the bracket `before` it moved.
    void keep_chosen(const CutSearch& before, const CutSearch& after, int num_bins);

    /// Adds `list`, position and weight of each candidate.
    void append_candidates(double list, std::vector<double>& records) const;

    std::size_t num_candidates() const { return candidates_.size(); }

  private:
    std::span<const Fragment> fragments_;
    const SortedPoints& points_;
    std::vector<LocalIndex> candidates_;
};

/// Moves the search on by what the ranks counted; sets stage done when the cut is good enough.
void decide(CutSearch& search, CutTarget& target, const HistogramLayout& layout,
            std::span<const double> histogram);

/// Ends the search with the best cut between the positions gathered: the weight below is as near
/// to the target as these allow. Coincident points stay together.
void decide_among(CutSearch& search, CutTarget& target, std::span<const double> records,
                  int dimension);

}  // namespace rrcb
