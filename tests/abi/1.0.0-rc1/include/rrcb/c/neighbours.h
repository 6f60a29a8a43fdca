#ifndef RRCB_C_NEIGHBOURS_H
#define RRCB_C_NEIGHBOURS_H

#include <rrcb/c/ghosts.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The ranks near this one, with memory for exchanges with them, as rrcb::Neighbours.
 *
 * Its functions wait only for neighbours. If one fails on a rank, it fails on the neighbours in
 * the same call, and on their neighbours in the next call. Then all ranks must destroy their
 * neighbours and create others. A null array of columns on one rank is such a failure, too. A
 * null handle is an error on its own rank only: no neighbours are known from it, so they wait
 * for the call. */
typedef struct rrcb_neighbours rrcb_neighbours;

/** Distances within which ranks are neighbours, and the ranks of the parts; as
 * rrcb::NeighbourOptions. At least one distance must be above 0. The options must be the same on
 * every rank. */
typedef struct rrcb_neighbour_options {
    size_t size;         /**< of this struct, set by RRCB_NEIGHBOUR_OPTIONS_INIT */
    double cutoff;       /**< cut-off of ghosts, in the unit of the coordinates; the largest one */
    double travel;       /**< distance that a point may move between two calls of migrate */
    const double* lower; /**< lower end of the periodic box; null: no box */
    const double* upper; /**< upper end of the same box */
    const rrcb_rank_range* ranks_of_parts; /**< as in rrcb_ghost_options */
    size_t num_parts;                      /**< length of `ranks_of_parts`, 0 if that is null */
    int64_t needs;                         /**< an rrcb_needs */
} rrcb_neighbour_options;

/** Options without distances and without a periodic box, with the needs of senders. */
#define RRCB_NEIGHBOUR_OPTIONS_INIT \
    { sizeof(rrcb_neighbour_options), 0, 0, NULL, NULL, NULL, 0, RRCB_NEEDS_SCATTER }

/** An array that calls lengthen or shorten, like a std::vector. If it has no room for the points
 * that arrive, the call makes room, so that no point is lost unless memory runs out. */
typedef struct rrcb_array {
    size_t size;       /**< of this struct, set by RRCB_ARRAY_INIT; the same in an array of these */
    int32_t type;      /**< of the values, an rrcb_type, the same on every rank */
    size_t components; /**< values of a point; its bytes for RRCB_BYTE */
    void* values;      /**< from malloc(), or null; calls may realloc() it, and you free() it */
    size_t count;      /**< points in it; set by the call */
    size_t capacity;   /**< points for which it has room, at least `count`; set by the call */
    /** If it is null, calls use realloc(). Otherwise they call resize(owner, count) when `count`
     * changes. It must keep the first values and return their address, or null if there is no
     * memory; `capacity` is then not used. */
    void* (*resize)(void* owner, size_t count);
    void* owner; /**< your object that owns the array; passed to `resize` */
} rrcb_array;

/** An array of this type without values. */
#define RRCB_ARRAY_INIT(type, components) \
    { sizeof(rrcb_array), (int32_t)(type), components, NULL, 0, 0, NULL, NULL }

/** Entries that ranks have in common, as rrcb::SharedEntries. */
typedef struct rrcb_shared_entries {
    size_t size;                  /**< of this struct, set by RRCB_SHARED_ENTRIES_INIT */
    size_t num_ranks;             /**< length of `ranks` */
    const rrcb_rank_count* ranks; /**< entries shared with each neighbour; ranks ascending */
    size_t num_indices;           /**< length of `indices` */
    const size_t* indices; /**< of these entries: for the first rank, then for the next, ... */
} rrcb_shared_entries;

/** No entries. */
#define RRCB_SHARED_ENTRIES_INIT \
    { sizeof(rrcb_shared_entries), 0, NULL, 0, NULL }

/** Finds the neighbours by the cuts of a balancer. Collective.
 *
 * @param balancer   with cuts; not needed afterwards, but its communicator is
 * @param options    distances, periodic box, ranks of the parts
 * @param neighbours as for rrcb_balancer_create */
