/** @file
 * Functions of the library that only the Fortran module and the Python package call. They are in no
 * public header. */
#ifndef RRCB_SRC_C_FOR_FORTRAN_H
#define RRCB_SRC_C_FOR_FORTRAN_H

#include <rrcb/c/controller.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The functions without this ending, from a communicator of Fortran. A controller is given by the
 * address of its handle, or null. */
RRCB_API int rrcb_balancer_create_fortran(int comm, rrcb_balancer** balancer);
RRCB_API int rrcb_controller_create_fortran(int comm, rrcb_controller** controller);
RRCB_API int rrcb_controller_load_fortran(int comm, const void* bytes, size_t size,
                                          rrcb_controller** controller);
RRCB_API int rrcb_cost_model_create_fortran(int comm, rrcb_controller* const* controller,
                                            int num_columns, rrcb_cost_model** model);
RRCB_API int rrcb_cost_model_load_fortran(int comm, rrcb_controller* const* controller,
                                          const void* bytes, size_t size, rrcb_cost_model** model);

/* An error ends a program in Fortran that does not ask for it. All ranks of a failing collective
 * call get the same text, which one of them prints. */

/** Returns 1 if this rank has to print the text of its last error, 0 if rank 0 of the communicator
 * of the failing call has printed one. Not collective: waits for rank 0, though not for ever. */
RRCB_API int rrcb_prints_last_error(void);

/** Notes on rank 0 of the communicator of the failing call that the text is printed, and waits for
 * ranks that wait for it, though not for ever. Not collective. */
RRCB_API void rrcb_note_printed_error(void);

#ifdef __cplusplus
}
#endif

#endif
