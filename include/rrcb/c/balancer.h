#ifndef RRCB_C_BALANCER_H
#define RRCB_C_BALANCER_H

#include <rrcb/c/plan.h>

#include <mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Communicator, options, cuts and plan. */
typedef struct rrcb_balancer rrcb_balancer;

/** One cut, as rrcb::Cut. */
typedef struct rrcb_cut {
    int32_t axis;    /**< that the cut is across */
    int32_t divides; /**< 1: some of the points exactly at it are below */
    double at[3];    /**< a plane at at[axis]; ties are broken by the others */
} rrcb_cut;

/** The tree of cuts, as rrcb::Cuts: num_parts - 1 of them in preorder. */
typedef struct rrcb_cuts {
    int dimension;        /**< of the points */
    int num_parts;        /**< of the whole tree */
    const rrcb_cut* tree; /**< num_parts - 1 cuts, borrowed */
    int group_size;       /**< of rrcb::TreeShape, 1 or more */
    int larger_below;     /**< 1: rrcb::TreeShape::larger_below */
    int dealt;            /**< of rrcb::TreeShape, 0 or more */
} rrcb_cuts;

/** Report of the last balance, as rrcb::Report; the same on every rank. */
typedef struct rrcb_report {
    double imbalance;           /**< heaviest part / mean part, counted; NaN if not counted */
    int within_tolerance;       /**< 1: `imbalance` is within the tolerance */
    int kept;                   /**< 1: the points stay on their ranks */
    int64_t num_points;         /**< over all ranks */
    double total_weight;        /**< over all ranks */
    double least_imbalance;     /**< lower bound of the imbalance of any partition */
    double estimated_imbalance; /**< of the statistical domain */
    int64_t num_records;        /**< cells bisected */
    int rounds;                 /**< of counting, for the refinement */
    int coincident_cuts;        /**< that would divide points which no allowed cut separates */
    int all_weights_zero;       /**< 1: balanced by count instead */
    int surplus_parts;          /**< parts that must stay empty: more parts than points */
} rrcb_report;

/** Makes a balancer with the default options and no cuts, which belongs to the caller.
 *
 *  Collective over `comm`, which must outlive it. If it fails, `*balancer` is left unchanged. */
RRCB_API int rrcb_create(MPI_Comm comm, rrcb_balancer** balancer);

/** Makes a balancer from a communicator of Fortran. Collective. */
RRCB_API int rrcb_create_fortran(MPI_Fint comm, rrcb_balancer** balancer);

/** Frees a balancer, which may be null, and the cuts and the plan it has shown. Not collective. */
RRCB_API void rrcb_destroy(rrcb_balancer* balancer);

/** Sets an option by its name in rrcb::Options, to a text as docs/parameters.md lists them:
 *  ("refine", "EXACT"), ("imbalance_tolerance", "1.05"), ("axes.min_width", "0.1 0.1").
 *
 *  Not collective, but all ranks set the same, which rrcb_balance checks. */
RRCB_API int rrcb_set(rrcb_balancer* balancer, const char* option, const char* value);

/** Sets the relative weights of the parts; none for equal ones. Not collective, as rrcb_set. */
RRCB_API int rrcb_set_part_sizes(rrcb_balancer* balancer, size_t count, const double* sizes);

/** Writes the part of each point of this rank into `parts`, and keeps the cuts; as rrcb::balance.
 *
 *  Collective. On a rank without points, which states the dimension, arrays may be null. From the
 *  second call on with as many points no memory is allocated for each point. */
RRCB_API int rrcb_balance(rrcb_balancer* balancer, const rrcb_points* points, int32_t* parts);

/** Does the same from the cuts of the balancer, for points that moved little since; as
 *  rrcb::rebalance. Collective. */
RRCB_API int rrcb_rebalance(rrcb_balancer* balancer, const rrcb_points* points, int32_t* parts);

/** Frees the buffers that calls on the communicator keep for the next ones, as
 *  rrcb::release_buffers. Not collective. */
RRCB_API int rrcb_release_buffers(rrcb_balancer* balancer);

/** Writes the report of the last balance. Not collective. Fails before the first. */
RRCB_API int rrcb_get_report(const rrcb_balancer* balancer, rrcb_report* report);

