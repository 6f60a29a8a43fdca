#pragma once

#include <rrcb/ghosts.hpp>

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace rrcb::experimental {

/// Scope of verify(). It must be the same on every rank, except that ranks without points may leave
/// the spans empty.
struct VerifyOptions {
    /// Maximum number of points, over all ranks, whose neighbours are searched.
    std::size_t sample = 1000;
    /// True cutoff, if the ghosts were found with a skin. By default it is that of the ghosts; give
    /// it if ghosts have one for each point.
    Cutoff cutoff{};
    std::optional<std::span<const std::uint64_t>> ids{};  ///< of the points; else their indices
    /// Ids of this rank's points before a transfer. Each of them must still exist.
    std::optional<std::span<const std::uint64_t>> ids_before{};
};

/// A point that is not where it should be.
struct Fault {
    std::uint64_t id = 0;  ///< of the point
    int rank = 0;  ///< its rank, now or before the transfer; -1: several other ranks have it
    std::uint64_t needed_by = 0;  ///< point of this rank that needs it, or the same id
};

/// Result of verify(), with the faults found on this rank.
struct Verification {
    GlobalCount num_pairs = 0;   ///< pairs of a sample point and a point of another rank, over all
                                 ///< ranks
    GlobalCount num_faults = 0;  ///< over all ranks; 0 means that everything is correct
    std::vector<Fault> missing;  ///< near points that are not ghosts here; lost ids
    std::vector<Fault>
        duplicates;  ///< ghosts that were received twice; ids that another rank has, too
    std::vector<Fault> not_mine;  ///< own points that were received as ghosts; new ids
};

/// Compares ghosts with all pairs of a random sample of the points, and compares ids between the
/// ranks. Collective.
///
///     const auto seen = rrcb::experimental::verify(near, points, comm, {.sample = 1000});
///
/// Prints nothing.
/// @param near    from ghost_plan(), or made in another way
/// @param points  of this rank, whose ghosts these are
/// @param options number of points, radii, ids
/// @param comm    of the plan
/// Throws Error as fetch(). Cost: each rank stores the sample and reads its points once; time for
/// the points near the sample; messages for their pairs, for all ghosts and for all ids.
RRCB_API Verification verify(const GhostPlan& near, const Points& points, MPI_Comm comm,
                             const VerifyOptions& options = {});

}  // namespace rrcb::experimental
