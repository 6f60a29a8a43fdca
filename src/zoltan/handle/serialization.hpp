#pragma once

#include "zoltan/handle/state.hpp"

#include <optional>
#include <span>
#include <vector>

namespace rrcb::zoltan {

/// Contents of a serialized handle: all parameters that the program has set, and the kept cuts,
/// which may be Zoltan's. As in Zoltan, communicator and callbacks are not included.
struct Parcel {
    GivenParameters given;  ///< see Parameters
    std::vector<PartSize> part_sizes;
    std::optional<LastPartition> last;
    std::vector<char> of_zoltan;  ///< buffer of the real Zoltan; empty if that has no cuts
};

/// Returns the parcel of a handle as bytes, which machines with the same byte order can read.
/// Parcel explains `of_zoltan`. Not collective.
std::vector<char> serialize(const State& state, const std::vector<char>& of_zoltan);

/// Returns true if the bytes begin like those of serialize(). Otherwise they are Zoltan's.
bool is_parcel(std::span<const char> bytes);

/// Returns the parcel in the bytes of serialize(). Ignores further bytes. Throws ZoltanError if the
/// buffer has been truncated or changed.
Parcel deserialize(std::span<const char> bytes);

}  // namespace rrcb::zoltan
