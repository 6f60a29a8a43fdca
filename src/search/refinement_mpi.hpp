#pragma once

#include "collective/butterfly_mpi.hpp"
#include "collective/participant.hpp"
#include "cuts/cut_limits.hpp"
#include "passes/host_passes.hpp"
#include "search/part_sums_mpi.hpp"
#include "search/tree_search.hpp"
#include "search/workspace_mpi.hpp"

#include <rrcb/method/bisection.hpp>
#include <rrcb/options.hpp>

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace rrcb {

/// Runs the rounds of searches, with buffers made before the first message.
class TreeRounds {
  public:
    /// Not collective. Throws std::bad_alloc.
    TreeRounds(int rank, int num_ranks, Butterfly::Way way)
        : butterfly_(rank, num_ranks, TreeSearch::join, way) {}

    /// Ends a search, which this rank lacks if it has failed; returns the number of rounds.
    ///
    /// Collective: each round is a pass to the owners and one back, and a spread search ends with
    /// one to the owners. Throws on every rank the failure of one, before or here; a failure in the
    /// last messages is held back until the next agreement.
    int run(std::optional<TreeSearch>& search, Participant& self);

    /// Returns the imbalance of all parts after a spread search; the same on every rank.
    double imbalance() const { return butterfly_.flags()[2]; }

    int rank() const { return butterfly_.rank(); }

  private:
    Butterfly butterfly_;
    ButterflyMessages messages_;
};

/// Estimate that the refinement starts from; the same on every rank.
struct Estimate {
    Cuts cuts;
    std::vector<Bracket> brackets;  ///< one per cut
    double total_weight = 0;        ///< over all ranks
    double common_weight = 0;       ///< weight of each point if all weigh the same, else 0
    /// Imbalance of the current distribution, if that may be kept instead; else infinite.
    double kept_imbalance = std::numeric_limits<double>::infinity();
    bool is_counted = false;     ///< points and PartSums have the parts of the cuts
    double heaviest = 0;         ///< weight of the heaviest point
    bool is_earlier = false;     ///< the cuts are those of an earlier call
    Box box{};                   ///< of all points, if cuts are limited
    GlobalCount num_points = 0;  ///< over all ranks
    double least_imbalance = 1;  ///< of any partition: a bound
};

/// Refined cuts and their measured imbalance; the same on every rank. After a central refinement
/// the weights of the parts are in the PartSums.
struct Refined {
    Cuts cuts;
    double imbalance = 1;
    int rounds = 0;           ///< of counting and deciding
    int coincident_cuts = 0;  ///< through coincident points, which share a part all the same
};

/// Moves estimated cuts until all parts are as even as requested; rank 0 decides.
///
/// The cuts are searched, see TreeSearch, unless the estimated ones are within the tolerance.
/// Buffers are made before the first message.
class Refinement {
  public:
    /// Takes complete options. `options` and `sums` are borrowed. Not collective. Throws Error or
    /// std::bad_alloc.
    Refinement(const Options& options, const Participant& self, PartSums& sums);

    /// Refines the cuts of `estimate`, once.
    ///
    /// Collective. `box` is that of the points. Gives each point its part. A tolerance can be
    /// missed because upper levels used slack that lower ones need. Then, and if equal parts are
    /// empty although there are as many points, it searches once more, exactly, and keeps the
    /// better cuts. Earlier cuts are kept if the others are no better. Limited cuts are all
    /// searched in their places, and the estimate is kept if it is better. Without weight the cuts
    /// are kept. A failure on one rank, before or here, is thrown on all.
    Refined refine(Estimate&& estimate, PointPasses& points, const Box& box, Participant& self);

  private:
    void start(Estimate&& estimate, Participant& self);
    bool is_least() const;
    bool accept_estimate(PointPasses& points, Participant& self);
    void search_exactly(PointPasses& points, Participant& self);
    void search_once(PointPasses& points, Participant& self);
    void search_for_better(PointPasses& points, Participant& self);
    void measure(Participant& self);
    std::ptrdiff_t num_left_empty() const;

    const Options& options_;
    PartSums& sums_;
    Workspace& memory_;
    PartTree tree_;
    Estimate estimate_;
    Box box_;                          ///< of this rank's points
    bool has_parts_ = false;           ///< the points have the parts of the cuts
    std::optional<CutLimits> limits_;  ///< empty if cuts are not limited
    TreeRounds rounds_;
    bool fills_parts_ = false;  ///< points suffice for all parts, which are to be equal
    Refined refined_;
};

/// Returns the parts of complete options, which it borrows; of the rule only what options choose.
PartTree tree_of(const Options& options, int num_ranks);

/// Makes the parts by a search of many ranks: the owners of nodes decide. Buffers are made before
/// the first message.
class SpreadRefinement {
  public:
    /// Not collective. Throws Error or std::bad_alloc.
    explicit SpreadRefinement(const Participant& self);

    /// Finds the cuts of all points, which are in `box`, and gives each point its part. Returns the
    /// cuts that this rank knows.
    ///
    /// Collective. `box` and `tree` are the same on every rank. If a tolerance is missed, it
    /// searches once more, exactly, and keeps the better cuts. Throws on every rank the failure of
    /// one, before or here; a failure in the last messages is held back until the next agreement.
    Refined refine(const Box& box, PartTree tree, HostPasses& points, Participant& self);

  private:
    Refined search(const Box& box, const PartTree& tree, HostPasses& points, Participant& self);

    Workspace& memory_;
    TreeRounds rounds_;
};

}  // namespace rrcb
