#pragma once

#include <rrcb/balance.hpp>
#include <rrcb/method/bisection.hpp>
#include <rrcb/method/moments.hpp>
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

/// Points bisected by rank 0.
enum class PaperDomain {
    sampled,  ///< pseudo-random points in mean +- multiplier * sigma of each cell: the paper's RRCB
    points    ///< the points themselves, all gathered on rank 0: the paper's RCB
};

/// Position of a cut across the longest axis of its box.
enum class CutRule {
    weighted_fraction,  ///< the weight below is the share of the parts below
    midpoint            ///< at that share of the extent: the literal reading of the paper
};

/// Options of balance_as_in_paper(); must be the same on every rank, which is checked.
struct PaperOptions {
    int num_parts = 0;                              ///< parts to make; 0: one per rank
    std::vector<double> part_sizes{};               ///< as Options::part_sizes
    PaperDomain domain = PaperDomain::sampled;      ///< points bisected by rank 0
    CutRule cut_rule = CutRule::weighted_fraction;  ///< position of cuts
    bool plain_cuts = false;                        ///< as Axes::plain
    int support_mesh = 8;           ///< cells per axis of each rank's mesh, 1 to 4096, in 3-D 256
    double sigma_multiplier = 1.5;  ///< half-width of a cell's sampling box in sigmas, > 0
    double sample_fraction = 1.0;   ///< points drawn per real point, in (0, 1]
    std::uint64_t seed = 1;         ///< the same seed gives the same points
    StageObserver* observer = nullptr;  ///< as Options::observer
};

/// Divides the points of all ranks into parts by the paper's RRCB, or by its RCB. Collective.
///
/// Every rank reduces its points to the moments of the cells of its support mesh; rank 0 gathers
/// them, draws random points from them, bisects these and broadcasts the cuts.
/// @param points  of this rank
/// @param options the same on every rank
/// @param comm    as for balance()
/// @return as balance(); Report::imbalance is NaN, as nothing is counted
/// Throws Error on every rank alike, as balance(). Cost: two reductions, one gathering of all
/// cells (or of all points, for PaperDomain::points), two broadcasts; rank 0 holds all points drawn
/// or gathered.
RRCB_API Balance balance_as_in_paper(const Points& points, const PaperOptions& options,
                                     MPI_Comm comm);

/// Weight concentrated at a position.
struct MassPoint {
    Vector position{};  ///< of the weight
    double weight = 0;  ///< of the point
};

/// Draws pseudo-random points of weight 1, uniform in mean +- multiplier * sigma of each cell. Not
/// collective.
///
/// @param cells     of all ranks
/// @param dimension of the points
/// @param options   multiplier, share and seed; the same give the same points on every machine
/// @return `sample_fraction` times the number of real points, at least one, shared among the cells
/// in proportion to their weight by largest remainder
/// Throws Error for options out of range.
RRCB_API std::vector<MassPoint> sample_points(std::span<const CellMoments> cells, int dimension,
                                              const PaperOptions& options);

/// Copies points with their weights; if all weights are 0, each copy weighs 1. Not collective.
/// Throws Error for arrays of another length than the points.
RRCB_API std::vector<MassPoint> mass_points(const Points& points);

/// Bisects points recursively across the longest extent of the points in each box. Not collective.
///
/// @param points     a copy, which is sorted
/// @param dimension  of the points
/// @param num_parts  1 or more
/// @param part_sizes relative, one per part, or empty; a part of size 0 gets an empty region
/// @param rule       position of cuts
/// @param plain_cuts points on a cut are not divided by their other coordinates
/// Throws Error as bisect().
RRCB_API Bisection bisect_points(std::vector<MassPoint> points, int dimension, int num_parts,
                                 std::span<const double> part_sizes = {},
                                 CutRule rule = CutRule::weighted_fraction,
                                 bool plain_cuts = false);

}  // namespace rrcb
