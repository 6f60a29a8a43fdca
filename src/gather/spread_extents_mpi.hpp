#pragma once

#include "collective/butterfly_mpi.hpp"
#include "collective/participant.hpp"
#include "cuts/tree.hpp"
#include "gather/extent.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>

#include <map>
#include <optional>
#include <span>

namespace rrcb {

/// The parts that the ranks hold.
struct SpreadKeptTree {
    Cuts cuts;  ///< those above the part of this rank
    double imbalance = 1;
    int num_divided = 0;  ///< cuts that this rank owns and that divide points in one place
};

/// The extent of this rank's points, which owners of nodes read with those of the others as a
/// bisection, part r being on rank r. As read_kept_tree(), but if axes are free a cut may be
/// across any long one of the points that it divides.
class SpreadExtents {
  public:
    /// By complete options that ask for a part for each rank and outlive this. `may_keep` may
    /// differ between ranks; nothing is read unless all may. Not collective. Throws std::bad_alloc.
    SpreadExtents(const Options& options, const Extent& mine, bool may_keep, int dimension,
                  int rank);

    /// The parts that the ranks hold, of the weight `total` together or, `by_count`, of as many
    /// points; nothing if they are no bisection. `regions` has the cuts of rank 0 between regions.
    ///
    /// Collective: one pass of records to their owners, and if all may keep theirs one of cuts
    /// back. A message has 16 (1 + dimension + dimension^2) bytes at most for each cut above a
    /// part. Throws the error of one rank on all; but a failure in the last messages stays with its
    /// rank for the next agreement.
    std::optional<SpreadKeptTree> read(double total, bool by_count, const Cuts& regions,
                                       Participant& self);

  private:
    double share(double total, bool by_count) const;
    void tell_extents();
    void note_axes(const Descent& region, const Descent& at, std::span<const Cut> cuts);
    bool decide_cuts();
    std::optional<Cut> cut_of(std::size_t node, const Extent& below, const Extent& above) const;
    SpreadKeptTree parts_told() const;

    const Options& options_;
    Extent mine_;
    bool may_keep_;
    int dimension_;
    std::map<std::size_t, int> region_axes_{};  ///< of the cuts between regions, by node
    Butterfly butterfly_;
    ButterflyMessages messages_{};
};

}  // namespace rrcb
