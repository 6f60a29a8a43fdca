#pragma once

#include "lists/tier_search_mpi.hpp"
#include "passes/assignment.hpp"

#include <rrcb/balance.hpp>

#include <map>
#include <span>

namespace rrcb {

struct Verdict;

/// Reuse of earlier cuts, distributed or complete. Memory is in proportion to the parts of a rank's
/// points, and the cuts above them.
class SpreadReuse {
  public:
    /// Takes cuts with their numbers, and the `parts` of the points and their `totals` by these.
    /// All except the cuts outlive it. Not collective; throws std::bad_alloc, and Error if the rank
    /// lacks a cut that it owns.
    SpreadReuse(const Cuts& cuts, const KnownTotals& totals, bool was_whole, const Options& options,
                const Points& points, std::span<Part> parts, MPI_Comm comm);

    /// Finds the parts of all points and counts them. Returns false if they are not within the
    /// tolerance. Otherwise it completes the report of `result`, and stores the cuts above the
    /// points and parts of this rank.
    ///
    /// Collective: one pass through the ranks to find the parts, or more if one lacks cuts, one to
    /// add up and one to compare.
    bool ends(const Verdict& verdict, Balance& result, Participant& self);

  private:
    double measure(double total_weight, bool by_count, Participant& self);
    void add_up(bool by_count);
    double largest_share(double total_weight) const;
    Cuts kept_cuts() const;

    const Options& options_;
    const Points& points_;
    std::span<Part> parts_;
    const KnownTotals& totals_;
    bool was_whole_;
    Cuts cuts_;  ///< those that the search has found, too
    SearchBuffers<PathSearch> buffers_;
    Butterfly sums_;
    std::map<Part, double> weights_{};  ///< of the points here, in each part
};

}  // namespace rrcb
