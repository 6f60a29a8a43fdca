#pragma once

#include "collective/participant.hpp"
#include "refinement/candidates_mpi.hpp"
#include "refinement/histogram_mpi.hpp"
#include "refinement/target_rule.hpp"

#include <span>
#include <vector>

namespace rrcb {

/// Node of the tree: its points on this rank, and its weight over all ranks.
struct Node {
    Descent at;
    std::vector<Fragment> fragments;
    double weight = 0;
    bool is_counted = false;     ///< what its parts weigh by the cuts as they are
    double below = not_counted;  ///< weight below the cut as it is, where that was counted
    Box region{};                ///< of the space, where cuts are limited
};

/// Searches for all cuts of one level at once, in step on all ranks.
///
/// The constructor makes all that the messages and their lengths depend on: a rank that runs out of
/// memory later can still take part until all have been told.
class LevelSearch {
  public:
    /// Makes buffers for `most` searches at once. Not collective. Throws Error or std::bad_alloc.
    LevelSearch(std::size_t most, const HistogramLayout& layout, int dimension, bool is_root);

    void clear();

    /// Adds the search for the cut of a node, in its places, from `start` on; `node` and `points`
    /// are borrowed and must not change before clear(). The same on every rank, in the same order.
    /// Not collective.
    void add(const Node& node, const CutSearch& start, const Places& places,
             const SortedPoints& points);

    /// Ends all searches, in at most 16 rounds, see decide_by_bins; returns how many it took.
    ///
    /// Collective. Each round takes a reduction and a broadcast, and where searches end in
    /// gathering their candidates a gather: 65,536 points at most, of all searches together. A rank
    /// that fails on its own, before or here, takes part with nothing until the root, told of it by
    /// the next histograms or candidates, ends all searches; then all throw its error.
    int run(const TargetRule& rule, Participant& self);

    std::size_t size() const { return searches_.size(); }
    const Node& node(std::size_t k) const { return *nodes_[k]; }

    /// Search number k in the order added.
    const CutSearch& search(std::size_t k) const { return searches_[k]; }

  private:
    void count(std::size_t k, Participant& self);
    void decide_counted(std::size_t k, std::span<const double> histogram, const TargetRule& rule);
    void count_and_decide(const TargetRule& rule, Participant& self);
    void gather_and_decide(Participant& self);
    void conclude(Participant& self);
    void follow(Participant& self);

    int dimension_;
    bool is_root_;

    // One entry per search; capacity for any.
    std::vector<const Node*> nodes_;
    std::vector<Places> places_;
    std::vector<CutSearch> searches_;
    std::vector<CutSearch> before_;   ///< the searches before the root decided
    std::vector<CutTarget> targets_;  ///< at the root only
    std::vector<LocalSearch> local_;

    std::vector<std::size_t> samples_;  ///< histograms of this round that hold one
    Histograms histograms_;
    Candidates candidates_;
};

}  // namespace rrcb
