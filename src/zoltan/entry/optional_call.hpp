#pragma once

#include "zoltan/entry/entry_point.hpp"
#include "zoltan/real/real_zoltan.hpp"

/// For a function that not every Zoltan has, RRCB_DECLARE_REAL(function) declares the real
/// function, and RRCB_REAL(function, member) is its address. The latter throws ZoltanError if
/// Zoltan lacks the function.
///
/// A static archive must contain those functions that the program calls, and need not contain
/// others. Therefore each is called in a source file of its own, by its name without the prefix.
#ifdef RRCB_ZOLTAN_STATIC
#define RRCB_DECLARE_REAL(function) \
    extern "C" decltype(function) real_##function __asm__(#function);
#define RRCB_REAL(function, member) (&real_##function)
#else
#define RRCB_DECLARE_REAL(function)
#define RRCB_REAL(function, member) rrcb::zoltan::real_function<&rrcb::zoltan::RealZoltan::member>()
#endif

namespace rrcb::zoltan {

template <auto member>
auto real_function() {
    const RealZoltan* real = real_zoltan();
    if (real == nullptr || real->*member == nullptr)
        throw_fatal("the Zoltan behind RRCB has no such function; use a newer one");
    return real->*member;
}

}  // namespace rrcb::zoltan
