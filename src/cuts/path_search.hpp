#pragma once

#include "collective/butterfly.hpp"
#include "cuts/owned_cuts.hpp"

#include <rrcb/points.hpp>

#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Search of the parts of points by cuts of which each rank knows some: one rank's part in it,
/// without the messages.
///
/// The tree is looked at in tiers, of 6 levels at its top and of 7 below. First each rank shares
/// the cuts that it owns: the owner of the first node of a tier gets the cuts of that tier, 127 at
/// most. Then ranks ask the owners for the tiers that they lack, until all parts are known: once
/// for each tier on the way, twice in trees of up to 2^20 parts of which all know the top one.
///
/// Join the shared with join_cuts() and the asked with join_questions().
class PathSearch {
  public:
    /// Of points whose `parts` are told by `known`, or unknown_below() a node. The points and their
    /// parts outlive it.
    PathSearch(const Cuts& known, const Points& points, std::span<Part> parts);

    /// Adds the cuts that this rank owns. Throws Error where it lacks one.
    void share(Butterfly& shared) const;

    /// Adds a record for each tier that this rank lacks. Returns whether there are any.
    bool ask(Butterfly& asked);

    /// Answers the records that came to this rank, after `shared` has got to all owners.
    void answer(const Butterfly& shared, Butterfly& asked) const;

    /// Follows the points with the cuts that came back. Throws Error where some did not.
    void learn(const Butterfly& asked);

    /// Points whose parts were not known at first.
    std::span<const LocalIndex> searched() const { return searched_; }

    /// The cuts that were known, and those that came.
    Cuts take() { return std::move(cuts_); }

    static void join_cuts(std::span<const double> a, std::span<const double> b,
                          std::vector<double>& joined);
    static void join_questions(std::span<const double>, std::span<const double>,
                               std::vector<double>&) {}

  private:
    Descent tier_of(std::size_t node) const;
    void follow();

    Cuts cuts_;
    const Points& points_;
    std::span<Part> parts_;
    std::vector<LocalIndex> searched_;
    std::vector<LocalIndex> left_;  ///< of them, those whose parts are not known yet
    std::vector<Key> tiers_;        ///< that were asked for
};

}  // namespace rrcb
