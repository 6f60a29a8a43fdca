#pragma once

#include "zoltan/handle/state.hpp"

#include <filesystem>
#include <span>
#include <string>

namespace rrcb::zoltan {

// The format is described in comparisons/README.md, whose driver reads it.

/// What holds for all ranks of a dumped call.
struct DumpedCall {
    const char* function;
    int code;  ///< as far as it is known when the dump is written
    int num_ranks;
    const Parameters& parameters;
};

/// What one rank got.
struct DumpedRank {
    int rank;
    const Points& points;      ///< without their weights
    int weight_dimension;      ///< weights per point
    const float* weights;      ///< as the callbacks gave them, object by object
    const int* initial_parts;  ///< one per point, null when no callback tells them
    std::span<const PartSize> part_sizes;
    const char* message;  ///< of an error; empty: none
};

/// Makes DIR/call-1, DIR/call-2, ...: the first that is not there. Throws when it cannot.
std::filesystem::path make_dump_folder(const std::filesystem::path& parent);

/// Writes call.txt. Throws when it cannot.
void write_dump(const std::filesystem::path& folder, const DumpedCall& call);

/// Writes rank-N.txt. Throws when it cannot.
void write_dump(const std::filesystem::path& folder, const DumpedRank& mine);

}  // namespace rrcb::zoltan
