/** @file
 * Functions of the library without a promise that only the Fortran module and the Python package
 * call. No public header declares them, and they may change in any version. */
#ifndef RRCB_SRC_C_FOR_EXPERIMENTAL_H
#define RRCB_SRC_C_FOR_EXPERIMENTAL_H

#include <rrcb/c/ghosts.h>
#include <rrcb/experimental/cost.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Scope of rrcb_ghosts_verify, as rrcb::experimental::VerifyOptions. */
typedef struct rrcb_verify_options {
    size_t sample; /**< most points, over all ranks, whose neighbours are looked for; 0: only ids */
    double cutoff; /**< true cut-off, if the ghosts have a skin; 0: that of these */
    const double* cutoffs;      /**< one for each point, if the ghosts have some, or null */
    size_t num_ids;             /**< number of points, or 0 without ids */
    const uint64_t* ids;        /**< of the points */
    size_t num_ids_before;      /**< number of points of this rank before a transfer, or 0 */
    const uint64_t* ids_before; /**< of these */
} rrcb_verify_options;

/** Point that is not where it should be, as rrcb::experimental::Fault. */
typedef struct rrcb_fault {
    uint64_t id;        /**< of the point; without ids its index */
    int rank;           /**< that holds it, or did before the transfer */
    uint64_t needed_by; /**< point of this rank, or the same id */
} rrcb_fault;

/** Result of rrcb_ghosts_verify, as rrcb::experimental::Verification. */
typedef struct rrcb_verification {
    int64_t num_pairs;            /**< of the sample, over all ranks */
    int64_t num_faults;           /**< over all ranks */
    size_t num_missing;           /**< length of `missing`, and so on */
    const rrcb_fault* missing;    /**< near points that are no ghosts, ids that are lost */
    size_t num_duplicates;        /**< */
    const rrcb_fault* duplicates; /**< ghosts that came twice, ids that another rank has too */
    size_t num_not_mine;          /**< */
    const rrcb_fault* not_mine;   /**< own points that came as ghosts, new ids */
} rrcb_verification;

/** Compares ghosts with all pairs of a sample of the points, as rrcb::experimental::verify.
 * Collective.
 *
 * @param ghosts  own the lists of the result, until the next call
 * @param points  of this rank
 * @param options null: a sample of 1000 points
 * @param seen    gets the result */
RRCB_API int rrcb_ghosts_verify(rrcb_ghosts* ghosts, const rrcb_points* points,
                                const rrcb_verify_options* options, rrcb_verification* seen);

/* As the functions without this ending, but with a communicator of Fortran. A controller is
 * given by the address of its handle, which may be null. */
RRCB_API int rrcb_cost_model_create_fortran(int comm, rrcb_controller* const* controller,
                                            int num_columns, rrcb_cost_model** model);
RRCB_API int rrcb_cost_model_load_fortran(int comm, rrcb_controller* const* controller,
                                          const void* bytes, size_t size, rrcb_cost_model** model);

#ifdef __cplusplus
}
#endif

#endif
