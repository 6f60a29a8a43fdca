#pragma once

#include "collective/butterfly_mpi.hpp"
#include "zoltan/call/objects.hpp"
#include "zoltan/handle/state.hpp"

#include <mpi.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rrcb::zoltan {

/// Objects as checksums see them: by their weights, and by their positions on request. The order of
/// the objects does not matter.
struct Hashed {
    const Parameters& parameters;
    const Workspace& workspace;
    const Points& points;
    bool with_positions;
};

/// Sums checksums of the objects of each part over the ranks, for the ranks of the parts.
class ChecksumSums {
  public:
    /// Makes room; `is_spread` where many ranks make the parts. Throws std::bad_alloc, which all
    /// ranks must agree on before run(). Not collective.
    ChecksumSums(const PartMap& map, const Communicator& comm, bool is_spread);

    /// Writes the sums of the parts of this rank to `rest.checksums`, which has room for them.
    /// Returns whether any object moves, of which each rank tells its own. Collective: one
    /// reduction, or one pass through the ranks, which throws on all what failed on one before it.
    bool run(const Hashed& objects, std::span<const Part> parts, bool moves, const PartMap& map,
             Rest& rest, ButterflyMessages& messages, Participant& self);

  private:
    bool run_spread(const Hashed& objects, std::span<const Part> parts, bool moves,
                    const PartMap& map, Rest& rest, ButterflyMessages& messages, Participant& self);

    std::vector<std::uint64_t> sums_;  ///< of all parts, and whether any object moves; or
    std::optional<Butterfly> spread_;
};

/// Whether each part has a rank of its own, and all objects of this rank are in its part. Objects
/// whose parts no callback names are. Not collective.
bool are_in_own_part(const Objects& objects, const PartMap& map, int rank);

/// Whether every object of this rank is in the part that the last partition gave it, and the parts
/// of this rank hold the objects they got. Not collective.
///
/// False where the parts of the objects are unknown: without a callback that names them, and
/// several parts on a rank.
bool is_at_rest(const Rest& rest, const KeptPartition& kept, const Parameters& parameters,
                const Workspace& workspace, const Objects& objects, int rank);

/// Whether RRCB_SKIP_WITHIN is set and every object of this rank is where the last cuts tell; what
/// the objects weigh in each part goes into `state.rest`. Not where they cannot be weighed, or
/// their parts are not known. Not collective.
bool are_as_cut(State& state, const Objects& objects);

/// Whether the parts, weighed by are_as_cut(), are within an imbalance. Collective: one reduction,
/// or two where many ranks make the parts.
bool are_even(Rest& rest, int num_parts, double within, MPI_Comm comm);

}  // namespace rrcb::zoltan
