#pragma once

#include "gather/decision_mpi.hpp"
#include "gather/spread_extents_mpi.hpp"

#include <rrcb/balance.hpp>

#include <limits>
#include <optional>

namespace rrcb {

/// The parts that the ranks hold, one each, in which the points may be kept. Rank 0 reads them from
/// the extents of all ranks. If many ranks make the parts, these ranks read them.
class KeptParts {
  public:
    /// Notes the extent of this rank's points, which are checked and add up to `mine`; adds it to
    /// `mine` if rank 0 reads it. Not collective. Throws std::bad_alloc. `options` outlive this.
    void prepare(const Options& options, bool is_spread, const Points& points, bool may_keep,
                 int rank, int num_ranks, Contribution& mine);

    /// Returns true if rank 0 may read them.
    bool is_central() const { return is_central_; }

    /// Determines their imbalance; `estimate` has the cuts and the report of rank 0. Collective if
    /// many ranks make the parts.
    void read(const Verdict& verdict, const Balance& estimate, Participant& self);

    /// Returns true if the ranks hold parts, so even that no better ones are searched for.
    bool are_good(double tolerance) const;

    /// Returns true if the ranks hold parts, and those of another `imbalance` are not worth moving
    /// points.
    bool do_as_well_as(double imbalance, const Options& options) const;

    /// Makes the kept parts the result. Collective.
    void keep(const Options& options, Decision& decision, Balance& result, Participant& self);

  private:
    void keep_central(const Options& options, Decision& decision, Balance& result,
                      Participant& self) const;

    bool is_central_ = false;
    std::optional<SpreadExtents> extents_;  ///< if many ranks make the parts
    SpreadKeptTree spread_;
    double imbalance_ = not_kept;
};

}  // namespace rrcb
