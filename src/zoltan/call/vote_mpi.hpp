#pragma once

#include "zoltan/dump/dump_mpi.hpp"
#include "zoltan/handle/state.hpp"

#include <array>
#include <cstdint>
#include <string_view>

namespace rrcb::zoltan {

/// Result of a rank's local steps. It stores its text without allocating memory.
struct LocalStatus {
    LocalStatus() = default;
    /// Truncates a long text.
    LocalStatus(int its_code, std::string_view its_text) : code(its_code) {
        its_text.copy(text.data(), text.size() - 1);
    }

    int code = ZOLTAN_OK;
    bool may_keep = false;         ///< whether all objects are in the parts of the last partition
    bool names_parts = false;      ///< whether a callback returns the part of each object
    std::array<char, 512> text{};  ///< ends with a 0
};

/// Each number is 1 if its statement is true on some rank, otherwise 0.
struct Votes {
    int any_local_parts = 0;   ///< NUM_LOCAL_PARTS is set
    int any_part_sizes = 0;    ///< Zoltan_LB_Set_Part_Sizes was called
    int any_fortran = 0;       ///< Zoltan's Fortran interface is used
    int any_lacks_cuts = 0;    ///< a rank has no cuts of the last call
    int any_changed_axes = 0;  ///< a parameter that affects the axes of cuts has changed since the
                               ///< last call
    int any_may_not_keep = 0;  ///< see LocalStatus
    int any_names_parts = 0;   ///< see LocalStatus
};

/// Result of a vote. It is the same on every rank.
struct Outcome : Votes {
    int code = ZOLTAN_OK;       ///< most severe code of all ranks
    int failing_rank = 0;       ///< lowest failed rank, which prints the error
    int num_global_parts = -1;  ///< largest number of all ranks; -1 if no rank sets it
    ReturnLists return_lists = ReturnLists::none;  ///< largest value of all ranks
    bool lists_differ = false;                     ///< whether some rank asks for other lists
    DumpWish dump;
    const char* differing = nullptr;  ///< name of a parameter that differs between ranks

    bool failed() const { return code != ZOLTAN_OK && code != ZOLTAN_WARN; }
};

/// Lets all ranks vote: on their local results, and on the parameters that must be the same.
///
/// Collective over the handle's communicator: one reduction of a few integers.
Outcome vote(const LocalStatus& local, const State& state);

}  // namespace rrcb::zoltan
