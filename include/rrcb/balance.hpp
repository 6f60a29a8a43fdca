#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>

#include <mpi.h>

#include <vector>

namespace rrcb {

/// Statistics of a call; the same on every rank.
struct ReportDetails {
    GlobalCount num_points = 0;      ///< over all ranks
    GlobalCount num_records = 0;     ///< cells bisected
    double total_weight = 0;         ///< over all ranks
    double estimated_imbalance = 1;  ///< of the statistical domain, or of regions if many ranks
                                     ///< make the parts; see quality.hpp
    /// Lower bound of the imbalance of any partition: a part cannot weigh less than the heaviest
    /// point.
    double least_imbalance = 1;
    int coincident_cuts = 0;        ///< that would divide points which no allowed cut separates;
                                    ///< counted by the refinement
    int rounds = 0;                 ///< of counting the points of all ranks, for the refinement
    bool all_weights_zero = false;  ///< balanced by count instead
    int surplus_parts = 0;          ///< parts that must stay empty: more parts than points
};

/// Result of a call; the same on every rank.
///
/// Look at `imbalance` and `within_tolerance`; the other fields explain these two.
struct Report {
    double imbalance = 1;              ///< heaviest part / mean part, counted; NaN if not counted
    bool within_tolerance = false;     ///< `imbalance` is at most Options::imbalance_tolerance
    bool kept = false;                 ///< the points stay on their ranks; each rank's are one part
    std::vector<double> part_weights;  ///< over all ranks, one per part, by count if all weights
                                       ///< are 0; empty if not counted, or if ranks get their own
                                       ///< cuts only
    ReportDetails details{};           ///< statistics
};

/// The new partition: the parts of this rank's points, and the cuts, which are the same on every
/// rank unless Options::cuts asks for each rank's own.
struct Balance {
    Cuts cuts;                ///< between the parts, for look-ups
    std::vector<Part> parts;  ///< length points.count
    Report report;            ///< measured imbalance and statistics
};

/// Divides the points of all ranks into parts of equal, or given relative, weight; no point moves.
///
///     const rrcb::Points points = rrcb::interleaved_points(xyz, 3);
///     rrcb::Balance balance = rrcb::balance(points, {}, comm);  // one part per rank
///
/// Collective over `comm`, which the first call duplicates. A rank may hold no points; all ranks
/// pass the same dimension and `options`. Returns the cuts, the part of each local point and a
/// report. The same input on the same ranks gives the same bits. Points are kept on their ranks if
/// new cuts would gain too little (Report::kept). The duplicate is freed with `comm`.
///
/// Throws Error on every rank alike: for unusable coordinates, weights or arrays, options out of
/// range or different between ranks, limits without room for so many parts, or ranks that round
/// differently. Cost: a pass over the points, a gathering of cells, a broadcast, and a reduction
/// for each round of counting; see docs/design/how_it_works.md and many_ranks.md.
RRCB_API Balance balance(const Points& points, const Options& options, MPI_Comm comm);

/// Divides points that moved little since an earlier call, starting from its cuts.
///
///     balance = rrcb::rebalance(points, options, balance.cuts, comm);
///
/// Collective over `comm`. `previous` is the same on every rank, or the cuts that each rank got
/// from a balance on `comm`. It has the dimension and the number of parts of this call.
/// Returns as balance(). The cuts are kept while the parts are within the tolerance, if there are
/// no points, and always with Refine::none. Otherwise as few points change parts as the tolerance
/// allows; with Refine::exact all cuts are searched. Limits may move cuts to other axes than
/// Axes::order. Report::kept and the estimate are set only if the cuts are made anew.
///
/// Throws Error as balance(), and for a `previous` that does not fit. Cost while the cuts are kept:
/// one pass over the points, one reduction, one broadcast, and no memory for each point except the
/// result.
RRCB_API Balance rebalance(const Points& points, const Options& options, const Cuts& previous,
                           MPI_Comm comm);

/// Replaces `result` by that of balance(), and reuses the memory of its parts.
///
/// Collective over `comm`. From the second call on with as many points no memory is allocated for
/// each point. Throws Error as balance(); `result` then has no parts.
RRCB_API void balance_into(Balance& result, const Points& points, const Options& options,
                           MPI_Comm comm);

/// Replaces `result` by that of rebalance(), and reuses the memory of its parts. `previous` may be
/// `result.cuts`. Collective over `comm`; throws Error as rebalance().
RRCB_API void rebalance_into(Balance& result, const Points& points, const Options& options,
                             const Cuts& previous, MPI_Comm comm);

/// Frees the buffers that calls on `comm` keep for the next ones; otherwise they are freed with
/// `comm`.
///
/// Not collective, and not during a call, as from a StageObserver. A call that searches cuts, as
/// with Refine::exact, keeps 8 bytes a point for each coordinate, 8 more, and 8 with weights; other
/// calls keep less.
RRCB_API void release_buffers(MPI_Comm comm);

}  // namespace rrcb