/** Shows the cuts, which belong to the balancer until it gets others. Not collective.
 *
 *  Fails before the first balance or rrcb_set_cuts, as all functions that need cuts. After
 *  rrcb_set("cuts", "OWN") also fails on this rank only if it has only some cuts, see rrcb::Cuts;
 *  call rrcb_gather_cuts before. */
RRCB_API int rrcb_get_cuts(const rrcb_balancer* balancer, rrcb_cuts* cuts);

/** Gives each rank's balancer all cuts, if each has some of them, as rrcb::gather_cuts.
 *  Collective. */
RRCB_API int rrcb_gather_cuts(rrcb_balancer* balancer);

/** Gives the balancer cuts, as of an earlier run; they are copied. Not collective, but all ranks
 *  give the same, which rrcb_rebalance checks. */
RRCB_API int rrcb_set_cuts(rrcb_balancer* balancer, const rrcb_cuts* cuts);

/** Writes the part of a position, of length 3, without any checks of it; as rrcb::part_of. Not
 *  collective. */
RRCB_API int rrcb_part_of(const rrcb_balancer* balancer, const double* position, int32_t* part);

/** Writes the parts of any positions by the cuts, as rrcb::assign. Not collective.
 *
 *  After rrcb_set("cuts", "OWN") fails on this rank only if it lacks a cut above a position; call
 *  rrcb_assign_all instead. */
RRCB_API int rrcb_assign(const rrcb_balancer* balancer, const rrcb_points* points, int32_t* parts);

/** Writes the parts of any positions, whichever cuts the ranks have; as rrcb::assign_all.
 *  Collective. */
RRCB_API int rrcb_assign_all(const rrcb_balancer* balancer, const rrcb_points* points,
                             int32_t* parts);

/** Writes the region of a part by the cuts: `lower` and `upper` of length 3. Not collective.
 *
 *  After rrcb_set("cuts", "OWN") fails on this rank only if it lacks a cut above the part;
 *  call rrcb_gather_cuts before. */
RRCB_API int rrcb_box_of(const rrcb_balancer* balancer, int32_t part, double* lower, double* upper);

/** Writes the parts whose region a closed box touches, ascending, as rrcb::parts_touching; `lower`
 *  and `upper` have length 3. Not collective.
 *
 *  Writes how many there are to `count`, and the first `capacity` of them to `parts`. */
RRCB_API int rrcb_parts_touching(const rrcb_balancer* balancer, const double* lower,
                                 const double* upper, size_t capacity, int32_t* parts,
                                 size_t* count);

/** Makes and keeps the plan that brings `count` points to the ranks of their parts, as rrcb::plan;
 *  the parts are those of the cuts. Collective. */
RRCB_API int rrcb_make_plan(rrcb_balancer* balancer, size_t count, const int32_t* parts);

/** Shows the plan, which belongs to the balancer until it makes another. Not collective. Fails
 *  before the first, as rrcb_transfer. */
RRCB_API int rrcb_get_plan(const rrcb_balancer* balancer, rrcb_plan* plan);

/** Moves columns along the plan, as rrcb::transfer: first the points that stay, then those that
 *  come.
 *
 *  Collective. A column has an entry for each of plan.num_points points, its result for each of
 *  plan.num_points_after. `limits` may be null, for the default, and so may `report`. */
RRCB_API int rrcb_transfer(rrcb_balancer* balancer, size_t num_columns, const rrcb_column* columns,
                           const rrcb_transfer_limits* limits, rrcb_transfer_report* report);

/** Numbers the parts of the cuts so that many points stay, as rrcb::remap. Collective.
 *
 *  `parts` is the new part of each of `count` points. `previous` is the part that each was in, or
 *  null on all ranks that have points: then points stay on their ranks. Part p is on
 *  ranks_of_parts[p], if not null, otherwise as by rrcb_ranks_of_part. Writes the new number of
 *  part p to numbers[p], of which there are num_parts; `kept` may be null. */
RRCB_API int rrcb_remap(rrcb_balancer* balancer, size_t count, const int32_t* parts,
                        const int32_t* previous, const rrcb_rank_range* ranks_of_parts,
                        size_t num_parts, int32_t* numbers, rrcb_kept* kept);

#ifdef __cplusplus
}
#endif

#endif
