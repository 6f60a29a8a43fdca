/** @file
 * Functions of the library that only the Fortran module and the Python package call. No public
 * header declares them. */
#ifndef RRCB_SRC_C_FOR_FORTRAN_H
#define RRCB_SRC_C_FOR_FORTRAN_H

#include <rrcb/c/controller.h>

#ifdef __cplusplus
extern "C" {
#endif

/* As the functions without this ending, but with a communicator of Fortran. */
RRCB_API int rrcb_balancer_create_fortran(int comm, rrcb_balancer** balancer);
RRCB_API int rrcb_controller_create_fortran(int comm, rrcb_controller** controller);
RRCB_API int rrcb_controller_load_fortran(int comm, const void* bytes, size_t size,
                                          rrcb_controller** controller);

/* An error ends a Fortran program that does not ask for the code. All ranks of a failing
 * collective call get the same text, and one of them prints it. */

/** Returns 1 if this rank has to print the text of its last error, and 0 if rank 0 of the failed
 * call's communicator has printed one. Not collective. Waits for rank 0, but only for a limited
 * time. */
RRCB_API int rrcb_prints_last_error(void);

/** Notes on rank 0 of the failed call's communicator that the text has been printed. Waits for
 * the ranks that wait for this note, but only for a limited time. Not collective. */
RRCB_API void rrcb_note_printed_error(void);

#ifdef __cplusplus
}
#endif

#endif
