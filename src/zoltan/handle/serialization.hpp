#pragma once

#include "zoltan/handle/state.hpp"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rrcb::zoltan {

/// What travels of a handle: all the program told it, and the cuts it keeps. Not its communicator
/// and not its callbacks, as with Zoltan.
struct Parcel {
    std::map<std::string, std::string> given;  ///< see Parameters::given
    std::vector<PartSize> part_sizes;
    std::optional<KeptPartition> kept;
};

/// The parcel of a handle as bytes, for machines of one kind. Not collective.
std::vector<char> serialize(const State& state);

/// Whether the bytes begin as `serialize` begins; otherwise they are Zoltan's.
bool is_parcel(std::span<const char> bytes);

/// Reads what `serialize` wrote; more bytes behind it are ignored. Throws ZoltanError for a buffer
/// that is truncated or changed.
Parcel deserialize(std::span<const char> bytes);

}  // namespace rrcb::zoltan
