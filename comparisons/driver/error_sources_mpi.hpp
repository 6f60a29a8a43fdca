#pragma once

#include "sweep_mpi.hpp"

#include <rrcb/method/moments.hpp>
#include <rrcb/method/statistical_domain.hpp>
#include <rrcb/method/support_mesh.hpp>

namespace comparisons {

/// What the root bisects, stage by stage further from the points.
enum class Source {
    points,    ///< all of them: what the bisection itself leaves
    cells,     ///< densities of the moments, as the root gets them: what the support mesh adds
    boxes,     ///< one patch in mean +- k sigma: what another half-width than sqrt(3) sigma adds
    in_cells,  ///< these boxes, cut off at their cells: what the shift of the means adds
    in_all,    ///< these boxes, cut off at the box of all points
    sampled    ///< pseudo-random points in the boxes: what the sampling adds
};

/// One domain to bisect.
struct SourceSetting {
    Source source = Source::points;
    int mesh = 0;         ///< of points: 0
    double k = 0;         ///< of all but points and cells
    double fraction = 0;  ///< of sampled; may be above 1
    std::uint64_t seed = 0;
};

/// Moments of the cells of a mesh as lean records bring them to the root. Not collective.
std::vector<rrcb::CellMoments> lean_cells(const rrcb::Points& points,
                                          const rrcb::SupportMesh& mesh);

/// A uniform patch in mean +- k sigma per cell, unlike in analytic_domain whatever lies there: what
/// sample_points become with ever more of them. Not collective.
rrcb::StatisticalDomain box_domain(std::span<const rrcb::CellMoments> cells, int dimension,
                                   double k);

/// Weight of every part when the bisection of that domain is applied to the points. Collective.
std::vector<double> source_part_weights(const SourceSetting& setting, const rrcb::Points& points,
                                        MPI_Comm comm);

/// The settings of error_sources.csv; `quick` leaves a few.
std::vector<SourceSetting> source_settings(bool quick);

/// Where the imbalance of an estimate comes from, on each cloud: error_sources.csv. Collective.
void find_error_sources(const Sweep& sweep);

}  // namespace comparisons
