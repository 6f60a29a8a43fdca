#pragma once

#include "zoltan/handle/parameters.hpp"
#include "zoltan/real/real_zoltan.hpp"

#include <zoltan_types.h>

#include <cstddef>
#include <cstdint>

namespace rrcb::zoltan {

/// What ids are made of here. The Zoltan found at run time decides how many an entry of
/// NUM_GID_ENTRIES has, whatever ZOLTAN_ID_TYPE was where the plug-in was compiled.
using IdWord = std::uint32_t;

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

}  // namespace rrcb::zoltan
