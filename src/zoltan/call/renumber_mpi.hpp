#pragma once

#include "lists/remap_mpi.hpp"
#include "zoltan/call/layout_mpi.hpp"
#include "zoltan/call/objects.hpp"

#include <optional>
#include <span>

namespace rrcb::zoltan {

/// REMAP: numbers for the parts that keep objects in place, in the cases in which Zoltan does.
///
/// The numbers stay where REMAP is off, the parts differ in size or a part is on several ranks.
/// With one part on each rank an object is to stay on its rank. Otherwise it is to stay in the part
/// that the callbacks name, or on its rank where they name none.
class Renumbering {
  public:
    /// Makes room for all that follows. Throws std::bad_alloc, which all ranks must agree on before
    /// run(). Not collective.
    Renumbering(const Parameters& parameters, const Layout& layout, const Objects& objects,
                const Communicator& comm);

    /// Writes the new numbers to `parts`. Collective where numbers may change. Throws Error on all
    /// ranks alike.
    Remap run(const Layout& layout, const Objects& objects, std::span<Part> parts,
              Participant& self);

  private:
    Remap unchanged_;
    std::optional<RemapBuffers> room_;  ///< where numbers may change
};

}  // namespace rrcb::zoltan
