#pragma once

#include "collective/butterfly_mpi.hpp"
#include "cuts/cut_limits.hpp"
#include "passes/open_points.hpp"
#include "search/tree_search.hpp"

#include <rrcb/options.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace rrcb {

/// Weights of the parts: of this rank's points, and their sums over all ranks.
class PartSums {
  public:
    /// Makes the buffers of add_up(), which other functions need too. Not collective. Throws
    /// std::bad_alloc.
    explicit PartSums(std::size_t num_parts) : here_(num_parts + 1), sums_(num_parts + 2) {}

    /// Returns the weights of this rank's points in each part, to be written before each add_up().
    std::span<double> here() { return std::span(here_).first(here_.size() - 1); }

    /// Adds them up on every rank; returns the imbalance of the sums.
    ///
    /// Collective: a reduction and a broadcast, which carry failures as well; throws if a rank has
    /// failed. `part_sizes` has one entry per part.
    double add_up(std::span<const double> part_sizes, Participant& self);

    /// Returns the latest sums, one entry per part.
    std::span<double> sums() { return std::span(sums_).first(sums_.size() - 2); }

    /// Moves the sums out, one entry per part.
    std::vector<double> take();

  private:
    std::vector<double> here_;  ///< the weights, then 1 if this rank failed
    std::vector<double> sums_;  ///< the sums, then the number of ranks that failed, and the
                                ///< imbalance
};

/// All points of a call, as far as their parts depend on them; the same on every rank.
struct AllPoints {
    GlobalCount number = 0;
    double weight = 0;           ///< to be balanced: their number if they are counted
    double heaviest = 0;         ///< of these weights
    bool are_counted = false;    ///< because all have the same weight or none
    Box box{};                   ///< around all
    double least_imbalance = 1;  ///< of any parts
    /// A search that cannot get below this imbalance is not made: it is that of the parts that the
    /// ranks hold, if these may be kept.
    double enough = std::numeric_limits<double>::infinity();
};

/// Cuts while they are refined, and the numbers of the report about their parts.
struct SettledCuts {
    Cuts cuts{};
    std::vector<Bracket> brackets{};     ///< intervals with which rank 0 begins its search
    std::vector<double> part_weights{};  ///< over all ranks, if counted; of this rank's
                                         ///< points if many ranks make the parts
    double imbalance = std::numeric_limits<double>::quiet_NaN();  ///< NaN if not counted
    int rounds = 0;
    int coincident_cuts = 0;
};

/// Gives all points their parts: by given cuts, or by a search for even parts, see TreeSearch.
///
/// Many ranks find the cuts, or rank 0 moves those of its estimate, unless they are good enough.
/// Buffers are made before the first message.
class Settlement {
  public:
    /// Borrows complete options, the points, and memory for open points. If `counts` is true, the
    /// points of the parts are counted even if no cut moves. Not collective. Throws Error or
    /// std::bad_alloc.
    Settlement(const Options& options, PointPasses& points, bool counts, OpenMemory& memory,
               const Participant& self);

    /// Moves the cuts of `start` if the options ask for it, and gives each point its part; `counts`
    /// if the parts of other cuts are counted all the same. `here` is the box of this rank's
    /// points. Runs once.
    ///
    /// Collective. A tolerance can be missed because upper levels used slack that lower ones need.
    /// Then, and if equal parts are empty although there are as many points, it searches once more,
    /// exactly, and keeps the better cuts. Limited cuts are all searched in their places, and the
    /// estimate is kept if it is better. A failure on one rank, before or here, is thrown on all.
    SettledCuts run(const AllPoints& all, const Box& here, bool counts, SettledCuts&& start,
                    Participant& self);

  private:
    void assign(bool counts, Participant& self);
    void refine(Participant& self);
    void start(Participant& self);
    bool is_least();
    bool accepts_cuts(Participant& self);
    void search_once(Participant& self);
    int run_rounds(std::optional<TreeSearch>& search, Participant& self);
    void search_for_better(Participant& self);
    void measure(Participant& self);
    std::ptrdiff_t num_left_empty();

    const Options& options_;
    PointPasses& points_;
    bool is_spread_;
    AllPoints all_{};
    Box here_{};
    SettledCuts made_{};
    PartSums sums_;
    OpenMemory& memory_;
    PartTree tree_;
    bool has_parts_ = false;           ///< the points have the parts of the cuts
    std::optional<CutLimits> limits_;  ///< empty if cuts are not limited
    Butterfly butterfly_;
    ButterflyMessages messages_;
    bool fills_parts_ = false;  ///< points suffice for all parts, which are to be equal
};

}  // namespace rrcb
