#pragma once

#include "cells/cell_set.hpp"

#include <rrcb/options.hpp>
#include <rrcb/statistical_domain.hpp>

namespace rrcb {

/// Traits of a kind of statistical domain, for each stage; its name is in the table of options.
struct DomainTraits {
    DomainKind kind;
    bool sends_points;        ///< the root gets the points themselves, not moments of cells;
                              ///< then there is nothing left to refine
    bool has_lean_cells;      ///< the root gets the moments of cells rounded, see LeanCells
    bool builds_on_last;      ///< a call may keep the parts points lie in, or refine the cuts
                              ///< before; others begin anew
    bool is_random;           ///< the seed decides, too
    Refine automatic_refine;  ///< what Refine::automatic stands for
    double share_of_longest;  ///< axes of at least this share of the longest extent count as equal
    /// Makes the domain from the cells of all ranks and the box of their points; null where points
    /// are sent.
    StatisticalDomain (*build)(const CellSet& cells, int dimension, const Box& box,
                               const Options& options);
};

/// Traits of a kind. Throws Error where there are none.
const DomainTraits& traits_of(DomainKind kind);

/// Options with nothing left to default but the sizes of equal parts. Throws Error where they name
/// no kind.
Options complete(Options options, int num_ranks);

}  // namespace rrcb
