#pragma once

#include "collective/failure.hpp"
#include "options/request.hpp"

#include <rrcb/detail/passes.hpp>
#include <rrcb/detail/statistical_domain.hpp>

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
    /// smallest weight of a point
    double lightest = std::numeric_limits<double>::infinity();
    double heaviest = 0;  ///< largest weight of a point
    Box box{};
};

/// Summary of one rank, or of all ranks in a subtree: failures, requests and totals.
struct Summary : Totals {
    std::int32_t first_rank = 0;             ///< lowest rank of the summary
    std::int32_t failing_rank = no_rank;     ///< lowest failed rank
    std::int32_t differing_rank = no_rank;   ///< a rank whose request differs from that of
                                             ///< reference_rank
    std::int32_t reference_rank = no_rank;   ///< see differing_rank
    std::int32_t weighted_rank = no_rank;    ///< a rank whose points have weights
    std::int32_t unweighted_rank = no_rank;  ///< a rank whose points have no weights
    std::uint64_t difference = 0;  ///< which entry of the requests differs, see name_of_request
    Request request{};             ///< request of the first rank
    std::int64_t num_doubles = 0;  ///< number of doubles that follow the summary
    std::int64_t num_extent_doubles = 0;  ///< number of these that are extents, after the cells
    std::int64_t num_total_doubles = 0;   ///< number of these that are part totals, at the end

    bool is_usable() const { return failing_rank == no_rank && differing_rank == no_rank; }
    /// Returns true if all points have the same weight. They are then counted, in units of this
    /// weight.
    bool is_counted() const { return lightest == heaviest; }
};

/// Contribution of one rank, or of all ranks in a subtree, to the root; see cell_records.hpp.
struct Contribution {
    Summary summary;
    std::vector<double> records;    ///< moments of the cells
    std::vector<double> extents{};  ///< extent of each rank's points, if rank 0 needs these
    /// Weight of each part of earlier cuts, followed by the number of points in each, if the call
    /// counts these.
    std::vector<double> part_totals{};
};

/// Returns the totals of a rank's points.
Summary summarize(const PointSummary& points, bool are_weighted, int rank);

/// Reduces checked points in a box to the moments of their cells in the support mesh of the
/// options. If all ranks seem to have only a few points for each part, makes each point a cell.
void add_records(PointPasses& points, const Box& box, int num_ranks, const Options& options,
                 Contribution& mine);

/// Returns the largest number of cells that merging leaves. It does not depend on the number of
/// ranks, unless the options choose the mesh. Twice as many lean cells may be passed on without
/// merging.
std::size_t most_cells(const Options& options);

/// Adds the totals, failures and differences of later ranks.
void join(Summary& mine, const Summary& next);

/// Adds the contribution of later ranks, whose cells, extents and part totals are in `doubles`.
/// Appends the cells and extents and adds up the totals. If there are then more than 2 * `most`
/// cells, merges them to at most `most`. Not collective.
void absorb(Contribution& mine, const Summary& next, std::span<const double> doubles, int dimension,
            std::size_t most);

/// Returns the domain that the root bisects, built from the contributions of all ranks.
StatisticalDomain build_domain(const Contribution& all, int dimension);

}  // namespace rrcb
