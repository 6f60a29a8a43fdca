#pragma once

#include "lists/group_numbers_mpi.hpp"
#include "zoltan/call/layout_mpi.hpp"
#include "zoltan/call/objects.hpp"
#include "zoltan/handle/numbering.hpp"

#include <optional>
#include <span>
#include <vector>

namespace rrcb::zoltan {

/// Result of REMAP: its gain (without the numbers), and the numbers.
struct Renumbered {
    Remap summary{};
    Numbering numbering{};
};

/// REMAP: finds numbers for the parts that keep objects in place, in the same cases as Zoltan.
///
/// Parts of one group of the cuts, for example those of a machine, remain in one group. The numbers
/// are unchanged if REMAP is off, if the parts differ in size, if a part is on several ranks, or if
/// there are more than 2^17 parts. If each rank has one part, objects are to be kept on their rank.
/// Otherwise they are to be kept in the part that the callbacks return; if no rank has such a
/// callback, on their rank.
class Renumbering {
  public:
    /// Allocates all memory. `layout` must outlive this object. Throws std::bad_alloc, on which all
    /// ranks must agree before run(). Not collective.
    Renumbering(const Parameters& parameters, const Layout& layout, bool any_names_parts,
                const TreeShape& shape, const Communicator& comm);

    /// Writes the new numbers to `parts`. Collective as find_numbers() if numbers may change.
    Renumbered run(const Objects& objects, std::span<Part> parts, Participant& self);

  private:
    std::optional<GroupBuffers> buffers_;  ///< empty if numbers cannot change
    std::vector<Part> boxes_;              ///< memory for the box of each number
};

}  // namespace rrcb::zoltan
