#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>

#include <mpi.h>

#include <vector>

namespace rrcb {

/// Statistics of a call; the same on every rank.
struct ReportDetails {
    GlobalCount num_points = 0;   ///< over all ranks
    GlobalCount num_records = 0;  ///< cells bisected
    double total_weight = 0;      ///< over all ranks
    double estimated_imbalance =
        1;  ///< of the statistical domain, see quality.hpp; NaN if there
            ///< is none: from earlier cuts, or if many ranks make the parts
    /// Lower bound of the imbalance of any partition: by the heaviest point, or by the number of
    /// points if all weigh the same, as 1.6 for 20 points in 16 parts. It is not raised by
    /// coincident points kept together: `coincident_cuts` is then above 0.
    double least_imbalance = 1;
    int coincident_cuts = 0;        ///< that would divide points which no allowed cut separates;
                                    ///< counted by the refinement
    int rounds = 0;                 ///< of counting the points of all ranks, for the refinement
    bool all_weights_zero = false;  ///< balanced by count instead
    int surplus_parts = 0;          ///< parts that stay empty: more than points
};

/// Result of a call; the same on every rank.
///
/// Look at `imbalance` and `within_tolerance`; the other fields explain these two.
struct Report {
    double imbalance = 1;           ///< heaviest part / mean part, counted; NaN if not counted,
                                    ///< 1 without points
    bool within_tolerance = false;  ///< `imbalance` is at most Options::imbalance_tolerance
    bool kept = false;  ///< nothing moves: the points of rank r are part r; not noticed if many
                        ///< ranks make the parts, or with limits of cuts
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
///     balance = rrcb::balance(points, {}, balance.cuts, comm);  // one part per rank
///
/// Collective. The same input on the same ranks gives the same bits.
/// @param points   of this rank, also none; the same dimension on every rank
/// @param options  the same on every rank
/// @param previous cuts of an earlier call; ignored if empty, or of other ranks and num_parts is 0
/// @param comm     duplicated by the first call; the duplicate is freed with it
/// @return the cuts, the part of each point of this rank and a report
/// Throws Error on every rank alike: for unusable coordinates, weights or arrays, options out of
/// range or different between ranks, `previous` of another dimension or num_parts, limits without
/// room for so many parts, or ranks that round differently. Cost: a pass over the points, a
/// gathering of cells, a broadcast, and a reduction for each round of counting; while `previous` is
/// kept a pass, a reduction and a broadcast. See docs/design/how_it_works.md.
RRCB_API Balance balance(const Points& points, const Options& options, const Cuts& previous,
                         MPI_Comm comm);

/// Replaces a result as balance() would, and reuses the memory of its parts. Collective.
///
/// @param result   has no parts if the call throws
/// @param points   with as many as last time no memory is allocated for each
/// @param options  the same on every rank
/// @param previous the same on every rank, or as each rank got them from a balance on `comm`;
/// may be `result.cuts`. They are kept while the parts are within the tolerance, but not with
/// Refine::exact; new cuts prefer their axes. Limits may move cuts to other axes than Axes::order.
/// Report::kept and the estimate are set only if the cuts are made anew
/// @param comm     as for balance()
/// Throws Error as balance().
RRCB_API void balance_into(Balance& result, const Points& points, const Options& options,
                           const Cuts& previous, MPI_Comm comm);

/// Frees the buffers that calls on `comm` keep for the next ones, before `comm` frees them.
///
/// Not collective. Searches of cuts, as with
/// Refine::exact, keep a copy of the points; other calls keep less.
RRCB_API void release_buffers(MPI_Comm comm);

}  // namespace rrcb
