#pragma once

#include "zoltan/call/objects.hpp"
#include "zoltan/handle/part_map.hpp"

#include <span>

namespace rrcb::zoltan {

/// One of Zoltan's two lists. Arrays of an empty list are null. A count of -1 stands for a list
/// that was not asked for.
struct List {
    int count = 0;
    ZoltanArray<IdWord> global_ids;
    ZoltanArray<IdWord> local_ids;
    ZoltanArray<int> ranks;
    ZoltanArray<int> parts;
};

/// The caller's variables for one of the two lists; `parts` may be null.
struct CallerList {
    int* count;
    ZOLTAN_ID_PTR* global_ids;
    ZOLTAN_ID_PTR* local_ids;
    int** ranks;
    int** parts;
};

/// The caller's variables for both lists.
struct CallerLists {
    CallerList imports;
    CallerList exports;
};

/// Objects that leave this rank.
struct Exports {
    List list;
    bool moves = false;  ///< the rank or part of some object of this rank changes
};

/// Objects of this rank whose rank or part changes; all of them where RETURN_LISTS asks for parts.
/// It takes the arrays out of `objects`, so it cannot fail. Not collective.
Exports make_exports(Objects&& objects, const Parameters& parameters,
                     std::span<const Part> new_parts, const PartMap& map, int my_rank);

/// All objects of this rank with the parts they are in. It takes the arrays, so it cannot fail.
List list_in_place(Objects&& objects, int my_rank);

}  // namespace rrcb::zoltan
