#pragma once

#include <rrcb/balance.hpp>
#include <rrcb/points.hpp>

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

/// @file
/// The methods of the paper, for comparison with balance(): "On the development of a reduced
/// approach to the Recursive Coordinate Bisection in the context of parallel simulations of the
/// Material Point Method", CILAMCE 2020. Most users never include this header.

namespace rrcb {

/// The points that rank 0 bisects.
enum class PaperDomain {
    sampled,  ///< pseudo-random points in mean +- multiplier * sigma of each cell, as in the
              ///< paper's RRCB
    points    ///< the points themselves, all gathered on rank 0, as in the paper's RCB
};

/// Position of a cut across the longest axis of its box.
enum class CutRule {
    weighted_fraction,  ///< the share of the weight below the cut is the share of the parts below
    midpoint            ///< the cut is at that share of the extent, as the paper literally says
};

/// Options of balance_as_in_paper(). They must be the same on every rank, which is checked.
struct PaperOptions {
    int num_parts = 0;                              ///< parts to make; 0: one per rank
    std::vector<double> part_sizes{};               ///< as Options::part_sizes
    PaperDomain domain = PaperDomain::sampled;      ///< points bisected by rank 0
    CutRule cut_rule = CutRule::weighted_fraction;  ///< position of cuts
    bool plain_cuts = false;                        ///< as Axes::plain
    int cells_per_axis = 8;         ///< cells per axis of each rank's mesh, 1 to 4096, in 3-D 256
    double sigma_multiplier = 1.5;  ///< half-width of a cell's sampling box in sigmas, > 0
    double sample_fraction = 1.0;   ///< points drawn per real point, in (0, 1]
    std::uint64_t seed = 1;         ///< the same seed gives the same points
};

/// Divides the points of all ranks into parts by the paper's RRCB, or by its RCB. Collective.
///
/// Every rank reduces its points to the moments of the cells of its support mesh. Rank 0 gathers
/// them, draws random points from them, bisects these and broadcasts the cuts.
/// @param points  of this rank
/// @param options must be the same on every rank
/// @param comm    as for balance()
/// @return as balance(); Report::imbalance is NaN, because nothing is counted
/// Throws the same Error on every rank, as balance(). Cost: two reductions, one gathering of all
/// cells (with PaperDomain::points, of all points), and two broadcasts; rank 0 stores all points
/// that are drawn or gathered.
RRCB_API Balance balance_as_in_paper(const Points& points, MPI_Comm comm,
                                     const PaperOptions& options = {});

/// Returns the load unbalance of each part in percent: (ideal - actual) / ideal * 100, which is Lu
/// in the paper of CILAMCE 2020. Not collective.
///
/// @param part_weights weight of each part
/// @param part_sizes   as for imbalance()
/// @return one entry per part; it is negative if the part has too much weight, and 0 for a part of
/// size 0
RRCB_API std::vector<double> load_unbalance_percent(std::span<const double> part_weights,
                                                    std::span<const double> part_sizes = {});

}  // namespace rrcb
