#pragma once

#include <rrcb/zoltan/optional_functions.h>

#include <zoltan.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>

// No public header of Zoltan declares these functions, but Zoltan exports them and programs call
// them.
extern "C" {
int Zoltan_LB_Part_To_Proc(struct Zoltan_Struct* zz, int part, ZOLTAN_ID_PTR global_id);
int Zoltan_LB_Proc_To_Part(struct Zoltan_Struct* zz, int rank, int* num_parts, int* first_part);
void Zoltan_Register_Fort_Malloc(void (*allocate)(), void (*free)(), void (*set_struct)());
}

namespace rrcb::zoltan {

/// The real Zoltan behind the plug-in: the functions in functions.inc, those of Fortran, and the
/// width of its ids.
struct RealZoltan {
#define RRCB_FORWARDED(function, member) decltype(&function) member;
#define RRCB_OPTIONAL(function, member) decltype(&function) member = nullptr;
#include "zoltan/real/functions.inc"

    /// Functions that Zoltan's Fortran interface uses; null if there is none.
    int (*special_malloc)(Zoltan_Struct* zz, void** array, int size, int type) = nullptr;
    int (*special_free)(Zoltan_Struct* zz, void** array, int type) = nullptr;

    std::size_t words_per_id_entry = 1;  ///< words of 32 bits
    bool serves_rrcb = true;             ///< if false, every call goes to Zoltan
};

/// Returns the real Zoltan, which is looked up once. If there is none behind the plug-in, prints
/// one message on stderr and returns null.
const RealZoltan* real_zoltan() noexcept;

/// Returns the number of words in an entry of an id: 2 if Zoltan was built with ids of 64 bits,
/// otherwise 1. Call it only for handles that RRCB serves.
inline std::size_t words_per_id_entry() {
    return real_zoltan()->words_per_id_entry;
}

/// Calls the real function as if there were no plug-in, also with regard to callbacks and their
/// exceptions.
template <auto member, typename... Arguments>
auto forward(Arguments... arguments) {
    using Result = decltype((real_zoltan()->*member)(arguments...));
    const RealZoltan* real = real_zoltan();
    if constexpr (std::is_same_v<Result, int>) {
        return real == nullptr ? ZOLTAN_FATAL : (real->*member)(arguments...);
    } else {
        return real == nullptr ? Result() : (real->*member)(arguments...);
    }
}

}  // namespace rrcb::zoltan
