#pragma once

#include "cuts/tree.hpp"

#include <rrcb/options.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace rrcb {

/// Complete options of a call. If it is spread, rank 0 makes regions instead of parts, and the
/// ranks that own the parts make these below the regions.
struct CallOptions {
    Options parts{};                   ///< sizes are normalized; if spread, none for equal ones
    std::optional<Options> regions{};  ///< if spread

    bool is_spread() const { return regions.has_value(); }
    /// Returns the options of rank 0.
    const Options& central() const { return regions ? *regions : parts; }
};

/// Returns true if many ranks make the parts, see Tuning::central_parts; `options` are complete.
bool is_spread(const Options& options, int num_ranks);

/// Adds the options of regions to complete and checked ones, if the call is spread.
CallOptions call_options(Options options, int num_ranks);

/// Returns the most cells that merging leaves. For regions they are so few that no rank receives
/// more than 64 kB, with those of seven others at once.
std::size_t most_merged_cells(const CallOptions& options);

/// Returns the nodes of the tree of these parts that are the regions: a full level, so a power of
/// two.
std::vector<Descent> region_nodes(const Options& parts, int num_regions);

}  // namespace rrcb
