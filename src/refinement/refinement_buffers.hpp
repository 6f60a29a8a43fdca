#pragma once

#include "cuts/tree.hpp"
#include "refinement/candidates_mpi.hpp"
#include "refinement/histogram_mpi.hpp"

#include <rrcb/options.hpp>

#include <vector>

namespace rrcb {

/// A node of the current level: what of it lies here, and what it weighs over all ranks.
struct Node {
    Descent at;
    std::vector<Fragment> fragments;
    double weight = 0;
};

/// What the messages of a refinement need, and what tells their lengths. Made before the first of
/// them: a rank that runs out of memory later can still take part until all have been told.
struct RefinementBuffers {
    /// By complete options. Not collective. Throws Error or std::bad_alloc.
    RefinementBuffers(const Options& options, int dimension, bool is_root);

    std::vector<double> part_weights;  ///< of this rank's points; at the end 1 where it failed
    std::vector<double> sums;          ///< of all ranks; at the end the imbalance
    std::vector<Node> nodes;           ///< of the current level; capacity for any
    std::vector<Node> children;        ///< of the next one

    // The searches of the current level, in step on all ranks; capacity for any.
    std::vector<const Node*> searched;
    std::vector<CutSearch> searches;
    std::vector<CutSearch> before;  ///< the searches before the root decided
    std::vector<CutTarget> targets;
    std::vector<LocalSearch> local;
    std::vector<std::size_t> samples;  ///< histograms of this round that hold one
    std::vector<double> lots;          ///< weights at the cuts found

    Histograms histograms;
    Candidates candidates;
};

}  // namespace rrcb
