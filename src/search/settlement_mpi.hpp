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

/// Weights of the parts: sums over this rank's points, and over the points of all ranks.
class PartSums {
  public:
    /// Makes the buffers, which all other functions use. Not collective. Throws std::bad_alloc.
    explicit PartSums(std::size_t num_parts) : here_(num_parts + 1), sums_(num_parts + 2) {}

    /// Returns the weight of this rank's points in each part. The caller must write it before each
    /// add_up().
    std::span<double> here() { return std::span(here_).first(here_.size() - 1); }

    /// Adds up the weights on every rank. Returns the imbalance of the sums.
    ///
    /// Collective: a reduction and a broadcast, which also carry failures. Throws if a rank has
    /// failed. `part_sizes` has one entry for each part.
    double add_up(std::span<const double> part_sizes, Participant& self);

    /// Returns the latest sums, one for each part.
    std::span<double> sums() { return std::span(sums_).first(sums_.size() - 2); }

    /// Moves the sums out, one for each part.
    std::vector<double> take();

  private:
    std::vector<double> here_;  ///< the weights, then 1 if this rank has failed
    std::vector<double> sums_;  ///< the sums, then the number of failed ranks, then the imbalance
};

/// Numbers about all points of a call that affect their parts. They are the same on every rank.
struct AllPoints {
    GlobalCount number = 0;
    double weight = 0;         ///< weight to be balanced; the number of points if they are counted
    double heaviest = 0;       ///< largest of the weights to be balanced
    bool are_counted = false;  ///< whether points are counted, because all have the same weight or
                               ///< none
    Box box{};                 ///< around all
    double least_imbalance = 1;  ///< lower bound for any parts
    /// Imbalance of the parts that the ranks hold now, if these may be kept. If it is within the
    /// tolerance, no search is made.
    double enough = std::numeric_limits<double>::infinity();
};

/// Cuts that are being refined, and the numbers of the report about their parts.
struct SettledCuts {
    Cuts cuts{};
    std::vector<Bracket> brackets{};     ///< intervals in which rank 0 starts its search
    std::vector<double> part_weights{};  ///< over all ranks, if counted; of this rank's points
                                         ///< only, if many ranks make the parts
    double imbalance = std::numeric_limits<double>::quiet_NaN();  ///< NaN if not counted
    int rounds = 0;
    int coincident_cuts = 0;
};

/// Gives all points their parts: by given cuts, or by a search for even parts, see TreeSearch.
///
/// If many ranks make the parts, they find all cuts. Otherwise rank 0 moves the cuts of its
/// estimate, unless these are good enough. All buffers are made before the first message.
class Settlement {
  public:
    /// Borrows the complete options, the points, and memory for open points. If `counts`, the parts
    /// are counted even if no cut moves. Not collective. Throws Error or std::bad_alloc.
    Settlement(const Options& options, PointPasses& points, bool counts, OpenMemory& memory,
               const Participant& self);

    /// Moves the cuts of `start` if the options ask for it, and gives each point its part. If
    /// `counts`, the weights of the parts are added up in any case. `here` is the box of this
    /// rank's points. May be called only once.
    ///
    /// Collective. The tolerance may be missed because the upper levels used slack that lower
    /// levels need. In this case, and if parts of equal size are empty although there are enough
    /// points, it searches once more for exact cuts and keeps the better ones. Limited cuts are all
    /// searched among their allowed positions; the estimate is kept if it is better. If a rank has
    /// failed before or fails here, all ranks throw its error.
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
    bool has_parts_ = false;           ///< whether the points have the parts of the cuts
    std::optional<CutLimits> limits_;  ///< empty if cuts are not limited
    Butterfly butterfly_;
    ButterflyMessages messages_;
    bool fills_parts_ = false;  ///< whether all parts should have points: there are enough, and the
                                ///< parts have equal sizes
};

}  // namespace rrcb
