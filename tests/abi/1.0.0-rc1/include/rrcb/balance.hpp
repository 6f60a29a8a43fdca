#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>

#include <mpi.h>

#include <vector>

namespace rrcb {

/// Statistics of a call. They are the same on every rank.
struct ReportDetails {
    GlobalCount num_points = 0;  ///< over all ranks
    GlobalCount num_cells = 0;   ///< cells that were bisected
    double total_weight = 0;     ///< over all ranks
    /// Imbalance of the statistical domain, see quality.hpp. NaN if there is no such domain,
    /// because earlier cuts were kept or many ranks have made the parts.
    double estimated_imbalance = 1;
    /// Lower bound of the imbalance of all partitions. It follows from the heaviest point or, if
    /// all points weigh the same, from their number: it is 1.6 for 20 points in 16 parts.
    /// Coincident points that are kept together do not raise it; then `coincident_cuts` is above 0.
    double least_imbalance = 1;
    int coincident_cuts = 0;  ///< cuts that would have to divide points which no allowed cut
                              ///< separates; counted by the refinement
    int rounds = 0;           ///< how often the refinement has counted the points of all ranks
    bool all_weights_zero = false;  ///< if true, points were balanced by their number instead
    int num_empty_parts = 0;  ///< parts that stay empty because there are fewer points than parts
};

/// Result of a call. It is the same on every rank.
///
/// Look at `imbalance` and `within_tolerance` first; the other fields explain these two.
struct Report {
    double imbalance = 1;           ///< heaviest part / mean part, counted; NaN if not counted,
                                    ///< 1 without points
    bool within_tolerance = false;  ///< `imbalance` is at most Options::imbalance_tolerance
    bool kept = false;  ///< whether nothing moves, because the points of rank r are part r; always
                        ///< false if many ranks make the parts, or if cuts are limited
    std::vector<double> part_weights;  ///< over all ranks, one per part; numbers of points if all
                                       ///< weights are 0; empty if not counted
    ReportDetails details{};           ///< statistics
};

/// The new partition: the parts of this rank's points, and the cuts, which are the same on every
/// rank.
struct Balance {
    Cuts cuts;                ///< between the parts, for look-ups
    std::vector<Part> parts;  ///< length points.count
    Report report;            ///< measured imbalance and statistics
};

/// Divides the points of all ranks into parts of equal, or given relative, weight. No point moves.
///
///     const rrcb::Balance now = rrcb::balance(points, comm);  // one part per rank
///     const rrcb::Balance next = rrcb::balance(points, comm, options, now.cuts);
///
/// Collective. The same input on the same ranks gives bit-identical results.
/// @param points   of this rank, which may have none; the dimension must be the same on every rank
/// @param comm     is duplicated by the first call; the duplicate is freed together with it
/// @param options  must be the same on every rank
/// @param previous cuts of an earlier call; ignored if empty, or if num_parts is 0 and ranks differ
/// @return the cuts, the part of each point of this rank and a report
/// Throws the same Error on every rank: for unusable coordinates, weights or arrays, options that
/// are out of range or differ between ranks, `previous` of another dimension or num_parts, limits
/// without room for the parts, or ranks that round differently. Cost: a pass, a gathering of cells,
/// a broadcast, and a reduction for each round of counting; no gathering if `previous` is kept.
RRCB_API Balance balance(const Points& points, MPI_Comm comm, const Options& options = {},
                         const Cuts& previous = {});

/// Replaces a result as balance() would, and reuses the memory of its parts. Collective.
///
/// @param result   has no parts if the call throws
/// @param points   if there are as many as last time, no memory is allocated for each
/// @param comm     as for balance()
/// @param options  must be the same on every rank
/// @param previous the same on every rank, or as each rank got them from a balance on `comm`; may
/// be `result.cuts`. They are kept if the parts are within the tolerance, except with
/// Refine::exact; new cuts prefer their axes. Limits may move cuts to axes other than those of
/// Axes::order. Report::kept and the estimate are set only if the cuts are made anew
/// Throws Error as balance().
RRCB_API void balance_into(Balance& result, const Points& points, MPI_Comm comm,
                           const Options& options = {}, const Cuts& previous = {});

/// Frees the buffers that calls on `comm` keep for later calls. Otherwise they are freed with
/// `comm`.
///
/// Not collective. Calls that search cuts, such as those with Refine::exact, keep a copy of the
/// points; other calls keep less.
RRCB_API void release_buffers(MPI_Comm comm);

}  // namespace rrcb
