#pragma once

#include "lists/spread_remap_mpi.hpp"
#include "zoltan/call/layout_mpi.hpp"
#include "zoltan/call/objects.hpp"
#include "zoltan/handle/numbering.hpp"

#include <optional>
#include <span>
#include <vector>

namespace rrcb::zoltan {

/// What REMAP gains, without numbers, and these.
struct Renumbered {
    Remap summary{};
    Numbering numbering{};
};

/// REMAP: numbers for the parts that keep objects in place, in the cases in which Zoltan does.
///
/// The numbers stay where REMAP is off, the parts differ in size or a part is on several ranks.
/// With one part on each rank an object is to stay on its rank. Otherwise it is to stay in the part
/// that the callbacks name, or on its rank where they name none.
class Renumbering {
  public:
    /// Makes room for all that follows; `is_spread` where many ranks make the parts, which then
    /// search for numbers together if the parts lie evenly on the ranks. Throws std::bad_alloc,
    /// which all ranks must agree on before run(). Not collective.
    Renumbering(const Parameters& parameters, const Layout& layout, const Objects& objects,
                const Communicator& comm, bool is_spread);

    /// Writes the new numbers to `parts`. Collective where numbers may change. Throws Error on all
    /// ranks alike; what fails at last is told by the next pass or agreement.
    Renumbered run(const Layout& layout, const Objects& objects, std::span<Part> parts,
                   ButterflyMessages& messages, Participant& self);

  private:
    Renumbered run_spread(const Layout& layout, const PreviousParts& previous,
                          std::span<Part> parts, ButterflyMessages& messages, Participant& self);

    /// For one rank that finds the numbers.
    struct Room {
        RemapBuffers buffers;
        std::vector<RankRange> ranks;  ///< of each part
        std::vector<Part> boxes;       ///< room for one of each number
    };

    // One of both where numbers may change.
    std::optional<Room> room_;
    std::optional<SpreadRemapRoom> spread_room_;
};

}  // namespace rrcb::zoltan
