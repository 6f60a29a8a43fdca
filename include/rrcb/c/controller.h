#ifndef RRCB_C_CONTROLLER_H
#define RRCB_C_CONTROLLER_H

#include <rrcb/c/balancer.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Decides when to rebalance. */
typedef struct rrcb_controller rrcb_controller;

/** Learns the costs of points. */
typedef struct rrcb_cost_model rrcb_cost_model;

/** Makes a controller, which belongs to the caller; as rrcb::Controller. Collective. */
RRCB_API int rrcb_controller_create(MPI_Comm comm, rrcb_controller** controller);

/** Makes a controller from a communicator of Fortran. Collective. */
RRCB_API int rrcb_controller_create_fortran(MPI_Fint comm, rrcb_controller** controller);

/** Frees a controller, which may be null. Collective. */
RRCB_API void rrcb_controller_destroy(rrcb_controller* controller);

/** Records a step that took this rank `load` of its own work, and writes 1 to `due`, which may be
 *  null, if a rebalance is due. Collective. */
RRCB_API int rrcb_controller_step(rrcb_controller* controller, double load, int* due);

/** Does the same with the number of points of this rank, or the sum of their weights. Collective.
 */
RRCB_API int rrcb_controller_step_points(rrcb_controller* controller, double load, double points,
                                         int* due);

/** Writes 1 if a rebalance is due before the next step, else 0. Not collective. */
RRCB_API int rrcb_controller_due(const rrcb_controller* controller, int* due);

/** Records a rebalance with its cost on this rank, and the report of the balance, or null. Called
 *  on all ranks, without communication. */
RRCB_API int rrcb_controller_rebalanced(rrcb_controller* controller, const rrcb_report* report,
                                        double cost);

/** Makes a cost model, which belongs to the caller; as rrcb::CostModel. Collective.
 *
 *  Its sums travel with the steps of `controller`, on the ranks of `comm`, which must outlive
 *  it and has recorded none; with a null one the model has a communicator of its own. */
RRCB_API int rrcb_cost_model_create(MPI_Comm comm, rrcb_controller* controller, int num_columns,
                                    rrcb_cost_model** model);

/** Makes a cost model from a communicator of Fortran, and the address of a controller or null.
 *  Collective. */
RRCB_API int rrcb_cost_model_create_fortran(MPI_Fint comm, rrcb_controller* const* controller,
                                            int num_columns, rrcb_cost_model** model);

/** Frees a cost model, which may be null. Collective unless it was made with a controller. */
RRCB_API void rrcb_cost_model_destroy(rrcb_cost_model* model);

/** Records a step: the seconds of this rank's own work, and its number of each column. With a
 *  controller also its step; rrcb_controller_due then returns the decision. Collective. */
RRCB_API int rrcb_cost_model_step(rrcb_cost_model* model, double seconds, size_t num_columns,
                                  const double* columns);

/** Writes the weight of each of `count` points in seconds, to divide them by at once; `columns` has
 *  length count * num_columns, point after point. Called on all ranks, without communication. */
RRCB_API int rrcb_cost_model_weights(rrcb_cost_model* model, size_t count, size_t num_columns,
                                     const double* columns, double* weights);

/** Writes the seconds of a unit of each column. Not collective. */
RRCB_API int rrcb_cost_model_costs(const rrcb_cost_model* model, size_t num_columns, double* costs);

/** Writes 1 if weights are by the costs, 0 if points are counted. Not collective. */
RRCB_API int rrcb_cost_model_uses_costs(const rrcb_cost_model* model, int* uses_costs);

/** Returns a sentence: whether costs are used, and why; valid until the next call; empty for a null
 * model. Not collective. */
RRCB_API const char* rrcb_cost_model_report(rrcb_cost_model* model);

#ifdef __cplusplus
}
#endif

#endif
