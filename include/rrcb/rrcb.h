#ifndef RRCB_H
#define RRCB_H

#include <rrcb/export.h>
#include <rrcb/version.h>

#include <mpi.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @file
 * The library in C: a balancer holds what rrcb/balance.hpp, options.hpp, cuts.hpp, plan.hpp and
 * transfer.hpp take and give, a controller and a cost model are those of controller.hpp and
 * cost.hpp; these headers are the manual of what is only named here.
 *
 * Every function that can fail returns RRCB_OK or another rrcb_code. From a collective function all
 * ranks of the communicator get the same code and text; a null balancer alone is an error of its
 * rank. No exception leaves a function. A balancer is used by one thread at a time. */

/** What a function returns. */
typedef enum rrcb_code {
    RRCB_OK = 0,               /**< it did what was asked for */
    RRCB_INVALID_ARGUMENT = 1, /**< the caller's mistake: points, weights or options */
    RRCB_OUT_OF_MEMORY = 2,    /**< an allocation failed on some rank */
    RRCB_MPI_ERROR = 3,        /**< an MPI call returned an error */
    RRCB_INTERNAL_ERROR = 4    /**< an invariant does not hold */
} rrcb_code;

/** Communicator, options, cuts and plan. */
typedef struct rrcb_balancer rrcb_balancer;

/** Decides when to rebalance. */
typedef struct rrcb_controller rrcb_controller;

/** Learns what points cost. */
typedef struct rrcb_cost_model rrcb_cost_model;

/** One cut, as rrcb::Cut. */
typedef struct rrcb_cut {
    int32_t axis;    /**< that the cut is across */
    int32_t divides; /**< 1: of the points exactly at it some lie below */
    double at[3];    /**< a plane at at[axis]; ties are broken by the others */
} rrcb_cut;

/** The tree of cuts, as rrcb::Cuts: num_parts - 1 of them in preorder. */
typedef struct rrcb_cuts {
    int dimension;        /**< of the points */
    int num_parts;        /**< of the whole tree */
    const rrcb_cut* tree; /**< num_parts - 1 cuts, borrowed */
    int group_size;       /**< of rrcb::TreeShape, 1 or more */
    int larger_below;     /**< 1: rrcb::TreeShape::larger_below */
} rrcb_cuts;

/** Of the last balance, as rrcb::Report. */
typedef struct rrcb_report {
    double imbalance;       /**< heaviest part / mean part, counted; NaN if not counted */
    int within_tolerance;   /**< 1: `imbalance` is within the tolerance */
    int kept;               /**< 1: the points stay on their ranks */
    int64_t num_points;     /**< over all ranks */
    double total_weight;    /**< over all ranks */
    double least_imbalance; /**< lower bound of the imbalance of any partition */
    int rounds;             /**< of counting, for the refinement */
} rrcb_report;

/** Lists of the points whose rank changes, as rrcb::Plan; indices count from 0. */
typedef struct rrcb_plan {
    size_t num_points;            /**< that this rank holds before */
    size_t num_points_after;      /**< that it holds then */
    size_t num_exports;           /**< length of the lists of exports */
    const size_t* export_indices; /**< of my points that leave, ascending */
    const int* export_ranks;      /**< where they go */
    const int32_t* export_parts;  /**< their new parts */
    size_t num_imports;           /**< length of the lists of imports */
    const int* import_ranks;      /**< where my new points come from, ascending */
    const size_t* import_indices; /**< their index there, ascending per rank */
    const int32_t* import_parts;  /**< their new parts */
} rrcb_plan;

/** Returns the version of the library, as "major.minor.patch". Not collective; the string is
 * static. */
RRCB_API const char* rrcb_version(void);

/** Returns what the library was built from and with, as rrcb::build_info. Not collective; static.
 */
RRCB_API const char* rrcb_build_info(void);

/** Returns the text of the last error on this thread: the place and the fix. Not collective; valid
 *  until the next error, empty if there was none. */
RRCB_API const char* rrcb_last_error(void);

/** Makes a balancer with the default options and no cuts, which belongs to the caller.
 *
 *  Collective over `comm`, which must outlive it. If it fails, `*balancer` is left unchanged. */
RRCB_API int rrcb_create(MPI_Comm comm, rrcb_balancer** balancer);

/** Makes a balancer from a communicator of Fortran. Collective. */
RRCB_API int rrcb_create_fortran(MPI_Fint comm, rrcb_balancer** balancer);

/** Frees a balancer, which may be null, and what it has given. Not collective. */
RRCB_API void rrcb_free(rrcb_balancer* balancer);

/** Sets an option by its name in rrcb::Options, to a text as docs/parameters.md lists them:
 *  ("refine", "EXACT"), ("imbalance_tolerance", "1.05"), ("axes.min_width", "0.1 0.1").
 *
 *  Not collective, but all ranks set the same, which rrcb_balance checks. */
RRCB_API int rrcb_set(rrcb_balancer* balancer, const char* option, const char* value);

/** Sets the relative weights of the parts; none for equal ones. Not collective, as rrcb_set. */
RRCB_API int rrcb_set_part_sizes(rrcb_balancer* balancer, size_t count, const double* sizes);

