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
    double estimated_imbalance = 1;  ///< of the statistical domain, see quality.hpp; of regions if
                                     ///< many ranks make the parts
    /// Lower bound of the imbalance of any partition: the heaviest point in a part alone.
    double least_imbalance = 1;
    int coincident_cuts = 0;        ///< that would divide points which no allowed cut separates;
                                    ///< counted by the refinement
    int rounds = 0;                 ///< of counting the points of all ranks, for the refinement
    bool all_weights_zero = false;  ///< balanced by count instead
    int surplus_parts = 0;          ///< parts that must stay empty: more parts than points
};

/// Result of a call; the same on every rank.
struct Report {
    double imbalance = 1;              ///< heaviest part / mean part, counted; NaN if not counted
    bool within_tolerance = false;     ///< `imbalance` is at most Options::imbalance_tolerance
    bool kept = false;                 ///< the points stay on their ranks; each rank's are one part
    std::vector<double> part_weights;  ///< over all ranks, one per part, by count if all weights
                                       ///< are 0; empty if not counted or if cuts are not whole
    ReportDetails details{};           ///< statistics
};

/// The new partition; every rank gets the same cuts, unless Options::cuts asks for its own, and the
/// parts of its own points.
struct Balance {
    Cuts cuts;                ///< between the parts, for look-ups
    std::vector<Part> parts;  ///< length points.count
    Report report;            ///< how even the parts are
};

/// Divides the points of all ranks into parts of equal, or given relative, weight.
///
/// Collective over `comm`: every rank gives the same options and dimension; it may hold no points.
/// Returns the cuts and the part of each point of this rank; no point moves. The same input on the
/// same ranks gives the same bits. The library communicates on a duplicate of `comm`, made at the
/// first call and freed with it.
///
/// Points are kept on their ranks if new cuts would gain too little (Report::kept): see
/// docs/design/how_it_works.md, also for limits of cuts. With more parts, and more ranks, than
/// Tuning::central_parts the ranks share the work: see docs/design/many_ranks.md.
///
/// Throws Error on every rank alike: for unusable coordinates, weights or arrays, options out of
/// range or different between ranks, limits that leave no room for so many parts, or ranks that
/// round differently. Cost: a pass over the points, a gathering of cells, a broadcast, and a
/// reduction for each round of counting.
RRCB_API Balance balance(const Points& points, const Options& options, MPI_Comm comm);

/// Divides the points as balance(), from the cuts of an earlier call in place of statistics; for
/// points that moved little since.
///
/// Collective over `comm`. `previous` is the same on every rank, or what each rank got by a balance
/// on this communicator, and has the dimension and number of parts asked for. The cuts are kept
/// while the parts are within the tolerance, and always with Refine::none. Otherwise as few points
/// change parts as the tolerance allows; with Refine::exact all cuts are searched. The rules are in
/// docs/design/how_it_works.md.
///
/// Limits may move cuts to other axes than Axes::order. Report::kept and the estimate are set only
/// if the cuts are made anew. Without any points the cuts are kept, and the report is that of
/// balance(). Throws Error as balance(), and for a `previous` that does not fit. Cost while the
/// cuts are kept: one pass over the points, one reduction, one broadcast, and no memory for each
/// point except the result.
RRCB_API Balance rebalance(const Points& points, const Options& options, const Cuts& previous,
                           MPI_Comm comm);

/// Replaces `result` by that of balance(), with its parts in the memory of the old ones.
///
/// Collective over `comm`. From the second call on with as many points no memory is allocated for
/// each point. If it throws, as balance(), `result` has no parts.
RRCB_API void balance_into(Balance& result, const Points& points, const Options& options,
                           MPI_Comm comm);

/// Replaces `result` by that of rebalance(), as balance_into(). `previous` may be `result.cuts`.
RRCB_API void rebalance_into(Balance& result, const Points& points, const Options& options,
                             const Cuts& previous, MPI_Comm comm);

/// Frees the buffers that calls on `comm` keep for the next ones. Not collective, and not during a
/// call, as from a StageObserver.
///
/// They are freed with `comm` otherwise. A call that searches cuts, as with Refine::exact, keeps 8
/// bytes a point for each coordinate, 8 more, and 8 with weights; other calls keep less.
RRCB_API void release_buffers(MPI_Comm comm);

}  // namespace rrcb
