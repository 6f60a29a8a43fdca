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

/// State of the search for one cut. The owner of the cut decides; the state is the same on every
/// rank that takes part.
///
/// The search works on axis number `tied`: the axis of the cut is number 0, and the others follow
/// in ascending order. Along this axis the cut is in [lower, upper). Along the axes with smaller
/// numbers it is already final in `cut`.
struct CutSearch {
    enum Stage : std::int32_t {
        over_points,      ///< count all points of the node, in bins that divide the bracket
        over_candidates,  ///< count the candidates that are left in the bracket
        gathering,        ///< send all candidates to the owner
        centring,         ///< find the gap around the known cut
        dividing,         ///< weigh the coincident points at the known cut, which the cut divides
        done
    };
    Stage stage = over_points;
    std::int32_t tied = 0;
    std::int32_t num_axes = 1;  ///< number of axes to break ties by, including the axis of the cut
    std::int32_t by_bits = 0;   ///< 1: bins contain equal numbers of doubles, see Bins
    Cut cut;
    double lower = 0;
    double upper = 0;
    double quantum = 0;  ///< power of two of which each rank's sums are multiples, so that adding
                         ///< them is exact in any order
    std::int32_t chosen = 0;      ///< slot in which the search continues
    std::int32_t coincident = 0;  ///< set at the end; 1: the target is among inseparable points
    double found_below = 0;  ///< set at the end: weight of the node below the cut, without points
                             ///< to be divided
    double lot_below = 0;    ///< set at the end: weight of points to be divided that belongs below
                             ///< the cut
};

/// Allowed numbers of points below a cut, so that each side has at least one point for each of its
/// parts.
struct CountLimits {
    GlobalCount least = 0;
    GlobalCount most = std::numeric_limits<GlobalCount>::max();
    double penalty = 0;  ///< excess added for each part left empty; larger than any other excess

    /// Returns the number of parts that remain empty with this number of points below.
    GlobalCount num_missing(GlobalCount count) const {
        return std::max({least - count, count - most, GlobalCount{0}});
    }
};

/// Part of the state of a search that only the owner has.
struct CutTarget {
    double target = 0;               ///< weight that should be below the cut
    double share = 0.5;              ///< target divided by the weight of the node
    double slack = 0;                ///< excess that a cut may have
    double weight_before = 0;        ///< weight of the node below all candidates
    GlobalCount num_candidates = 0;  ///< number of candidates left on all ranks
    GlobalCount count_before = 0;    ///< number of points of the node below all candidates
    CountLimits counts{};            ///< limits of the number of points below the cut
    bool divides = false;  ///< whether inseparable points may be divided; then those of lower ranks
                           ///< go below
    Places places{};       ///< allowed positions of the cut

    /// Returns the excess weight of the side that is too heavy, times twice the share of the other
    /// side. It is proportional to the factor by which the side exceeds its share. If both shares
    /// are 1/2, it is the distance from the target.
    double excess(double below) const {
        return below < target ? 2 * share * (target - below) : 2 * (1 - share) * (below - target);
    }

    /// Returns the excess of a cut with this weight and number of points below it. Of two cuts that
    /// leave parts empty, the one that leaves fewer parts empty has the smaller excess.
    double excess(double below, GlobalCount count) const {
        return excess(below) + counts.penalty * static_cast<double>(counts.num_missing(count));
    }
};

/// Returns the axis on which a search works.
int current_axis(const CutSearch& search);

/// Returns the bins of the bracket of a search.
Bins bins_of(const CutSearch& search, const HistogramLayout& layout);

/// Advances the search by the counts in its bins. Ends it when the cut is good enough.
///
/// A search needs at most 13 counts along an axis: two in bins of equal width, and 11 in bins with
/// equal numbers of doubles, which reduce 2^64 doubles to one. On the lines of a grid, each count
/// reduces their number by the factor num_bins, and two more counts may be needed. If cuts are
/// limited, the bracket is between the first and the last allowed position.
void decide_by_bins(CutSearch& search, CutTarget& target, const HistogramLayout& layout,
                    std::span<const double> histogram);

/// Ends the search with the best cut between the gathered points. `records` contains the position
/// and the weight of each, in any order. Returns true if the cut is in the middle between two of
/// them.
bool decide_among(CutSearch& search, const CutTarget& target, std::span<const double> records,
                  int dimension);

/// Moves a cut to the middle of the gap around it. Positions along `num_axes` axes may break ties.
/// If there are points on one side only, moves the cut next to them.
void centre(Cut& cut, int num_axes, std::span<const double> gap);

/// Moves a cut at a position, whose coordinates break ties along all axes, just above the position.
void move_behind(CutSearch& search);

/// If a search has at most this many candidates, gathering them costs less than another count. With
/// a quarter of this number, exact calls send 2 % more messages; with four times this number, calls
/// from earlier cuts send 22 % more bytes.
inline constexpr GlobalCount most_gathered = 1024;

/// The candidates of all searches together are gathered in one round up to this number. With only
/// most_gathered here, calls from earlier cuts send 6 % more messages.
inline constexpr GlobalCount most_gathered_at_once = 64 * most_gathered;

}  // namespace rrcb
