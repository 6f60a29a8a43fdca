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

/// Scope of verify(). The same on every rank, except the spans, which ranks without points may
/// leave out.
struct VerifyOptions {
    /// Most points, over all ranks, whose neighbours are looked for.
    std::size_t sample = 1000;
    /// True cut-off, if the ghosts have a skin; NaN: as in ghosts().
    double radius = std::numeric_limits<double>::quiet_NaN();
    std::optional<std::span<const double>> radii{};       ///< needed if ghosts() got some
    std::optional<std::span<const std::uint64_t>> ids{};  ///< of the points; else their indices
    /// Ids of this rank's points before a transfer, each of which is still there.
    std::optional<std::span<const std::uint64_t>> ids_before{};
};

/// Point in a wrong place.
struct Fault {
    std::uint64_t id = 0;  ///< of the point
    int rank = 0;          ///< its holder, now or before the transfer; -1: several others hold it
    std::uint64_t needed_by = 0;  ///< point of this rank, or the same id
};

/// Result of verify(), with the faults of this rank.
struct Verification {
    GlobalCount num_pairs = 0;     ///< of the sample and points of other ranks, over all ranks
    GlobalCount num_faults = 0;    ///< over all ranks; 0: all is well
    std::vector<Fault> missing;    ///< near points without a ghost here, lost ids
    std::vector<Fault> twice;      ///< ghosts received twice, ids of another rank too
    std::vector<Fault> strangers;  ///< own points received as ghosts, new ids
};

/// Compares ghosts with all pairs of a random sample of the points, and ids between the ranks.
/// Collective.
///
///     const auto seen = rrcb::experimental::verify(near, points, {.sample = 1000}, comm);
///
/// Prints nothing.
/// @param near    of ghosts(), or other ghosts
/// @param points  of this rank, whose ghosts these are
/// @param options number of points, radii, ids
/// @param comm    of the plan
/// Throws Error as fetch(). Cost: on every rank the sample, and a pass over the points; time for
/// the points near the sample; messages for their pairs, all ghosts and all ids.
RRCB_API Verification verify(const GhostPlan& near, const Points& points,
                             const VerifyOptions& options, MPI_Comm comm);

}  // namespace rrcb::experimental
