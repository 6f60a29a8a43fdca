#pragma once

#include "../support/clouds.hpp"
#include "../support/ranks.hpp"
#include "refinement/level_search_mpi.hpp"

#include <limits>
#include <vector>

namespace rrcb::test {

inline constexpr LocalIndex points_per_rank = 3000;

/// A level of one node, which is to be halved across the first axis.
class Level {
  public:
    Level() : coordinates_(uniform_cloud(points_per_rank, 2, seed())) {
        const Points points = interleaved_points(coordinates_, 2);
        const SupportMesh mesh = make_support_mesh(bounding_box(points), 2, 4);
        points_ = sort_by_cell(bin_by_cell(points, mesh));
        const double weight = static_cast<double>(points_per_rank) * num_ranks();
        node_ = {{0, 0, 2}, cell_fragments(points_), weight};
        rule_.part_sizes = sizes_;
        rule_.common_weight = 1;
        rule_.is_exact = true;
        start_.cut.at.fill(-std::numeric_limits<double>::infinity());
        start_.upper = 1;
        start_.num_axes = 2;
        start_.quantum = quantum_for(weight);
    }

    /// Searches from the start, whatever was found before. Collective.
    int run(Participant& self) {
        level_.clear();
        level_.add(node_, start_, {}, points_);
        return level_.run(rule_, self);
    }
    const CutSearch& search() const { return level_.search(0); }

    /// Points of all ranks below the cut found.
    double below() const {
        double below = 0;
        for (LocalIndex i = 0; i < points_.count(); ++i)
            below += is_above(search().cut, points_.position(i), 2) ? 0 : 1;
        MPI_Allreduce(MPI_IN_PLACE, &below, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        return below;
    }

  private:
    static unsigned seed() { return static_cast<unsigned>(rank()) + 1; }

    std::vector<double> coordinates_;
    std::vector<double> sizes_{1, 1};
    SortedPoints points_;
    Node node_;
    TargetRule rule_;
    CutSearch start_;
    LevelSearch level_{1, {}, 2, rank() == 0};
};

}  // namespace rrcb::test
