#pragma once

#include <rrcb/export.h>
#include <rrcb/version.h>

namespace rrcb {

/// Returns the version of the library, as "major.minor.patch". The version of the headers is
/// RRCB_VERSION_STRING. Not collective. The string is static.
RRCB_API const char* version();

/// Returns the version, commit, compiler, MPI and options of the library, each in a line "name:
/// value". Not collective. The string is static.
RRCB_API const char* build_info();

}  // namespace rrcb
