#pragma once

#include "collective/participant.hpp"
#include "zoltan/call/lists.hpp"

namespace rrcb::zoltan {

/// Type of the functions that Zoltan's Fortran interface passes to Zoltan when it is initialised.
using FortranFunction = void (*)();

/// Passes the functions of the Fortran interface on to Zoltan, if Zoltan accepts them, and notes
/// that Fortran is in use. Not collective.
void register_fortran(FortranFunction allocate, FortranFunction free, FortranFunction set_struct);

/// Returns whether Zoltan's Fortran interface is in use in this process. Only Zoltan_Special_Malloc
/// can find out whether a handle belongs to Fortran.
bool is_fortran_used() noexcept;

/// Copies both lists into memory of Zoltan_Special_Malloc.
///
/// A Fortran variable contains more than the address of an array, so the arrays of handles from
/// Zoltan's Fortran interface must be allocated by Fortran. Collective over `self.comm`: one
/// reduction. If a rank has no memory, throws Error on all ranks, and the caller gets no list.
void copy_for_fortran(Zoltan_Struct* zz, const Lists& lists, const IdWidths& widths,
                      const CallerLists& to, Participant& self);

}  // namespace rrcb::zoltan
