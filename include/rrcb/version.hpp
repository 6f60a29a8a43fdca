#pragma once

#include <rrcb/export.h>
#include <rrcb/version.h>

namespace rrcb {

/// Returns the version of the library, as "major.minor.patch"; that of the headers is
/// RRCB_VERSION_STRING. Not collective; the string is static.
RRCB_API const char* version();

/// Returns what the library was built from and with: a line each for version, commit, compiler, MPI
/// and options, as "name: value". Not collective; the string is static.
RRCB_API const char* build_info();

}  // namespace rrcb
