#pragma once

#include "collective/participant.hpp"
#include "zoltan/call/lists.hpp"

namespace rrcb::zoltan {

/// What Zoltan's Fortran interface gives Zoltan when it is initialised; the types are its own.
using FortranFunction = void (*)();

/// Hands the interface's functions on to Zoltan, if it has a place for them, and notes that Fortran
/// is in use. Not collective.
void register_fortran(FortranFunction allocate, FortranFunction free, FortranFunction set_struct);

/// Whether Zoltan's Fortran interface is in use in this process. Handles do not tell whether they
/// are Fortran's; Zoltan_Special_Malloc knows.
bool is_fortran_used() noexcept;

/// Copies both lists into memory that Zoltan_Special_Malloc gives: Fortran's own for handles that
/// Zoltan's Fortran interface made, whose variables hold more than the address of an array.
///
/// Collective over `self.comm`: one reduction. Throws Error on all ranks where one has no memory;
/// then the caller has none of it.
void copy_for_fortran(Zoltan_Struct* zz, const List& imports, const List& exports,
                      const CallerLists& to, Participant& self);

}  // namespace rrcb::zoltan
