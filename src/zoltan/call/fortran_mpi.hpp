#pragma once

#include "collective/participant.hpp"
#include "zoltan/call/lists.hpp"

namespace rrcb::zoltan {

/// Function that Zoltan's Fortran interface passes to Zoltan when it is initialised, of a type of
/// its own.
using FortranFunction = void (*)();

/// Passes the interface's functions on to Zoltan, if it has a place for them. Notes that Fortran is
/// in use. Not collective.
void register_fortran(FortranFunction allocate, FortranFunction free, FortranFunction set_struct);

/// Returns whether Zoltan's Fortran interface is in use in this process. Only Zoltan_Special_Malloc
/// knows whether a handle is Fortran's.
bool is_fortran_used() noexcept;

/// Copies both lists into memory from Zoltan_Special_Malloc.
///
/// Variables of Fortran hold more than the address of an array: for handles of Zoltan's Fortran
/// interface that memory is Fortran's own. Collective over `self.comm`: one reduction. Throws Error
/// on all ranks if one has no memory; then the caller gets no list.
void copy_for_fortran(Zoltan_Struct* zz, const Lists& lists, const IdWidths& widths,
                      const CallerLists& to, Participant& self);

}  // namespace rrcb::zoltan
