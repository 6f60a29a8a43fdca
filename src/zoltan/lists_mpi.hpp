#pragma once

#include "lists.hpp"

namespace rrcb::zoltan {

/// The import lists that answer the export lists of all ranks, by Zoltan_Invert_Lists. Collective.
/// Throws Failure.
List invert(Zoltan_Struct* zz, const List& exports);

}  // namespace rrcb::zoltan
