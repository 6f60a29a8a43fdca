#pragma once

#include "c/balancer.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/duplicate.hpp"
#include "collective/participant.hpp"
#include "options/rejection.hpp"

#include <initializer_list>
#include <memory>
#include <string>

namespace rrcb::c {

/// Makes a handle for the caller's pointer `*where`. Collective. Throws the same Error on every
/// rank if on any rank `where` is null, `*where` is not null, memory runs out or `check` throws, or
/// if one of `arguments` differs between ranks.
template <class Handle, class Check = void (*)()>
std::unique_ptr<Handle> make_handle(
    Participant& self, Handle** where, std::initializer_list<Shared> arguments = {},
    Check&& check = [] {}) {
    std::unique_ptr<Handle> made;
    self.attempt([&] {
        if (where == nullptr)
            reject(std::string(Handle::name) +
                   " is null; give the address of a pointer (in Fortran: destroy what was created "
                   "before)");
        if (*where != nullptr)
            reject(std::string(Handle::name) +
                   " is not null; destroy what was created before, and set a new pointer to NULL");
        check();
        made = std::make_unique<Handle>();
    });
    agree(self, arguments);
    return made;
}

/// Makes a handle on a communicator, completes it by fill(handle), and stores it. Collective. No
/// exception leaves it.
template <class Handle, class Fill>
int create(MPI_Comm comm, CallName call, Handle** where, Fill&& fill) noexcept {
    const auto body = [&] {
        Participant self = mpi::enter(comm, call);
        auto made = make_handle(self, where);
        fill(*made);
        *where = made.release();
    };
    return guarded(body, {comm, patience_together});
}

/// Runs the body of a collective function that belongs to a handle. No exception leaves it.
template <class Handle, class Body>
int guarded_together(CallName call, Handle* handle, Body&& body) noexcept {
    const auto run = [&] {
        require_handle(handle, Handle::name);
        Participant self = mpi::enter(handle->comm, call);
        body(*handle, self);
        self.throw_failed_message();
    };
    return guarded(run, {origin_in(handle).comm, patience_together});
}

}  // namespace rrcb::c
