#ifndef RRCB_C_CONTROLLER_H
#define RRCB_C_CONTROLLER_H

#include <rrcb/c/balancer.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Decides when to rebalance. */
typedef struct rrcb_controller rrcb_controller;

/** Makes a controller, as rrcb::Controller. Collective.
 *
 * @param comm       may be freed before the controller
 * @param controller as for rrcb_balancer_create */
RRCB_API int rrcb_controller_create(MPI_Comm comm, rrcb_controller** controller);

/** Frees a controller, after its cost models. Collective.
 *
 * @param controller as for rrcb_balancer_destroy */
RRCB_API void rrcb_controller_destroy(rrcb_controller** controller);

/** Records a step, as rrcb::Controller::step. Collective.
 *
 * @param controller of this loop
 * @param load       of this rank's own work, without waiting, in the unit of the costs of
 * rebalances
 * @param weight     of this rank's points: the sum of the weights given to rrcb_balance, or their
 * number without weights; give it with measured loads, which are then smoothed. Null: not given
 * @param due        gets 1 if a rebalance is due, else 0; may be null */
RRCB_API int rrcb_controller_step(rrcb_controller* controller, double load, const double* weight,
                                  int* due);

/** Writes whether a rebalance is due before the next step. Not collective.
 *
 * @param controller of this loop
 * @param due        gets 1 or 0 */
RRCB_API int rrcb_controller_due(const rrcb_controller* controller, int* due);

/** Records a rebalance. Call it on all ranks; it does not communicate.
 *
 * @param controller of this loop
 * @param report     of the balance, from rrcb_get_report; or null
 * @param cost       of the rebalance on this rank, including everything that it moved, in the
 * unit of the loads */
RRCB_API int rrcb_controller_rebalanced(rrcb_controller* controller, const rrcb_report* report,
                                        double cost);

/** Returns the state as bytes, which are the same on every rank, as rrcb::save. Collective.
 *
 * @param controller owns the bytes until the next call
 * @param bytes      gets their address
 * @param size       gets their number */
RRCB_API int rrcb_controller_save(rrcb_controller* controller, const void** bytes, size_t* size);

/** Makes a controller that continues from saved bytes, as rrcb::load. Collective.
 *
 * @param comm       may be freed before the controller
 * @param bytes      the same on every rank
 * @param size       their number
 * @param controller as for rrcb_balancer_create */
RRCB_API int rrcb_controller_load(MPI_Comm comm, const void* bytes, size_t size,
                                  rrcb_controller** controller);

#ifdef __cplusplus
}
#endif

#endif
