#pragma once

#include "cuts/cut_limits.hpp"
#include "passes/bins.hpp"
#include "passes/histogram.hpp"

#include <rrcb/cuts.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace rrcb {

/// State of the search for one cut, decided by its owner; the same on every participating rank.
///
/// The cut is in [lower, upper) of the axis number `tied` of its axes: first the axis of the cut,
/// then the others in ascending order. Along the axes before that one it is already fixed in `cut`.
struct CutSearch {
    enum Stage : std::int32_t {
        over_points,      ///< count all points of the node, in bins of the bracket
        over_candidates,  ///< count the candidates left in the bracket
        gathering,        ///< send all candidates to the owner
        centring,         ///< find the gap around the known cut
        dividing,         ///< weigh the coincident points at the known cut, which divides them
        done
    };
    Stage stage = over_points;
    std::int32_t tied = 0;
    std::int32_t num_axes = 1;  ///< axes to break ties by, including the cut's
    std::int32_t by_bits = 0;   ///< 1: bins of equal numbers of doubles, see Bins
    Cut cut;
    double lower = 0;
    double upper = 0;
    double quantum = 0;  ///< power of two; each rank's sums are multiples of it, so that adding
                         ///< them is exact in any order
    std::int32_t chosen = 0;      ///< slot in which the search goes on
    std::int32_t coincident = 0;  ///< 1: inseparable points hold the target, once done
    double found_below = 0;  ///< weight of the node below the cut and the points to divide, once
                             ///< done
    double lot_below = 0;    ///< weight of points to be divided, to come below, once done
};

/// Numbers of points below a cut with which both sides have a point for each part.
struct CountLimits {
    GlobalCount least = 0;
    GlobalCount most = std::numeric_limits<GlobalCount>::max();
    double penalty = 0;  ///< more than any excess

    /// Returns the number of parts left empty with so many points below.
    GlobalCount num_missing(GlobalCount count) const {
        return std::max({least - count, count - most, GlobalCount{0}});
    }
};

/// State of a search at the owner only.
struct CutTarget {
    double target = 0;               ///< weight to come below the cut
    double share = 0.5;              ///< ratio of the target to the weight of the node
    double slack = 0;                ///< excess allowed to a cut
    double weight_before = 0;        ///< weight of the node below all candidates
    GlobalCount num_candidates = 0;  ///< points left, of all ranks
    GlobalCount count_before = 0;    ///< points of the node below all candidates
    CountLimits counts{};            ///< of points below the cut
    bool divides = false;            ///< inseparable points are divided, those of lower ranks below
    Places places{};                 ///< allowed for the cut; any place if cuts are not limited

    /// Returns the excess weight of one side, times twice the share of the other side: proportional
    /// to the factor by which the side exceeds its share. For halves it is the distance from the
    /// target.
    double excess(double below) const {
        return below < target ? 2 * share * (target - below) : 2 * (1 - share) * (below - target);
    }

    /// Returns the excess of a cut with so many points below it; of two cuts that leave parts
    /// empty, the one that leaves fewer has the smaller excess.
    double excess(double below, GlobalCount count) const {
        return excess(below) + counts.penalty * static_cast<double>(counts.num_missing(count));
    }
};

/// Returns the axis on which a search works.
int current_axis(const CutSearch& search);

/// Returns the bins of the bracket of a search.
Bins bins_of(const CutSearch& search, const HistogramLayout& layout);

/// Advances the search by the counts in its bins; it is done when the cut is good enough.
///
/// A search takes at most 13 counts along an axis: two in bins of equal width, and 11 in bins of
/// equal numbers of doubles, which leave one double of 2^64. On lines of a grid it takes one count
/// for every factor of num_bins in their number, and two more. If cuts are limited, the bracket is
/// between the first and the last of their places.
void decide_by_bins(CutSearch& search, CutTarget& target, const HistogramLayout& layout,
                    std::span<const double> histogram);

/// Ends the search with the best cut between the gathered positions. `records` hold position and
/// weight of each, in any order. Returns true if the cut is in the middle of two of them.
bool decide_among(CutSearch& search, const CutTarget& target, std::span<const double> records,
                  int dimension);

/// Moves a cut to the middle of the gap around it. Positions along `num_axes` axes may
/// break ties. If there are points on one side only, the cut is moved next to them.
void centre(Cut& cut, int num_axes, std::span<const double> gap);

/// Moves a cut at a position, which breaks ties along all axes, behind it.
void move_behind(CutSearch& search);

/// Candidates of one search up to which gathering costs less than another count. A quarter of this
/// number takes 2 % more messages in exact calls, four times as many 22 % more bytes in calls from
/// earlier cuts.
inline constexpr GlobalCount most_gathered = 1024;

/// Candidates of all searches up to which they are gathered at once, in a few messages. With
/// most_gathered instead, calls from earlier cuts send 6 % more messages.
inline constexpr GlobalCount most_gathered_at_once = 64 * most_gathered;

}  // namespace rrcb
