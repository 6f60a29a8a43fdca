#pragma once

#include "lists/group_numbers_mpi.hpp"
#include "zoltan/call/layout_mpi.hpp"
#include "zoltan/call/objects.hpp"
#include "zoltan/handle/numbering.hpp"

#include <optional>
#include <span>
#include <vector>

namespace rrcb::zoltan {

/// The gain of REMAP, without numbers, and the numbers.
struct Renumbered {
    Remap summary{};
    Numbering numbering{};
};

/// REMAP: numbers for the parts that keep objects in place, in the cases in which Zoltan does.
///
/// Parts of a group of the cuts, such as those of a machine, stay in one group. The numbers are
/// unchanged if REMAP is off, the parts differ in size, a part is on several ranks or there are
/// more than 2^17 parts. With one part on each rank an object is to be kept on its rank. Otherwise
/// it is to be kept in the part that the callbacks name, or on its rank if they name none on any
/// rank.
class Renumbering {
  public:
    /// Allocates all memory. `layout` outlives it. Throws std::bad_alloc, which all ranks must
    /// agree on before run(). Not collective.
    Renumbering(const Parameters& parameters, const Layout& layout, bool any_names_parts,
                const TreeShape& shape, const Communicator& comm);

    /// Writes the new numbers to `parts`. Collective if numbers may change, as find_numbers() is.
    Renumbered run(const Objects& objects, std::span<Part> parts, Participant& self);

  private:
    std::optional<GroupBuffers> buffers_;  ///< if numbers may change
    std::vector<Part> boxes_;              ///< memory for the box of each number
};

}  // namespace rrcb::zoltan
