#ifndef RRCB_H
#define RRCB_H

/** @file
 * The library in C. The functions are in the headers of rrcb/c/. Their comments are short,
 * because the C++ functions with the same names are documented in full.
 *
 * Every function that can fail returns RRCB_OK or another rrcb_code. A collective function
 * returns the same code and text on all ranks of the communicator; only a null handle is an
 * error on its own rank alone. No exception leaves a function. Use a handle in one thread at a
 * time. */

#include <rrcb/c/balancer.h>
#include <rrcb/c/controller.h>
#include <rrcb/c/ghosts.h>
#include <rrcb/c/groups.h>
#include <rrcb/c/neighbours.h>
#include <rrcb/c/quality.h>
#include <rrcb/version.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Result of a function. */
typedef enum rrcb_code {
    RRCB_OK = 0,               /**< success */
    RRCB_INVALID_ARGUMENT = 1, /**< the caller's mistake: points, weights or options */
    RRCB_OUT_OF_MEMORY = 2,    /**< an allocation failed on some rank */
    RRCB_MPI_ERROR = 3,        /**< an MPI call returned an error, or ranks called differently */
    RRCB_INTERNAL_ERROR = 4    /**< an invariant does not hold */
} rrcb_code;

/** Returns the version of the library, as "major.minor.patch". Not collective. The string is
 * static. */
RRCB_API const char* rrcb_version(void);

/** Returns version, commit, compiler, MPI and options, as rrcb::build_info. Not collective; static.
 */
RRCB_API const char* rrcb_build_info(void);

/** Returns the text of the last error on this thread, which names the place and the fix. Not
 * collective. The text is valid until the next error, and empty if there was none. */
RRCB_API const char* rrcb_last_error(void);

#ifdef __cplusplus
}
#endif

#endif
