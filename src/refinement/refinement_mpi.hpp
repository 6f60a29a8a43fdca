#pragma once

#include "cells/sorted_points.hpp"
#include "collective/participant.hpp"
#include "cuts/cut_limits.hpp"
#include "refinement/correction_mpi.hpp"
#include "refinement/level_search_mpi.hpp"
#include "refinement/part_sums_mpi.hpp"

#include <rrcb/method/bisection.hpp>
#include <rrcb/options.hpp>

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace rrcb {

/// Estimate that the refinement starts from; the same on every rank.
struct Estimate {
    Cuts cuts;
    std::vector<Bracket> brackets;  ///< one per cut
    double total_weight = 0;        ///< over all ranks
    double common_weight = 0;       ///< weight of each point where all weigh the same, else 0
    /// Of the parts that may stay instead; NaN where there are none.
    double current_imbalance = std::numeric_limits<double>::quiet_NaN();
    bool is_counted = false;  ///< `parts` and the sums hold what the cuts make, not good enough
    double heaviest = 0;      ///< weight of the heaviest point
    bool is_earlier = false;  ///< the cuts are those of an earlier call
    Box box{};                ///< of all points, if cuts are limited
};

/// The points by cells, for a search by levels. May throw. Made of a std::ref, it takes no memory.
using Bin = std::function<const BinnedPoints&()>;

/// Refined cuts and how even the parts really are; the same on every rank. The weights of the parts
/// are in the PartSums.
struct Refined {
    Cuts cuts;
    double imbalance = 1;
    int rounds = 0;           ///< of counting and deciding
    int coincident_cuts = 0;  ///< that keep points together which the target divides
};

/// Moves estimated cuts until the parts of the real points are as even as asked.
///
/// To a tolerance, all cuts are first corrected at once, see Correction. Where that does not serve,
/// the cuts of a level are searched all at once, one level after the other from the root of the
/// tree. What the messages need is made before the first of them, see LevelSearch.
class Refinement {
  public:
    /// By complete options. `options` and `sums` are borrowed. Not collective. Throws Error or
    /// std::bad_alloc.
    Refinement(const Options& options, int dimension, bool is_root, PartSums& sums);

    /// Refines the cuts of `estimate`, once.
    ///
    /// Collective. Writes the part of each point into `parts`; where the estimate is not good
    /// enough, and the current parts neither, and can't be corrected, it works on a sorted copy of
    /// the points. To a
    /// tolerance, cuts that divide well enough stay, with what lies below them. Where earlier cuts
    /// move, the parts below are counted anew, as most cuts there stay. Where a tolerance is missed
    /// because slack was spent on upper levels that lower ones need, it searches once more,
    /// exactly, and keeps the better cuts. Limited cuts are all searched in their places, along the
    /// axes of the estimate, and the estimate is kept where it is better. Without weight anywhere
    /// the cuts stay. What fails on one rank, before or here, is thrown on all, see
    /// LevelSearch::run.
    Refined refine(Estimate&& estimate, const Points& points, const Bin& bin, std::span<Part> parts,
                   Participant& self);

  private:
    void start(Estimate&& estimate, Participant& self);
    bool accept_estimate(const Points& points, std::span<Part> parts, Participant& self);
    bool correct(const Points& points, std::span<Part> parts, Participant& self);
    void search(const Bin& bin, std::span<Part> parts, Participant& self);
    void search_all_levels(const Bin& bin, std::span<Part> parts, Participant& self);
    void search_for_better(const Bin& bin, std::span<Part> parts, Participant& self);
    void measure(const Participant& self);
    bool needs_search(const Node& node) const;
    void write_parts(std::span<Part> parts);
    void start_level();
    Places places_of(const Node& node);
    CutSearch first_search(const Node& node, const Places& places) const;
    void set_aside(const Node& node, Cut& cut);
    Bracket bracket_of(const Node& node) const;
    void recount(std::span<Part> parts, Participant& self);
    void place_in_lots(const Participant& self);
    void weigh_divided(const Participant& self);
    void descend(Participant& self);

    const Options& options_;
    PartSums& sums_;
    Estimate estimate_;
    std::optional<CutLimits> limits_;  ///< nothing where cuts may lie anywhere
    TargetRule rule_;
    std::optional<Correction> correction_;  ///< to a tolerance, where cuts may lie anywhere
    SortedPoints points_;                   ///< where cuts are searched
    int depth_ = 0;                         ///< cuts above the current level
    std::vector<Node> nodes_;               ///< of the current level; capacity for any
    std::vector<Node> children_;            ///< of the next one
    LevelSearch level_;
    std::vector<double> lots_;  ///< for each cut that divides a lot, what of it is on lower ranks
    std::vector<std::size_t> divided_;  ///< children on both sides of these cuts
    Refined refined_;
};

}  // namespace rrcb
