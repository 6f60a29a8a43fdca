#pragma once

#include "zoltan/call/objects.hpp"
#include "zoltan/handle/part_map.hpp"

#include <span>
#include <vector>

namespace rrcb::zoltan {

/// One of Zoltan's two lists. Arrays of an empty list are null; a count of -1 says that the list
/// was not asked for.
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

/// What leaves this rank.
struct Exports {
    List list;
    bool moves = false;  ///< the rank or part of some object of this rank changes
};

/// Objects of this rank whose rank or part changes, or all of them where RETURN_LISTS asks for
/// parts. Takes the arrays out of `objects`, and so cannot fail. Not collective.
Exports make_exports(Objects&& objects, const Parameters& parameters,
                     std::span<const Part> new_parts, const PartMap& map, int my_rank);

/// All objects of this rank with the parts they are in. Takes the arrays, and so cannot fail.
List list_in_place(Objects&& objects, int my_rank);

}  // namespace rrcb::zoltan
