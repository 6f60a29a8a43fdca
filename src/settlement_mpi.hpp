#pragma once

#include "collective/butterfly_mpi.hpp"
#include "cuts/cut_limits.hpp"
#include "search/tree_search.hpp"
#include "workspace_mpi.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

struct Call;

/// Weights of the parts: of this rank's points, and their sums over all ranks.
class PartSums {
  public:
    PartSums() = default;

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

/// Searches for the cuts of a call until all parts are as even as requested, see TreeSearch.
///
/// Many ranks find the cuts, or rank 0 moves the cuts of its decision, unless they are good enough.
/// Buffers are made before the first message.
class Refinement {
  public:
    /// Borrows the call, whose options are complete. Not collective. Throws Error or
    /// std::bad_alloc.
    Refinement(Call& call, const Participant& self);

    /// Replaces the cuts of the call, gives each point its part, and reports. Runs once.
    ///
    /// Collective. A tolerance can be missed because upper levels used slack that lower ones need.
    /// Then, and if equal parts are empty although there are as many points, it searches once more,
    /// exactly, and keeps the better cuts. Earlier cuts are kept if the others are no better.
    /// Limited cuts are all searched in their places, and the estimate is kept if it is better. A
    /// failure on one rank, before or here, is thrown on all.
    void run(Participant& self);

  private:
    bool is_earlier() const;
    bool are_earlier_counted() const;
    void start(Participant& self);
    bool is_least() const;
    bool accepts_cuts(Participant& self);
    void search_once(Participant& self);
    int run_rounds(std::optional<TreeSearch>& search, Participant& self);
    void search_for_better(Participant& self);
    void measure(Participant& self);
    std::ptrdiff_t num_left_empty() const;

    Call& call_;
    Workspace& memory_;
    PartTree tree_;
    bool has_parts_ = false;           ///< the points have the parts of the cuts
    std::optional<CutLimits> limits_;  ///< empty if cuts are not limited
    Butterfly butterfly_;
    ButterflyMessages messages_;
    bool fills_parts_ = false;  ///< points suffice for all parts, which are to be equal
    double imbalance_ = 1;      ///< of the latest cuts
};

/// Makes the buffers of settle(); `counts` if it may have to count. Not collective.
void prepare_to_settle(Call& call, bool counts, const Participant& self);

/// Makes the parts: by a search of many ranks, or from the cuts of rank 0, which move by counts of
/// all ranks unless the options forbid it; `counts` if parts are counted all the same. Collective.
void settle(Call& call, bool counts, Participant& self);

}  // namespace rrcb
