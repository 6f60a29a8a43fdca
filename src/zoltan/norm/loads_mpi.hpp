#pragma once

#include "zoltan/norm/multicriteria.hpp"

#include <rrcb/points.hpp>

#include <mpi.h>

#include <vector>

namespace rrcb::zoltan {

/// Whole units for weights: as fine as they can be while no sum over all objects overflows.
struct Units {
    Factors per_weight{};  ///< units in a weight of 1, powers of 2
    Factors heaviest{};    ///< object, in units; of the number of objects 1
};

/// Collective: two reductions. `num_objects` is that of all ranks.
Units choose_units(const Criteria& criteria, GlobalCount num_objects, MPI_Comm comm);

/// Loads of the objects. Throws std::bad_alloc.
std::vector<Load> loads_of(const Criteria& criteria, const Units& units);

}  // namespace rrcb::zoltan
