#pragma once

#include "zoltan/call/lists.hpp"

namespace rrcb::zoltan {

/// Where one of the two lists goes in the caller's variables; `parts` may be null.
struct CallerList {
    int* count;
    ZOLTAN_ID_PTR* global_ids;
    ZOLTAN_ID_PTR* local_ids;
    int** ranks;
    int** parts;
};

struct CallerLists {
    CallerList imports;
    CallerList exports;
};

}  // namespace rrcb::zoltan
