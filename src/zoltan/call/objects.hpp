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

/// A word of an id. An entry of NUM_GID_ENTRIES has one or two words. That depends on the Zoltan
/// found at run time, not on the ZOLTAN_ID_TYPE with which the plug-in was compiled.
using IdWord = std::uint32_t;

/// Returns the same memory with Zoltan's type, whose words may be wider.
inline ZOLTAN_ID_PTR as_zoltan_ids(IdWord* words) {
    return reinterpret_cast<ZOLTAN_ID_PTR>(words);
}

/// Number of words in the ids of one object.
struct IdWidths {
    explicit IdWidths(const Parameters& parameters)
        : global(static_cast<std::size_t>(parameters.num_gid_entries) * words_per_id_entry()),
          local(static_cast<std::size_t>(parameters.num_lid_entries) * words_per_id_entry()) {}

    std::size_t global;
    std::size_t local;
};

/// Widths of ids with one word each, which most programs have. As constants they make loops faster.
struct SingleWords {
    static constexpr std::size_t global = 1;
    static constexpr std::size_t local = 1;
};

/// Calls visit(widths); the usual widths are passed as constants.
template <class Visit>
void visit_widths(const IdWidths& widths, Visit&& visit) {
    if (widths.global == 1 && widths.local == 1) return visit(SingleWords{});
    visit(widths);
}

/// One of Zoltan's two lists. If it is empty, its arrays are null. A count of -1 means that the
/// list was not asked for.
struct List {
    int count = 0;
    ZoltanArray<IdWord> global_ids;
    ZoltanArray<IdWord> local_ids;
    ZoltanArray<int> ranks;
    ZoltanArray<int> parts;
};

/// Returns a list with memory for `count` entries. Throws std::bad_alloc.
List make_list(int count, const IdWidths& widths);

/// The objects of one rank, as its callbacks describe them, in the memory of the workspace.
struct Objects {
    int count = 0;
    bool warned = false;       ///< whether a callback has returned ZOLTAN_WARN
    bool names_parts = false;  ///< whether a callback returns the part of each object
    IdWord* global_ids = nullptr;
    IdWord* local_ids = nullptr;   ///< null if there are no local ids
    int* initial_parts = nullptr;  ///< null if no callback returns the parts
    int* moving = nullptr;  ///< memory for the indices of moving objects; null if no lists are
                            ///< asked for
    Points points;
    List room;  ///< memory for the returned ids, if the ranks need no further agreement
};

/// Collects the objects from the registered callbacks, with at most one weight each. Throws
/// ZoltanError for a missing or failing callback, a negative count, and a dimension other than 1, 2
/// or 3. Not collective.
Objects collect_objects(Zoltan_Struct* zz, const Parameters& parameters, Workspace& workspace);

}  // namespace rrcb::zoltan
