#pragma once

namespace rrcb::zoltan {

/// Whether Zoltan's Fortran interface is in use in this process. Handles do not tell whether they
/// are Fortran's; Zoltan_Special_Malloc knows.
bool is_fortran_used() noexcept;

}  // namespace rrcb::zoltan
