#ifndef RRCB_C_BALANCER_H
#define RRCB_C_BALANCER_H

#include <rrcb/c/plan.h>

#include <mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Contains a communicator, options, cuts and a plan. */
typedef struct rrcb_balancer rrcb_balancer;

/** One cut, as rrcb::Cut. This struct never changes, because arrays contain it. */
typedef struct rrcb_cut {
    int32_t axis;    /**< axis that the cut is across */
    int32_t divides; /**< 1: some of the points exactly at it are below */
    double at[3];    /**< position of the plane, at[axis]; the others break ties */
} rrcb_cut;

/** The tree of cuts, as rrcb::Cuts: num_parts - 1 of them in preorder. */
typedef struct rrcb_cuts {
    size_t size;            /**< of this struct, set by RRCB_CUTS_INIT */
    int dimension;          /**< of the points */
    int num_parts;          /**< of the complete tree */
    const rrcb_cut* tree;   /**< num_parts - 1 cuts, borrowed */
    int group_size;         /**< of rrcb::TreeShape, 1 or more */
    int larger_below;       /**< 1: rrcb::TreeShape::larger_below */
    int round_robin_block;  /**< of rrcb::TreeShape, 0 or more */
    const int32_t* numbers; /**< part of each end of the tree, borrowed; NULL: by the shape */
    double debt;            /**< for the next balance, as rrcb::Cuts::debt */
} rrcb_cuts;

/** Cuts of dimension 0, which no function of the library accepts. */
#define RRCB_CUTS_INIT \
    { sizeof(rrcb_cuts), 0, 0, NULL, 1, 0, 0, NULL, 0 }

/** Report of the last balance, as rrcb::Report; the same on every rank. */
typedef struct rrcb_report {
    size_t size;            /**< of this struct, set by RRCB_REPORT_INIT */
    double imbalance;       /**< heaviest part / mean part; NaN if not counted, 1 without points */
    int within_tolerance;   /**< 1: `imbalance` is within the tolerance */
    int kept;               /**< 1: nothing moves, because the points of rank r are part r */
    int64_t num_points;     /**< over all ranks */
    double total_weight;    /**< over all ranks */
    double least_imbalance; /**< lower bound of the imbalance of any partition */
    double estimated_imbalance; /**< of the statistical domain */
    int64_t num_cells;          /**< cells that were bisected */
    int rounds;                 /**< how often the refinement has counted the points */
    int coincident_cuts;        /**< cuts that would have to divide inseparable points */
    int all_weights_zero;       /**< 1: points were balanced by their number instead */
    int num_empty_parts;        /**< parts that stay empty because points are fewer */
} rrcb_report;

/** A report that belongs to no balance. */
#define RRCB_REPORT_INIT \
    { sizeof(rrcb_report), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }

/** Makes a balancer with the default options and no cuts. Collective.
 *
 * @param comm     must outlive the balancer
 * @param balancer points to null; gets the balancer, for rrcb_balancer_destroy; unchanged if the
 * call fails
 */
RRCB_API int rrcb_balancer_create(MPI_Comm comm, rrcb_balancer** balancer);

/** Frees a balancer, and the cuts and the plan that it has shown. Not collective.
 *
 * @param balancer may be null or point to null; its pointer is set to null. Do not use copies of
 * the pointer any more; that cannot be checked */
RRCB_API void rrcb_balancer_destroy(rrcb_balancer** balancer);

/** Sets an option, such as ("refine", "EXACT") or ("axes.min_width", "0.1 0.1"). Not collective.
 *
 * @param balancer the same options on all ranks, which rrcb_balance checks
 * @param option   its name in rrcb::Options
 * @param value    as docs/parameters.md lists them */
RRCB_API int rrcb_balancer_set(rrcb_balancer* balancer, const char* option, const char* value);

/** Sets the relative weights of the parts. Not collective.
 *
 * @param balancer the same sizes on all ranks, which rrcb_balance checks
 * @param count    one for each part; 0: equal parts
 * @param sizes    0 or more, not all 0 */
RRCB_API int rrcb_balancer_set_part_sizes(rrcb_balancer* balancer, size_t count,
                                          const double* sizes);

/** Divides the points of all ranks into parts, as rrcb::balance. Starts from the cuts of the
 * balancer, if it has any, and keeps the new ones. Collective. Call rrcb_set_cuts(balancer, NULL)
 * before, if the option refine is NONE, if the dimension has changed, or if num_parts has changed
 * and is not 0.
 *
 * @param balancer with the options; gets the cuts and the report
 * @param points   of this rank; if there are none, arrays may be null, but the dimension must be
 * set
 * @param parts    gets the part of each point; may be null if there are none */
RRCB_API int rrcb_balance(rrcb_balancer* balancer, const rrcb_points* points, int32_t* parts);

/** Frees the buffers that calls on the communicator keep for later calls, as
 * rrcb::release_buffers. Not collective. */
RRCB_API int rrcb_release_buffers(rrcb_balancer* balancer);

/** Writes the report of the last balance. Not collective.
 *
 * @param balancer fails before its first balance
 * @param report   gets the report */
RRCB_API int rrcb_get_report(const rrcb_balancer* balancer, rrcb_report* report);

/** Gives access to the cuts. Not collective.
 *
 * @param balancer owns the cuts until it gets others
 * @param cuts     gets a view of them
 * Fails before the first balance or rrcb_set_cuts, as do all functions that need cuts. */
