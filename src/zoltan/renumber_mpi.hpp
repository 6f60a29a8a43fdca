#pragma once

#include "layout_mpi.hpp"
#include "objects.hpp"

#include <rrcb/remap.hpp>

#include <mpi.h>

#include <span>

namespace rrcb::zoltan {

/// REMAP: numbers for the parts that keep objects in place, looked for where Zoltan looks for them.
///
/// The numbers stay where REMAP is off, the parts differ in size or a part is on several ranks.
/// With one part on each rank an object is to stay on its rank; otherwise in the part the callbacks
/// name, or on its rank where they name none. Writes the new numbers to `parts`. Collective over
/// `comm` where it looks.
Remap renumber(const Parameters& parameters, const Layout& layout, const Objects& objects,
               std::span<Part> parts, MPI_Comm comm);

}  // namespace rrcb::zoltan
