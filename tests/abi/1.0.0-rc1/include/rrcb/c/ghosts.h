#ifndef RRCB_C_GHOSTS_H
#define RRCB_C_GHOSTS_H

#include <rrcb/c/balancer.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Points that ranks send and receive as ghosts, with their communicator. */
typedef struct rrcb_ghosts rrcb_ghosts;

/** Determines whose cutoff counts if points have different ones; as rrcb::Needs. */
typedef enum rrcb_needs {
    RRCB_NEEDS_SCATTER = 0,  /**< a rank gets the points whose radii reach one of its parts */
    RRCB_NEEDS_GATHER = 1,   /**< it gets the points within the radius of one of its points */
    RRCB_NEEDS_SYMMETRIC = 2 /**< it gets both */
} rrcb_needs;

/** Distances within which points are needed, and the ranks of the parts; as rrcb::GhostOptions. */
typedef struct rrcb_ghost_options {
    size_t size;   /**< of this struct, set by RRCB_GHOST_OPTIONS_INIT */
    double cutoff; /**< cut-off of all points, in the unit of the coordinates; 0: not given */
    const double* cutoffs; /**< one for each point instead, 0 or more; null on all ranks
                              with points: not given */
    const double* lower;   /**< lower end of the periodic box, of length 3; null: no box */
    const double* upper;   /**< upper end of the same box */
    const rrcb_rank_range* ranks_of_parts; /**< an entry for each part, as after rrcb_remap; null:
                                              those of rrcb_ranks_of_part */
    size_t num_parts;                      /**< length of `ranks_of_parts`, 0 if that is null */
    int64_t needs;                         /**< an rrcb_needs */
} rrcb_ghost_options;

/** Options without a cutoff and without a periodic box, with the needs of senders. */
#define RRCB_GHOST_OPTIONS_INIT \
    { sizeof(rrcb_ghost_options), 0, NULL, NULL, NULL, NULL, 0, RRCB_NEEDS_SCATTER }

/** Lists of the points sent and received as ghosts, as rrcb::GhostPlan; indices count from 0. */
typedef struct rrcb_ghost_plan {
    size_t size;                    /**< of this struct, set by RRCB_GHOST_PLAN_INIT */
    size_t num_points;              /**< points of this rank */
    size_t num_ghosts;              /**< ghosts of this rank */
    size_t num_send_ranks;          /**< length of `send` */
    const rrcb_rank_count* send;    /**< points that each rank needs; ranks ascending */
    size_t num_sent;                /**< length of `send_indices` */
    const size_t* send_indices;     /**< for the first rank ascending, then for the next, ... */
    size_t num_receive_ranks;       /**< length of `receive` */
    const rrcb_rank_count* receive; /**< ghosts from each rank; ranks ascending */
    const int32_t* shifts;          /**< three for each ghost: periods along each axis; null without
                                         a periodic box */
} rrcb_ghost_plan;

/** Lists without points. */
#define RRCB_GHOST_PLAN_INIT \
    { sizeof(rrcb_ghost_plan), 0, 0, 0, NULL, 0, NULL, 0, NULL, NULL }

/** Finds the points that other ranks need, as rrcb::ghosts. Collective.
 *
 * @param balancer with the cuts whose parts the points are in; not needed afterwards
 * @param points   of this rank, after rrcb_transfer. The points of the balance or of
 * rrcb_assign_all are refused if one of them has yet to leave its rank
 * @param options  cutoff, periodic box, ranks of the parts
 * @param ghosts   as for rrcb_balancer_create */
RRCB_API int rrcb_ghosts_create(const rrcb_balancer* balancer, const rrcb_points* points,
                                const rrcb_ghost_options* options, rrcb_ghosts** ghosts);

/** Frees ghosts and their lists. Not collective.
 *
 * @param ghosts as for rrcb_balancer_destroy */
RRCB_API void rrcb_ghosts_destroy(rrcb_ghosts** ghosts);

/** Gives access to the lists. Not collective.
 *
 * @param ghosts own the lists
 * @param plan   gets a view of them */
RRCB_API int rrcb_ghosts_get_plan(const rrcb_ghosts* ghosts, rrcb_ghost_plan* plan);

/** Fetches columns of the ghosts, as rrcb::fetch. Collective.
 *
 * @param ghosts      may be used again as long as no point changes its index
 * @param num_columns must be the same on every rank
 * @param columns     `from` has num_points entries of the plan, `to` room for num_ghosts
 * @param options     null: the default */
RRCB_API int rrcb_ghosts_fetch(const rrcb_ghosts* ghosts, size_t num_columns,
                               const rrcb_column* columns, const rrcb_transfer_options* options);

/** Fetches rows that the ranks of the ghosts send back, as rrcb::reply. Collective.
 *
 * @param ghosts      as for rrcb_ghosts_fetch
 * @param num_columns must be the same on every rank
 * @param columns     `from` has an entry for each ghost, `to` has room for num_sent of the plan
 * @param options     null: the default */
RRCB_API int rrcb_ghosts_reply(const rrcb_ghosts* ghosts, size_t num_columns,
                               const rrcb_column* columns, const rrcb_transfer_options* options);

/** Adds values of ghosts, for example forces, to the values of their points, as rrcb::accumulate.
 * Collective.
 *
 * @param ghosts      as for rrcb_ghosts_fetch
 * @param num_columns must be the same on every rank
 * @param columns     `from` has an entry for each ghost, `to` has the values of the points, to
 * which they are added; RRCB_BYTE is not allowed
 * @param options     null: the default
 * If it fails, `to` is unchanged, except on a rank on which a message fails. */
RRCB_API int rrcb_ghosts_accumulate(const rrcb_ghosts* ghosts, size_t num_columns,
                                    const rrcb_column* columns,
                                    const rrcb_transfer_options* options);

/** Moves fetched positions to those of the images, as rrcb::apply_shifts. Not collective.
 *
 * @param ghosts    for which the positions were fetched
 * @param positions num_ghosts of them, interleaved, in columns or in structs; the arrays are
 * changed */
RRCB_API int rrcb_ghosts_apply_shifts(const rrcb_ghosts* ghosts, const rrcb_points* positions);

#ifdef __cplusplus
}
#endif

#endif
