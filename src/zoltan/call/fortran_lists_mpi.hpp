#pragma once

#include "member.hpp"
#include "zoltan/call/caller_lists.hpp"

namespace rrcb::zoltan {

/// Copies both lists into memory that Zoltan_Special_Malloc gives: Fortran's own for handles that
/// Zoltan's Fortran interface made, whose variables hold more than the address of an array.
///
/// Collective over `me.comm`: one reduction. Throws Error on all ranks where one has no memory;
/// then the caller has none of it.
void copy_for_fortran(Zoltan_Struct* zz, const List& imports, const List& exports,
                      const CallerLists& to, Member& me);

}  // namespace rrcb::zoltan