RRCB_API int rrcb_get_cuts(const rrcb_balancer* balancer, rrcb_cuts* cuts);

/** Copies cuts into the balancer, for example those of an earlier run. Not collective.
 *
 * @param balancer uses them in rrcb_balance and in look-ups
 * @param cuts     must be the same on all ranks, which rrcb_balance checks. Null: forgets the cuts,
 * so that the next rrcb_balance starts from scratch */
RRCB_API int rrcb_set_cuts(rrcb_balancer* balancer, const rrcb_cuts* cuts);

/** Returns the cuts as bytes, as rrcb::save. Not collective.
 *
 * @param balancer owns the bytes until the next call; fails as rrcb_get_cuts
 * @param bytes    gets their address
 * @param size     gets their number */
RRCB_API int rrcb_save_cuts(rrcb_balancer* balancer, const void** bytes, size_t* size);

/** Copies saved cuts into the balancer, as rrcb::load. Not collective.
 *
 * @param balancer uses them in rrcb_balance and in look-ups
 * @param bytes    from rrcb_save_cuts
 * @param size     their number */
RRCB_API int rrcb_load_cuts(rrcb_balancer* balancer, const void* bytes, size_t size);

/** Writes the part of a position, as rrcb::part_of. Not collective.
 *
 * @param balancer with cuts
 * @param position of length 3, not checked
 * @param part     gets its part */
RRCB_API int rrcb_part_of(const rrcb_balancer* balancer, const double* position, int32_t* part);

/** Writes the part of every point by the cuts, as rrcb::assign. Not collective.
 *
 * @param balancer with cuts
 * @param points   of the dimension of the cuts; weights are ignored
 * @param parts    gets the part of each point */
RRCB_API int rrcb_assign(const rrcb_balancer* balancer, const rrcb_points* points, int32_t* parts);

/** Writes the part of every point, as rrcb::assign with a communicator: if one rank fails, all fail
 * in the same way. Collective.
 *
 * @param balancer with cuts
 * @param points   of this rank, of the dimension of the cuts; weights are ignored
 * @param parts    gets the part of each point */
RRCB_API int rrcb_assign_all(const rrcb_balancer* balancer, const rrcb_points* points,
                             int32_t* parts);

/** Writes the region of a part; sides without a cut are +-infinity. Not collective.
 *
 * After rrcb_balancer_set(balancer, "axes.plain", "ON") the region contains its lower faces and
 * not its upper ones; see rrcb::box_of.
 * @param balancer with cuts
 * @param part     0 ... num_parts - 1
 * @param lower    gets the lower end, of length 3
 * @param upper    gets the upper end, of length 3 */
RRCB_API int rrcb_box_of(const rrcb_balancer* balancer, int32_t part, double* lower, double* upper);

/** Writes the parts whose region touches a closed box, as rrcb::parts_touching. Not collective.
 *
 * @param balancer with cuts
 * @param lower    lower end of the box, of length 3
 * @param upper    upper end of the box, of length 3
 * @param capacity length of `parts`
 * @param parts    gets the first `capacity` of these parts, ascending
 * @param count    gets the number of these parts, which may be larger than `capacity` */
RRCB_API int rrcb_parts_touching(const rrcb_balancer* balancer, const double* lower,
                                 const double* upper, size_t capacity, int32_t* parts,
                                 size_t* count);

/** Makes the plan that brings points to the ranks of their parts, as rrcb::plan, and keeps it.
 * Collective.
 *
 * @param balancer with the cuts of the parts; gets the plan
 * @param count    number of points of this rank, at least as many as were balanced, or assigned
 * since
 * @param parts    the new part of each */
RRCB_API int rrcb_plan(rrcb_balancer* balancer, size_t count, const int32_t* parts);

/** Gives access to the plan. Not collective.
 *
 * @param balancer owns the plan until it makes another; fails before the first one
 * @param plan     gets a view of it */
RRCB_API int rrcb_get_plan(const rrcb_balancer* balancer, rrcb_plan_lists* plan);

/** Moves columns along the plan, as rrcb::transfer: the points that stay come first, then those
 * that arrive. Collective.
 *
 * @param balancer    with a plan
 * @param num_columns must be the same on every rank
 * @param columns     `from` has num_points entries of the plan, `to` has room for
 * num_points_after
 * @param options     null: the default */
RRCB_API int rrcb_transfer(rrcb_balancer* balancer, size_t num_columns, const rrcb_column* columns,
                           const rrcb_transfer_options* options);

/** Numbers the parts of the cuts so that many points stay, as rrcb::remap. Collective.
 *
 * @param balancer       with cuts
 * @param count          number of points of this rank
 * @param parts          the new part of each
 * @param previous       the part that each was in; if it is null on all ranks with points,
 * points should stay on their ranks
 * @param ranks_of_parts the ranks of each part; null: those of rrcb_ranks_of_part
 * @param num_parts      that of the cuts, length of `numbers`
 * @param numbers        gets the new number of each part
 * @param report         gets how many points stay; may be null */
RRCB_API int rrcb_remap(rrcb_balancer* balancer, size_t count, const int32_t* parts,
                        const int32_t* previous, const rrcb_rank_range* ranks_of_parts,
                        size_t num_parts, int32_t* numbers, rrcb_remap_report* report);

#ifdef __cplusplus
}
#endif

#endif
