#pragma once

#include <rrcb/zoltan/optional_functions.h>

#include <zoltan.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>

// Declared in no public header of Zoltan, but exported by it and called by its users.
extern "C" {
int Zoltan_LB_Part_To_Proc(struct Zoltan_Struct* zz, int part, ZOLTAN_ID_PTR global_id);
int Zoltan_LB_Proc_To_Part(struct Zoltan_Struct* zz, int rank, int* num_parts, int* first_part);
void Zoltan_Register_Fort_Malloc(void (*allocate)(), void (*free)(), void (*set_struct)());
}

namespace rrcb::zoltan {

/// Real Zoltan behind the plug-in: the functions of functions.inc, those of Fortran, and its ids.
struct RealZoltan {
#define RRCB_FORWARDED(function, member) decltype(&function) member;
#define RRCB_OPTIONAL(function, member) decltype(&function) member = nullptr;
#include "zoltan/real/functions.inc"

    /// Functions under Zoltan's Fortran interface; null if there is none.
    int (*special_malloc)(Zoltan_Struct* zz, void** array, int size, int type) = nullptr;
    int (*special_free)(Zoltan_Struct* zz, void** array, int type) = nullptr;

    std::size_t words_per_id_entry = 1;  ///< of 32 bits
    bool serves_rrcb = true;             ///< otherwise every call goes to Zoltan
};

/// Returns the real Zoltan, looked up once. Null, with one message on stderr, if there is none
/// behind the plug-in.
const RealZoltan* real_zoltan() noexcept;

/// Returns the words in an entry of an id: 2 if Zoltan was built with ids of 64 bits. For handles
/// that RRCB serves.
inline std::size_t words_per_id_entry() {
    return real_zoltan()->words_per_id_entry;
}

/// Calls the real function as if the plug-in were not there, also for callbacks and their
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
