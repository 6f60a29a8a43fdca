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
 * @param controller  carries the sums of the model with its steps; it must outlive the model and
 * not have recorded a step. Null: the model has a communicator of its own
 * @param num_columns must be the same on every rank
 * @param model       as for rrcb_balancer_create */
RRCB_API int rrcb_cost_model_create(MPI_Comm comm, rrcb_controller* controller, int num_columns,
                                    rrcb_cost_model** model);

/** Frees a cost model. Collective unless it was made with a controller.
 *
 * @param model as for rrcb_balancer_destroy */
RRCB_API void rrcb_cost_model_destroy(rrcb_cost_model** model);

/** Returns the state as bytes, as rrcb_controller_save. Collective.
 *
 * @param model owns the bytes until the next call
 * @param bytes gets their address
 * @param size  gets their number */
RRCB_API int rrcb_cost_model_save(rrcb_cost_model* model, const void** bytes, size_t* size);

/** Makes a model that continues from saved bytes, as load_cost_model(). Collective.
 *
 * @param comm       may be freed before the model
 * @param controller was loaded before, and must outlive the model; null: as for
 * rrcb_cost_model_create
 * @param bytes      the same on every rank
 * @param size       their number
 * @param model      as for rrcb_balancer_create */
RRCB_API int rrcb_cost_model_load(MPI_Comm comm, rrcb_controller* controller, const void* bytes,
                                  size_t size, rrcb_cost_model** model);

/** Records a step, also in the controller of the model. Its decision is returned by
 * rrcb_controller_due. Collective.
 *
 * @param model       of this loop
 * @param seconds     of this rank's own work, without waiting
 * @param num_columns that of the model
 * @param columns     numbers of this rank, one for each column */
RRCB_API int rrcb_cost_model_step(rrcb_cost_model* model, double seconds, size_t num_columns,
                                  const double* columns);

/** Writes the weight of each point in seconds, by which to balance at once. Call it on all ranks;
 * it does not communicate.
 *
 * @param model       of this loop
 * @param count       number of points of this rank
 * @param num_columns that of the model
 * @param columns     a row of columns for each point, one row after the other
 * @param weights     gets one for each point */
RRCB_API int rrcb_cost_model_weights(rrcb_cost_model* model, size_t count, size_t num_columns,
                                     const double* columns, double* weights);

/** Writes the number of columns, for example of a loaded model. Not collective.
 *
 * @param model       of this loop
 * @param num_columns gets the number */
RRCB_API int rrcb_cost_model_num_columns(const rrcb_cost_model* model, int* num_columns);

/** Writes the seconds that one unit of each column costs. Not collective.
 *
 * @param model       of this loop
 * @param num_columns that of the model
 * @param costs       gets one for each column */
RRCB_API int rrcb_cost_model_costs(const rrcb_cost_model* model, size_t num_columns, double* costs);

/** Writes whether the weights use the costs. Not collective.
 *
 * @param model      of this loop
 * @param uses_costs gets 1, or 0 if points are counted */
RRCB_API int rrcb_cost_model_uses_costs(const rrcb_cost_model* model, int* uses_costs);

/** Returns a sentence that explains whether costs are used, and why. Not collective. The text is
 * valid until the next call; it is empty for a null model. */
RRCB_API const char* rrcb_cost_model_report(rrcb_cost_model* model);

#ifdef __cplusplus
}
#endif

#endif
