#pragma once

#include "zoltan/norm/multicriteria.hpp"

#include <rrcb/points.hpp>

#include <mpi.h>

#include <vector>

namespace rrcb::zoltan {

/// Units in which weights are whole numbers: the finest in which no sum over all objects overflows.
struct Units {
    Factors per_weight{};  ///< units in a weight of 1, powers of 2
    Factors heaviest{};    ///< weight of an object, in units; 1 for the number of objects
};

/// Units for the weights of all ranks. Collective: two reductions. `num_objects` is that of all
/// ranks.
Units choose_units(const Criteria& criteria, GlobalCount num_objects, MPI_Comm comm);

/// Loads of the objects. Throws std::bad_alloc.
std::vector<Load> loads_of(const Criteria& criteria, const Units& units);

}  // namespace rrcb::zoltan