RRCB_API int rrcb_neighbours_create(const rrcb_balancer* balancer,
                                    const rrcb_neighbour_options* options,
                                    rrcb_neighbours** neighbours);

/** Frees neighbours and their lists. Not collective.
 *
 * @param neighbours as for rrcb_balancer_destroy */
RRCB_API void rrcb_neighbours_destroy(rrcb_neighbours** neighbours);

/** Sends points that have left the parts of this rank to their ranks, and takes the points that
 * arrive, in place; as rrcb::Neighbours::migrate. Exchanges messages with all neighbours.
 *
 * @param neighbours  whose ghosts are no longer valid if a point moves
 * @param positions   view of the points, which are also in `columns`
 * @param num_columns must be the same on every rank
 * @param columns     each has as many points as `positions`, and gets the new number of points
 * Fails if a point is in a part that no neighbour holds; all arrays still contain that point. */
RRCB_API int rrcb_neighbours_migrate(rrcb_neighbours* neighbours, const rrcb_points* positions,
                                     size_t num_columns, rrcb_array* columns);

/** Finds the points that other ranks need, as rrcb::Neighbours::find_ghosts. Sends no messages,
 * except with RRCB_NEEDS_GATHER or RRCB_NEEDS_SYMMETRIC.
 *
 * @param neighbours get the lists
 * @param points     of this rank
 * @param cutoffs      one for each point, at most `cutoff` of the options; null: `cutoff` for all
 */
RRCB_API int rrcb_neighbours_find_ghosts(rrcb_neighbours* neighbours, const rrcb_points* points,
                                         const double* cutoffs);

/** Fetches columns of the ghosts, as rrcb::Neighbours::fetch. Exchanges messages with all
 * neighbours.
 *
 * @param neighbours  with ghosts
 * @param num_columns must be the same on every rank
 * @param columns     addresses of columns of the points, which have the types of `ghosts`
 * @param ghosts      an array for each column; gets a value for each ghost */
RRCB_API int rrcb_neighbours_fetch(rrcb_neighbours* neighbours, size_t num_columns,
                                   const void* const* columns, rrcb_array* ghosts);

/** Adds values of ghosts to those of their points, as rrcb::Neighbours::accumulate. Exchanges
 * messages with all neighbours.
 *
 * @param neighbours  whose ghosts were fetched
 * @param num_columns must be the same on every rank
 * @param columns     as for rrcb_ghosts_accumulate */
RRCB_API int rrcb_neighbours_accumulate(rrcb_neighbours* neighbours, size_t num_columns,
                                        const rrcb_column* columns);

/** Replaces shared entries by the sums over all ranks that list them, as rrcb::Neighbours::sum.
 * Exchanges messages with all neighbours.
 *
 * @param neighbours  that share entries
 * @param shared      lists of entries
 * @param num_entries of this rank, shared or not
 * @param num_columns must be the same on every rank
 * @param columns     `to` has the entries, `from` is not used; RRCB_BYTE is not allowed */
RRCB_API int rrcb_neighbours_sum(rrcb_neighbours* neighbours, const rrcb_shared_entries* shared,
                                 size_t num_entries, size_t num_columns,
                                 const rrcb_column* columns);

/** Gives access to the lists of the ghosts; `receive` and `shifts` are valid after a fetch. Not
 * collective.
 *
 * @param neighbours own the lists, until the next call
 * @param plan       gets a view of them */
RRCB_API int rrcb_neighbours_ghost_plan(const rrcb_neighbours* neighbours, rrcb_ghost_plan* plan);

/** Moves fetched positions to those of the images, as rrcb_ghosts_apply_shifts. Not collective.
 *
 * @param neighbours from which the positions were fetched
 * @param positions  one for each ghost; the arrays are changed */
RRCB_API int rrcb_neighbours_apply_shifts(const rrcb_neighbours* neighbours,
                                          const rrcb_points* positions);

/** Gives access to the ranks of the neighbours. Not collective.
 *
 * @param neighbours own the ranks
 * @param count      gets their number
 * @param ranks      gets their address; they ascend */
RRCB_API int rrcb_neighbours_ranks(const rrcb_neighbours* neighbours, size_t* count,
                                   const int** ranks);

#ifdef __cplusplus
}
#endif

#endif
