#pragma once

#ifdef RRCB_ZOLTAN_STATIC
#include <rrcb/zoltan/rrcb_zoltan_rename.h>
#endif

#include "zoltan/handle/state.hpp"
#include "zoltan/real/message.hpp"

#include <exception>
#include <new>

/// Marks a function that the plug-in exports: a function of Zoltan (real/functions.inc) or one of
/// its own.
#define RRCB_EXPORT extern "C" __attribute__((visibility("default")))

namespace rrcb::zoltan {

/// Runs the body of an entry point. No exception leaves it. It is not used for forwarded calls,
/// because with Zoltan the program catches the exceptions of its own callbacks.
template <typename Body>
int guarded(const char* function, const State* state, Body body) noexcept {
    const int rank = state == nullptr ? -1 : state->communicator->rank();
    int code = ZOLTAN_FATAL;
    try {
        return body();
    } catch (const ZoltanError& error) {
        code = error.code();
        print_error(rank, function, error.what());
    } catch (const std::bad_alloc&) {
        code = ZOLTAN_MEMERR;
        print_error(rank, function, "out of memory");
    } catch (const Error& error) {
        if (error.code() == ErrorCode::out_of_memory) code = ZOLTAN_MEMERR;
        print_error(rank, function, error.what());
    } catch (const std::exception& thrown) {
        print_error(rank, function, thrown.what());
    } catch (...) {
        print_error(rank, function, "a callback threw");
    }
    return code;
}

/// Returns the state of a handle whose method is RRCB; null if the real Zoltan has to answer.
inline State* rrcb_state(const Zoltan_Struct* zz) {
    State* state = find_state(zz);
    return state != nullptr && state->parameters.rrcb ? state : nullptr;
}

}  // namespace rrcb::zoltan
