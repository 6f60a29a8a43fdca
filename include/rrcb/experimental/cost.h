#ifndef RRCB_EXPERIMENTAL_COST_H
#define RRCB_EXPERIMENTAL_COST_H

#include <rrcb/c/controller.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Learns the costs of points. */
typedef struct rrcb_cost_model rrcb_cost_model;

/** Makes a cost model, as rrcb::experimental::CostModel. Collective.
 *
 * @param comm        may be freed before the model
 * @param controller  carries the sums with its steps: outlives the model, has recorded none. Null:
 * the model has a communicator of its own
 * @param num_columns the same on every rank
 * @param model       as for rrcb_balancer_create */
RRCB_API int rrcb_cost_model_create(MPI_Comm comm, rrcb_controller* controller, int num_columns,
                                    rrcb_cost_model** model);

/** Frees a cost model. Collective unless it was made with a controller.
 *
 * @param model as for rrcb_balancer_destroy */
RRCB_API void rrcb_cost_model_destroy(rrcb_cost_model** model);

/** Shows the state as bytes, as rrcb_controller_save. Collective.
 *
 * @param model owns the bytes until the next call
 * @param bytes gets their address
 * @param size  gets their number */
RRCB_API int rrcb_cost_model_save(rrcb_cost_model* model, const void** bytes, size_t* size);

/** Makes a model that continues from saved bytes, as load_cost_model(). Collective.
 *
 * @param comm       may be freed before the model
 * @param controller loaded before, outlives the model; null: as for rrcb_cost_model_create
 * @param bytes      the same on every rank
 * @param size       number of them
 * @param model      as for rrcb_balancer_create */
RRCB_API int rrcb_cost_model_load(MPI_Comm comm, rrcb_controller* controller, const void* bytes,
                                  size_t size, rrcb_cost_model** model);

/** Records a step, also in the controller of the model, whose decision rrcb_controller_due returns.
 * Collective.
 *
 * @param model       of this loop
 * @param seconds     of this rank's own work, without waiting
 * @param num_columns those of the model
 * @param columns     numbers of this rank, one for each column */
RRCB_API int rrcb_cost_model_step(rrcb_cost_model* model, double seconds, size_t num_columns,
                                  const double* columns);

/** Writes the weight of each point in seconds, to balance by at once. Called on all ranks, without
 * communication.
 *
 * @param model       of this loop
 * @param count       points of this rank
 * @param num_columns those of the model
 * @param columns     a row of columns for each point, one row after the other
 * @param weights     gets one for each point */
RRCB_API int rrcb_cost_model_weights(rrcb_cost_model* model, size_t count, size_t num_columns,
                                     const double* columns, double* weights);

/** Writes the number of columns, as of a loaded model. Not collective.
 *
 * @param model       of this loop
 * @param num_columns gets it */
RRCB_API int rrcb_cost_model_num_columns(const rrcb_cost_model* model, int* num_columns);

/** Writes the seconds of a unit of each column. Not collective.
 *
 * @param model       of this loop
 * @param num_columns those of the model
 * @param costs       gets one for each column */
RRCB_API int rrcb_cost_model_costs(const rrcb_cost_model* model, size_t num_columns, double* costs);

/** Writes whether weights are by the costs. Not collective.
 *
 * @param model      of this loop
 * @param uses_costs gets 1, or 0 if points are counted */
RRCB_API int rrcb_cost_model_uses_costs(const rrcb_cost_model* model, int* uses_costs);

/** Returns a sentence: whether costs are used, and why. Not collective; valid until the next call,
 * empty for a null model. */
RRCB_API const char* rrcb_cost_model_report(rrcb_cost_model* model);

#ifdef __cplusplus
}
#endif

#endif
