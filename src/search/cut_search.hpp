#pragma once

#include "cuts/cut_limits.hpp"
#include "cuts/position_order.hpp"
#include "search/bins.hpp"
#include "search/histogram.hpp"

#include <rrcb/cuts.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rrcb {

/// State of the search for one cut, the same on every rank that takes part: the owner's answer.
///
/// The cut lies in [lower, upper) of the axis number `tied` of its axes: its own first, then the
/// others in ascending order. Along the axes before that one it is already fixed in `cut`. From the
/// first splitters on, it lies between two positions in the order of all axes from `tied` on.
struct CutSearch {
    enum Stage : std::int32_t {
        over_fragments,   ///< count all points of the node, in bins of the bracket
        over_candidates,  ///< count those in the bracket that are left
        sampling,         ///< bring a sample of them to the owner, for splitters
        over_splitters,   ///< count them between the splitters
        gathering,        ///< bring them all to the owner
        done
    };
    Stage stage = over_fragments;
    std::int32_t tied = 0;
    std::int32_t num_axes = 1;  ///< that may break ties, its own included
    std::int32_t by_bits = 0;   ///< 1: bins of equal numbers of doubles, see Bins
    Cut cut;
    double lower = 0;
    double upper = 0;
    double quantum = 0;  ///< power of two of which each rank's sums are multiples, so that adding
                         ///< them up is exact, in any order
    std::int32_t between_splitters = 0;  ///< 1 where they bound the search, not lower and upper
    std::int32_t chosen = 0;             ///< slot that the search goes on in
    double below = 0;                    ///< weight of the node below the cut, once done
    std::int32_t coincident = 0;  ///< 1: points that no cut tells apart hold the target, once done
    std::int32_t divides = 0;     ///< 1: these are to be divided, those of lower ranks below
    double lot_below = 0;         ///< weight of them that belongs below, 0 for none, once done
};

/// State of a search at the owner alone.
struct CutTarget {
    double target = 0;               ///< weight that belongs below the cut
    double share = 0.5;              ///< of the weight of the node that this is
    double slack = 0;                ///< excess that a cut may leave
    double base = 0;                 ///< weight of the node below what is left to the search
    GlobalCount num_candidates = 0;  ///< points of all ranks that are left
    int num_counts = 0;              ///< times that candidates were counted in bins
    Places places{};                 ///< of the cut; any where cuts are not limited

    /// Weight that one side has too much, times twice the share of the other side: in proportion to
    /// the factor by which it exceeds its own. Of halves it is the distance from the target.
    double excess(double below) const {
        return below < target ? 2 * share * (target - below) : 2 * (1 - share) * (below - target);
    }
};

/// Number of the axis a search works on.
int current_axis(const CutSearch& search);

/// The order of positions along the axes that are open to a search.
PositionOrder order_of(const CutSearch& search);

/// Bins of the bracket of a search.
Bins bins_of(const CutSearch& search, const HistogramLayout& layout);

/// Slot of a position: 2 k just before splitter k, 2 k + 1 at it. Splitters ascend in `order`.
std::int32_t slot_between(std::span<const Vector> splitters, const PositionOrder& order,
                          const Vector& position);

/// Splitters from a sample, ascending, at most half as many as slots.
std::vector<Vector> splitters_of(std::vector<Vector> sample, const PositionOrder& order,
                                 const HistogramLayout& layout);

/// Moves the search on by the counts in its bins; done when the cut is good enough.
///
/// A search takes at most 1 + 4 rounds of counting in bins, then two rounds for every factor of
/// about 16 by which its candidates outnumber most_gathered: 16 up to 10^9 of them. On lines of a
/// grid it takes one round for every factor of num_bins in their number, and two more.
///
/// Where cuts are limited the bracket lies between the first and the last of their places.
void decide_by_bins(CutSearch& search, CutTarget& target, const HistogramLayout& layout,
                    std::span<const double> histogram);

/// Moves the search on by the counts between the splitters, which resolve all ties.
void decide_by_splitters(CutSearch& search, CutTarget& target, const HistogramLayout& layout,
                         std::span<const Vector> splitters, std::span<const double> histogram);

/// Ends the search with the best cut between the positions gathered: the weight below is as near
/// to the target as these allow. `records` hold position and weight of each.
void decide_among(CutSearch& search, CutTarget& target, std::span<const double> records,
                  int dimension);

/// Number of candidates of one search up to which gathering is worth more than another count. A
/// quarter takes 2 % more messages in exact calls, four times as many 22 % more bytes in calls from
/// earlier cuts.
inline constexpr GlobalCount most_gathered = 1024;

/// Number of candidates of all searches up to which they are gathered at once, in a few messages.
/// With most_gathered in its place, calls from earlier cuts send 6 % more messages.
inline constexpr GlobalCount most_gathered_at_once = 64 * most_gathered;

}  // namespace rrcb
