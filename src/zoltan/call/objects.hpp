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

/// A word of an id. An entry of NUM_GID_ENTRIES has one or two, as the Zoltan found at run time
/// decides, whatever ZOLTAN_ID_TYPE was where the plug-in was compiled.
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

/// The usual widths, for loops over ids.
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

/// One rank's objects, as its callbacks describe them.
struct Objects {
    int count = 0;
    bool warned = false;       ///< a callback returned ZOLTAN_WARN
    bool names_parts = false;  ///< a callback tells the part of each object
    ZoltanArray<IdWord> global_ids;
    ZoltanArray<IdWord> local_ids;   ///< null when ids have no local part
    ZoltanArray<int> initial_parts;  ///< null when no callback tells them
    ZoltanArray<int> new_ranks;      ///< buffer for where each object goes, while a failure
    ZoltanArray<int> new_parts;      ///< can still be agreed on; null when not asked for
    Points points;                   ///< borrowed from the workspace
};

/// Objects by the registered callbacks, with at most one weight each. Not collective. Throws
/// ZoltanError for a missing or failing callback, a negative count, and a dimension other than 1, 2
/// or 3.
Objects collect_objects(Zoltan_Struct* zz, const Parameters& parameters, Workspace& workspace);

}  // namespace rrcb::zoltan
