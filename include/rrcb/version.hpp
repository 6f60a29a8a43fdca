#pragma once

#include <rrcb/export.h>
#include <rrcb/version.h>

namespace rrcb {

/// Returns the version of the library, as "major.minor.patch"; that of the headers is
/// RRCB_VERSION_STRING. Not collective; the string is static.
RRCB_API const char* version();

/// Returns a line each for the version, commit, compiler, MPI and options of the library, as "name:
/// value". Not collective; the string is static.
RRCB_API const char* build_info();

}  // namespace rrcb
