#pragma once

#include <rrcb/export.h>

// For the Fortran module, in which an error ends the program if the caller does not ask for it. All
// ranks of a failing collective call get the same text, which one of them prints.

extern "C" {

/// Returns 1 if this rank has to print the text of its last error, 0 if rank 0 of the communicator
/// of the failing call has printed one. Not collective: waits for rank 0, though not for ever.
RRCB_API int rrcb_prints_last_error(void);

/// Notes on rank 0 of the communicator of the failing call that the text is printed, and waits for
/// ranks that wait for it, though not for ever. Not collective.
RRCB_API void rrcb_note_printed_error(void);
}