/** Gives each of `count` points of this rank its part, and keeps the cuts; as rrcb::balance.
 *
 *  Collective. `coordinates` has length count * dimension, point after point; `weights` length
 *  count, or null: every point weighs 1; `parts` has room for count. All may be null on a rank
 *  without points, which states the dimension. */
RRCB_API int rrcb_balance(rrcb_balancer* balancer, int dimension, size_t count,
                          const double* coordinates, const double* weights, int32_t* parts);

/** Does the same from the cuts of the balancer, for points that moved little since; as
 *  rrcb::rebalance. Collective. */
RRCB_API int rrcb_rebalance(rrcb_balancer* balancer, int dimension, size_t count,
                            const double* coordinates, const double* weights, int32_t* parts);

/** Writes the report of the last balance. Not collective. An error before the first. */
RRCB_API int rrcb_get_report(const rrcb_balancer* balancer, rrcb_report* report);

/** Shows the cuts, which belong to the balancer until it gets others. Not collective.
 *
 *  An error before the first balance or rrcb_set_cuts, as of all functions that need cuts. After
 *  rrcb_set("cuts", "OWN") also an error of this rank alone if it has some cuts only, see
 *  rrcb::Cuts; call rrcb_gather_cuts before. */
RRCB_API int rrcb_get_cuts(const rrcb_balancer* balancer, rrcb_cuts* cuts);

/** Gives each rank's balancer all cuts, if each has some of them, as rrcb::gather_cuts.
 *  Collective. */
RRCB_API int rrcb_gather_cuts(rrcb_balancer* balancer);

/** Gives the balancer cuts, as of an earlier run; they are copied. Not collective, but all ranks
 *  give the same, which rrcb_rebalance checks. */
RRCB_API int rrcb_set_cuts(rrcb_balancer* balancer, const rrcb_cuts* cuts);

/** Writes the parts of any positions by the cuts, arrays as for rrcb_balance; as rrcb::assign. Not
 *  collective.
 *
 *  After rrcb_set("cuts", "OWN") an error of this rank alone if it lacks a cut above a position;
 *  call rrcb_assign_all instead. */
RRCB_API int rrcb_assign(const rrcb_balancer* balancer, size_t count, const double* coordinates,
                         int32_t* parts);

/** Writes the parts of any positions, whichever cuts the ranks have; as rrcb::assign_all.
 *  Collective. */
RRCB_API int rrcb_assign_all(const rrcb_balancer* balancer, size_t count, const double* coordinates,
                             int32_t* parts);

/** Writes the region of a part by the cuts: `lower` and `upper` of length 3. Not collective.
 *
 *  After rrcb_set("cuts", "OWN") an error of this rank alone if it lacks a cut above the part;
 *  call rrcb_gather_cuts before. */
RRCB_API int rrcb_box_of(const rrcb_balancer* balancer, int32_t part, double* lower, double* upper);

/** Makes and keeps the plan that brings `count` points to the ranks of their parts, as rrcb::plan;
 *  the parts are those of the cuts. Collective. */
RRCB_API int rrcb_make_plan(rrcb_balancer* balancer, size_t count, const int32_t* parts);

/** Shows the plan, which belongs to the balancer until it makes another. Not collective. An error
 *  before the first, as of rrcb_transfer. */
RRCB_API int rrcb_get_plan(const rrcb_balancer* balancer, rrcb_plan* plan);

/** Moves a column along the plan, as rrcb::transfer: first the points that stay, then those that
 *  come.
 *
 *  Collective. A point has `bytes` of them, the same on every rank; `from` holds
 *  plan.num_points * bytes, `to` has room for plan.num_points_after * bytes elsewhere. Only the
 *  number of bytes is compared between ranks, not the type of what they hold. */
RRCB_API int rrcb_transfer(rrcb_balancer* balancer, size_t bytes, const void* from, void* to);

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

/** Makes a cost model from a communicator of Fortran. Collective. */
RRCB_API int rrcb_cost_model_create_fortran(MPI_Fint comm, rrcb_controller* controller,
                                            int num_columns, rrcb_cost_model** model);

/** Frees a cost model, which may be null. Collective unless it was made with a controller. */
RRCB_API void rrcb_cost_model_destroy(rrcb_cost_model* model);

/** Records a step: the seconds of this rank's own work, and its number of each column. With a
 *  controller also its step, whose answer rrcb_controller_due has. Collective. */
RRCB_API int rrcb_cost_model_step(rrcb_cost_model* model, double seconds, size_t num_columns,
                                  const double* columns);

/** Writes the weight of each of `count` points in seconds, to divide them by at once; `columns` has
 *  length count * num_columns, point after point. Called on all ranks, without communication. */
RRCB_API int rrcb_cost_model_weights(rrcb_cost_model* model, size_t count, size_t num_columns,
                                     const double* columns, double* weights);

/** Writes the seconds of a unit of each column. Not collective. */
RRCB_API int rrcb_cost_model_costs(const rrcb_cost_model* model, double* costs);

/** Writes 1 if weights are by the costs, 0 if points are counted. Not collective. */
RRCB_API int rrcb_cost_model_uses_costs(const rrcb_cost_model* model, int* uses_costs);

/** Returns why in a sentence, valid until the next call; empty for a null model. Not collective. */
RRCB_API const char* rrcb_cost_model_report(rrcb_cost_model* model);

#ifdef __cplusplus
}
#endif

#endif
