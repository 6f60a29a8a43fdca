#pragma once

#include <rrcb/bisection.hpp>
#include <rrcb/options.hpp>
#include <rrcb/sorted_points.hpp>

#include <mpi.h>

#include <span>

namespace rrcb {

/// What the refinement starts from; the same on every rank.
struct Estimate {
    Cuts cuts;
    std::vector<Bracket> brackets;   ///< one per cut
    std::vector<double> part_sizes;  ///< one per part
    double total_weight = 0;         ///< over all ranks
};

/// How good the parts really are, and what it took to know; the same on every rank.
struct Measured {
    double imbalance = 1;
    int rounds = 0;           ///< of counting and deciding
    int coincident_cuts = 0;  ///< that keep points together which the target divides
};

/// Moves the cuts of `estimate` until the parts of the real points are as even as asked.
///
/// Collective over `comm`. Writes the part of each point, by its original index, into `parts`;
/// entries of `points` change places within their cells. Without weight anywhere the cuts stay.
/// A rank that fails on its own goes on with what it has; at the end all throw its error.
Measured refine(Estimate& estimate, const Options& options, SortedPoints& points, MPI_Comm comm,
                std::span<Part> parts);

}  // namespace rrcb
