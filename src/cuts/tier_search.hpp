#pragma once

#include "collective/butterfly.hpp"
#include "cuts/owned_cuts.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Search for cuts of which each rank knows some: one rank's part in it, without the messages.
///
/// The tree is looked at in tiers, of 6 levels at its top and of 7 below. First each rank shares
/// the cuts that it owns: the owner of the first node of a tier gets the cuts of that tier, 127 at
/// most. Then ranks ask the owners for the tiers that they lack, until they lack none: once for
/// each tier on the way down, twice in trees of up to 2^20 parts of which all know the top one.
///
/// Join the shared with join_cuts() and the asked with join_questions().
class TierSearch {
  public:
    explicit TierSearch(const Cuts& known) : cuts_(known) {}

    /// Adds the cuts that this rank owns. Throws Error where it lacks one.
    void share(Butterfly& shared) const;

    /// Adds a record for each tier that nodes are in, whose cuts this rank lacks.
    void ask(std::span<const std::size_t> nodes, Butterfly& asked);

    /// Answers the records that came to this rank, after `shared` has got to all owners.
    void answer(const Butterfly& shared, Butterfly& asked) const;

    /// Takes the cuts that came back. Throws Error where some did not.
    void learn(const Butterfly& asked);

    /// The cuts that were known, and those that came.
    const Cuts& cuts() const { return cuts_; }
    Cuts take() { return std::move(cuts_); }

    static void join_cuts(std::span<const double> a, std::span<const double> b,
                          std::vector<double>& joined);
    static void join_questions(std::span<const double>, std::span<const double>,
                               std::vector<double>&) {}

  private:
    Descent tier_of(std::size_t node) const;

    Cuts cuts_;
    std::vector<Key> tiers_;  ///< that were asked for
};

}  // namespace rrcb
