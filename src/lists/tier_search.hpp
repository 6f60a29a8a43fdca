#pragma once

#include "collective/butterfly.hpp"
#include "cuts/tree.hpp"

#include <rrcb/points.hpp>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Local part, without messages, of a search for cuts distributed over the ranks.
///
/// The tree is divided into tiers, of 6 levels at the top and of 7 below. First each rank shares
/// the cuts that it owns: the owner of the first node of a tier gets its cuts, at most 127. Then
/// ranks ask these owners for missing tiers: once for each tier on the way down, or twice in trees
/// of up to 2^20 parts if all ranks know the top tier.
///
/// Butterflies named `shared` join by join_cuts(), those named `asked` by join_questions().
class TierSearch {
  public:
    explicit TierSearch(const Cuts& known) : cuts_(known) {}

    /// Adds this rank's own cuts. Throws Error if one is missing.
    void share(Butterfly& shared) const;

    /// Adds a record for the tier of each node whose cut is missing.
    void ask(std::span<const std::size_t> nodes, Butterfly& asked);

    /// Answers the records received, once all owners have `shared`.
    void answer(const Butterfly& shared, Butterfly& asked) const;

    /// Takes the cuts of the answers. Throws Error if some are missing.
    void learn(const Butterfly& asked);

    /// Returns the known cuts, and the received ones.
    const Cuts& cuts() const { return cuts_; }
    Cuts take() { return std::move(cuts_); }

    static void join_cuts(std::span<const double> a, std::span<const double> b,
                          std::vector<double>& joined);
    static void join_questions(std::span<const double>, std::span<const double>,
                               std::vector<double>&) {}

  private:
    Descent tier_of(std::size_t node) const;

    Cuts cuts_;
    std::vector<Key> tiers_;  ///< asked for
};

/// Finds the parts of points by cuts distributed over the ranks.
class PathSearch : public TierSearch {
  public:
    /// Takes points whose `parts` were found by `known`, or are unknown_below() a node. The points
    /// and their parts outlive it.
    PathSearch(const Cuts& known, const Points& points, std::span<Part> parts);

    /// Follows the points with the cuts received, and asks for the missing ones. Returns whether
    /// any are missing.
    bool ask(Butterfly& asked);

    /// Returns the points whose parts were unknown at first.
    std::span<const LocalIndex> searched() const { return searched_; }

  private:
    const Points& points_;
    std::span<Part> parts_;
    std::vector<LocalIndex> searched_;
    std::vector<LocalIndex> left_;  ///< of these, the ones with parts still unknown
};

}  // namespace rrcb
