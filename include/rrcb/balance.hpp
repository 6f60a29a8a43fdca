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
    int coincident_cuts = 0;        ///< that would divide points which no allowed cut tells apart;
                                    ///< counted by the refinement
    int rounds = 0;                 ///< of counting the points of all ranks, for the refinement
    bool all_weights_zero = false;  ///< balanced by count instead
    int surplus_parts = 0;          ///< parts that must stay empty: more parts than points
};

/// Result of a call; the same on every rank.
struct Report {
    double imbalance = 1;              ///< heaviest part / mean part, counted; NaN if not counted
    bool within_tolerance = false;     ///< `imbalance` is at most Options::imbalance_tolerance
    bool kept = false;                 ///< the points stay on their ranks, each rank's are one part
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

/// Divides the points of all ranks into parts of equal (or given relative) weight.
///
/// Collective over `comm`: every rank calls it with the same options and dimension; a rank may
/// hold no points (null arrays are legal) but states the dimension. The statistics of
/// the non-empty cells travel up a tree of ranks to rank 0, merged on the way where there are too
/// many; the cuts are broadcast, moved by what the ranks count around them (see Refine), and every
/// rank assigns its own points; no point moves. The same input on the same ranks gives the same
/// bits. The library communicates on a duplicate of `comm`, made at the first call, kept with it
/// and freed with it.
///
/// Points stay as they lie where that is good enough: where there is a part for each rank, up to
/// 4096 if rank 0 makes them all, and what the ranks hold is a bisection such as a new one might
/// be, the cuts are those between the ranks (Report::kept). This holds for estimated cuts, also
/// refined to a tolerance, if
/// - the imbalance exceeds 1 by a tenth of what the tolerance allows at most, or
/// - new cuts, counted, neither reach a tolerance that is missed, nor halve the excess and gain a
///   twentieth of what the tolerance allows; where it is missed before and after a refinement, the
///   twentieth is enough. Where it is met already, new cuts are counted as estimated.
/// So each move is a gain, and repeated calls come to rest while the points do, as long as the axes
/// of the cuts stay. These may turn with the distribution where axes are grouped, and in parts of a
/// few dozen points: then what the ranks hold is no such bisection, and points may go to and fro.
/// Part r goes to rank r where it lay there, as after the last call; to another where ranks were
/// renumbered and none is empty.
///
/// Where there are more parts, and more ranks, than Tuning::central_parts, rank 0 makes regions in
/// this way, and the cuts below them are made by many ranks. Each rank tells the owner of a node,
/// the first rank of its first part, what it has there, along ceil(log2 R) messages on R ranks, in
/// which records of one node are joined; the owner answers the same way. Nodes take about two such
/// rounds a level to a tolerance, four exactly. At the end all ranks get all cuts and the weights
/// of all parts, by two reductions, 40 bytes a part together. With Options::cuts = own they do not,
/// and no rank holds an array with an entry for each part or rank, but for `part_sizes`: beside the
/// points and a sorted copy of them a rank has about 1.5 kB for each node of a level in which it
/// has points, 64 kB for messages, and the owner of a node up to 1024 positions. Whether points may
/// stay as they lie the owners tell in one more round of that kind; part r then is on rank r.
///
/// Cuts lie where Axes::min_width and Axes::grid let them, those of points that stay as well.
/// Each is then in the place nearest to the share of its parts, across another axis if that comes
/// nearer; the imbalance may stay above the tolerance.
///
/// Throws Error on every rank alike: for NaN or infinite coordinates, negative, NaN or infinite
/// weights, arrays of inconsistent length, options out of range or different between ranks, limits
/// of cuts that leave no room for so many parts (it tells for how many), grids that coordinates
/// can't tell apart, ranks that round differently or treat subnormal numbers differently.
RRCB_API Balance balance(const Points& points, const Options& options, MPI_Comm comm);

/// Divides the points as balance(), from the cuts of an earlier call in place of statistics, for
/// points that moved little since.
///
/// Collective over `comm`. Every rank assigns its points by `previous` and counts them in that one
/// pass; the counts travel up the tree of ranks, and one broadcast tells whether the cuts stay: no
/// cells, no sorting, no memory that grows with the points but the result. With Refine::none they
/// stay whatever was counted. To a tolerance they stay while the parts are within it. Beyond it a
/// cut stays where each side of it is within the tolerance, or light enough for the cuts below to
/// bring it there; any other moves to the nearest place where that holds, but for a sixteenth of
/// the room that it has, or half a point. So few points change parts, which end near the tolerance
/// and not near the mean. Cuts are searched from the top, and what lies below one that moved is
/// counted once more. With Refine::exact all cuts are searched.
///
/// With Axes::min_width or Axes::grid, cuts that lie where they may not are moved first: to
/// the nearest place, or across another axis where there is none. Then the points are counted, and
/// beyond the tolerance all cuts are searched in their places, to the shares of the parts.
///
/// Where many ranks make the parts, see Tuning::central_parts, `previous` may be whole or not; the
/// cuts stay while the parts are within the tolerance, and are made from nothing beyond it, with
/// Refine::exact and with AxisOrder::given(). Counts then go to the ranks of the parts, and memory
/// follows from `previous` and the parts that the points of a rank are in. Where one rank makes the
/// parts, cuts that are not whole are made from nothing.
///
/// The other axes of `previous` stay, unless the imbalance ends above 1.25 times the larger of the
/// tolerance and ReportDetails::least_imbalance. Then cuts are made from statistics as well, of
/// other axes, except with Axes::min_width or Axes::grid, and replace those if that gains
/// something.
///
/// `previous` must be the same on every rank, or what each rank got by a balance on this
/// communicator, and have the dimension and number of parts asked for. Points in one place that it
/// divides are counted on the side where the look-up finds them.
/// Report::kept and ReportDetails::estimated_imbalance and num_records are not set by this call.
/// Without any points the cuts stay, and the report is that of a call from nothing.
RRCB_API Balance rebalance(const Points& points, const Options& options, const Cuts& previous,
                           MPI_Comm comm);

}  // namespace rrcb
