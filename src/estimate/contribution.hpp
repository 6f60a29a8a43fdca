#pragma once

#include "collective/failure.hpp"
#include "options/request.hpp"

#include <rrcb/method/statistical_domain.hpp>
#include <rrcb/passes.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace rrcb {

/// Totals of the points of one rank, or of several.
struct Totals {
    std::int64_t num_points = 0;
    std::int64_t num_cells = 0;
    double weight = 0;
    double lightest = std::numeric_limits<double>::infinity();  ///< weight of one point
    double heaviest = 0;
    Box box{};
};

/// Summary of one rank, or of all ranks of a subtree: failures, requests and totals.
struct Summary : Totals {
    std::int32_t first_rank = 0;             ///< lowest rank of the summary
    std::int32_t failing_rank = no_rank;     ///< lowest failed rank
    std::int32_t differing_rank = no_rank;   ///< one with another request than ...
    std::int32_t reference_rank = no_rank;   ///< ... this one
    std::int32_t weighted_rank = no_rank;    ///< a rank whose points have weights
    std::int32_t unweighted_rank = no_rank;  ///< a rank whose points have no weights
    std::uint64_t difference = 0;            ///< see name_of_request
    Request request{};                       ///< of the first rank
    std::int64_t num_doubles = 0;
    std::int64_t num_extent_doubles = 0;  ///< of them, behind the cells
    std::int64_t num_total_doubles = 0;   ///< of them, the last ones

    bool is_usable() const { return failing_rank == no_rank && differing_rank == no_rank; }
    /// Returns true if all points weigh the same: they are counted, in units of this weight.
    bool is_counted() const { return lightest == heaviest; }
};

/// Contribution of one rank, or of all ranks of a subtree, to the root; see cell_records.hpp.
struct Contribution {
    Summary summary;
    std::vector<double> records;    ///< the moments of their cells
    std::vector<double> extents{};  ///< of the points of each rank, if rank 0 reads these
    /// Weights, then numbers, of the points in the parts of earlier cuts, if the call counts these.
    std::vector<double> part_totals{};
};

/// Returns the totals of a rank's points, from one reading of these.
Summary summarize(const PointSummary& points, bool are_weighted, int rank);

/// Reduces checked points in a box to the moments of their cells in the support mesh of the
/// options. If all ranks seem to have only a few points for each part, each point is a cell.
void add_records(PointPasses& points, const Box& box, int num_ranks, const Options& options,
                 Contribution& mine);

/// Returns the most cells that merging leaves: a fixed number, whatever the number of ranks, unless
/// the options choose the mesh. Twice as many lean cells may be passed on unmerged.
std::size_t most_cells(const Options& options);

/// Adds the totals of later ranks, and their failures and differences.
void join(Summary& mine, const Summary& next);

/// Adds the ranks that follow, whose cells, extents and part totals are the `doubles`: appends
/// them, adds the totals up, and coarsens to `most` cells if there are more than twice as many. Not
/// collective.
void absorb(Contribution& mine, const Summary& next, std::span<const double> doubles, int dimension,
            std::size_t most);

/// Returns the domain for the root to bisect, from the contributions of all ranks.
StatisticalDomain build_domain(const Contribution& all, int dimension);

}  // namespace rrcb
