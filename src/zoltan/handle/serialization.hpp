#pragma once

#include "zoltan/handle/state.hpp"

#include <optional>
#include <span>
#include <vector>

namespace rrcb::zoltan {

/// Contents of a serialized handle: all parameters that the program has set, and the kept cuts,
/// which may be Zoltan's. As in Zoltan neither communicator nor callbacks.
struct Parcel {
    GivenParameters given;  ///< see Parameters
    std::vector<PartSize> part_sizes;
    std::optional<LastPartition> last;
    std::vector<char> of_zoltan;  ///< buffer of the real Zoltan; empty: it has no cuts
};

/// Returns the parcel of a handle as bytes, for machines of one byte order; `of_zoltan` as in
/// Parcel. Not collective.
std::vector<char> serialize(const State& state, const std::vector<char>& of_zoltan);

/// Returns true if the bytes begin as those of `serialize`. Otherwise they are Zoltan's.
bool is_parcel(std::span<const char> bytes);

/// Returns the parcel in the bytes of `serialize`. Ignores further bytes. Throws ZoltanError for a
/// truncated or changed buffer.
Parcel deserialize(std::span<const char> bytes);

}  // namespace rrcb::zoltan
