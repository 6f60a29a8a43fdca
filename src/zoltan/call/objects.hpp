#pragma once

#include "zoltan/handle/parameters.hpp"
#include "zoltan/handle/workspace.hpp"
#include "zoltan/real/real_zoltan.hpp"
#include "zoltan/real/zoltan_array.hpp"

#include <rrcb/points.hpp>

#include <zoltan.h>

#include <cstddef>
#include <cstdint>

namespace rrcb::zoltan {

/// A word of an id. An entry of NUM_GID_ENTRIES has one or two words. The Zoltan found at run time
/// decides, not the ZOLTAN_ID_TYPE with which the plug-in was compiled.
using IdWord = std::uint32_t;

/// The same memory for Zoltan, whose own word may be wider.
inline ZOLTAN_ID_PTR as_zoltan_ids(IdWord* words) {
    return reinterpret_cast<ZOLTAN_ID_PTR>(words);
}

/// Words of one object's ids.
struct IdWidths {
    explicit IdWidths(const Parameters& parameters)
        : global(static_cast<std::size_t>(parameters.num_gid_entries) * words_per_id_entry()),
          local(static_cast<std::size_t>(parameters.num_lid_entries) * words_per_id_entry()) {}

    std::size_t global;
    std::size_t local;
};

/// Widths of ids of one word, which most programs have: a compiler makes faster loops for them.
struct SingleWords {
    static constexpr std::size_t global = 1;
    static constexpr std::size_t local = 1;
};

/// Calls visit(widths) with constants if the widths are the usual ones.
template <class Visit>
void visit_widths(const IdWidths& widths, Visit&& visit) {
    if (widths.global == 1 && widths.local == 1) return visit(SingleWords{});
    visit(widths);
}

/// One of Zoltan's two lists. Arrays of an empty list are null. A count of -1 stands for a list
/// that was not asked for.
struct List {
    int count = 0;
    ZoltanArray<IdWord> global_ids;
    ZoltanArray<IdWord> local_ids;
    ZoltanArray<int> ranks;
    ZoltanArray<int> parts;
};

/// Returns a list with room for so many entries. Throws std::bad_alloc.
List make_list(int count, const IdWidths& widths);

/// One rank's objects, as its callbacks describe them, in memory of the workspace.
struct Objects {
    int count = 0;
    bool warned = false;       ///< a callback returned ZOLTAN_WARN
    bool names_parts = false;  ///< a callback returns the part of each object
    IdWord* global_ids = nullptr;
    IdWord* local_ids = nullptr;   ///< null when ids have no local part
    int* initial_parts = nullptr;  ///< null without such a callback
    int* moving = nullptr;         ///< room for the indices of moving objects; null without lists
    Points points;
    List room;  ///< memory for the ids that are returned, if the ranks need not agree once more
};

/// Collects objects by the registered callbacks, with at most one weight each. Not collective.
/// Throws ZoltanError for a missing or failing callback, a negative count, and a dimension other
/// than 1, 2 or 3.
Objects collect_objects(Zoltan_Struct* zz, const Parameters& parameters, Workspace& workspace);

}  // namespace rrcb::zoltan
