#pragma once

#include "zoltan/handle/state.hpp"

#include <filesystem>

namespace rrcb::zoltan {

// A dump is a text with one entry a line, which comparisons/run --replay can read. Numbers are
// written with %a, so that nothing is lost; nan and inf may occur.
//
// call.txt is written by the rank that chooses the folder:
//
//     rrcb-dump 1
//     version 0.1.0
//     function Zoltan_LB_Partition
//     code -1                         Zoltan's code, as far as known when the dump was written
//     ranks 4
//     parameter LB_METHOD RRCB        all that were set on the handle, as set on this rank
//     end
//
// rank-0.txt, rank-1.txt, ... are written by every rank:
//
//     rrcb-dump-rank 1
//     rank 0
//     message ...                     of the error, if there is one
//     part_size global 2 0x1p+0       every entry of Zoltan_LB_Set_Part_Sizes on this rank
//                                     for the first weight
//     dimension 2                     0 on a rank whose callbacks failed
//     weights 1                       per object
//     parts 1                         1: initial parts are known, else 0
//     objects 3                       followed by that many lines: coordinates, weights, part
//     0x1.8p+0 0x1p-1 0x1p+0 0
//     0x1.9p+0 nan 0x1p+0 0
//     0x1.ap+0 0x1p-1 0x1p+0 0
//     end

/// Inputs of a partitioning call on this rank that are not in the state of the handle.
struct DumpInput {
    const char* function;
    const Points& points;
    const int* initial_parts;  ///< one for each point; null if no callback returns them
    int code;                  ///< code of the call, if it is known when the dump is written
    const char* message;       ///< text of an error; empty if there is none
};

/// Makes the first of the folders DIR/call-1, DIR/call-2, ... that does not exist. Throws if that
/// fails.
std::filesystem::path make_dump_folder(const std::filesystem::path& parent);

/// Writes call.txt. Throws if that fails.
void write_call(const std::filesystem::path& folder, const State& state, const DumpInput& input);

/// Writes rank-N.txt. Throws if that fails.
void write_rank(const std::filesystem::path& folder, const State& state, const DumpInput& input);

}  // namespace rrcb::zoltan
