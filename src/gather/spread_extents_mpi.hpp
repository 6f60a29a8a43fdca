#pragma once

#include "collective/butterfly_mpi.hpp"
#include "collective/participant.hpp"
#include "cuts/tree.hpp"
#include "gather/extent.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>

#include <optional>
#include <span>

namespace rrcb {

/// The parts that the ranks hold.
struct SpreadKeptTree {
    Cuts cuts;  ///< those above the part of this rank
    double imbalance = 1;
    int num_divided = 0;  ///< cuts that this rank owns and that divide coincident points
};

/// Extent of this rank's points. The owners of nodes read the extents of all ranks as a bisection,
/// with part r on rank r. As read_kept_tree(), except that with free axes a cut may be
/// across any long axis of the points that it divides.
class SpreadExtents {
  public:
    /// Takes complete options that ask for a part for each rank and outlive this. `may_keep` may
    /// differ between ranks; nothing is read unless all may. Not collective. Throws std::bad_alloc.
    SpreadExtents(const Options& options, const Extent& mine, bool may_keep, int dimension,
                  int rank);

    /// Returns the parts that the ranks hold; nullopt if they are no bisection. `total` is their
    /// weight or, `by_count`, their number of points.
    ///
    /// Collective: one pass of records to their owners, and if all may keep their points one of
    /// cuts back. A message has at most 16 (1 + dimension + dimension^2) bytes for each cut above a
    /// part. Throws the error of one rank on all; a failure in the last messages is held back until
    /// the next agreement.
    std::optional<SpreadKeptTree> read(double total, bool by_count, Participant& self);

  private:
    double share(double total, bool by_count) const;
    void tell_extents();
    bool decide_cuts();
    std::optional<Cut> cut_of(std::size_t node, const Extent& below, const Extent& above) const;
    SpreadKeptTree parts_told() const;

    const Options& options_;
    Extent mine_;
    bool may_keep_;
    int dimension_;
    Butterfly butterfly_;
    ButterflyMessages messages_{};
};

}  // namespace rrcb
