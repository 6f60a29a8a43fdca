#ifndef RRCB_C_GROUPS_H
#define RRCB_C_GROUPS_H

#include <rrcb/c/balancer.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Key of a point that is a group of its own. */
#define RRCB_NO_GROUP UINT64_MAX

/** Points that go to one part together, as one point each; as rrcb::Groups. */
typedef struct rrcb_groups rrcb_groups;

/** Position of a group, as rrcb::GroupPlace. */
typedef enum rrcb_group_place {
    RRCB_CENTRE = 0,     /**< of weight */
    RRCB_FIRST_POINT = 1 /**< of the lowest rank that has one */
} rrcb_group_place;

/** Finds the groups of all points with equal keys, as rrcb::groups. They belong to the caller.
 *
 *  Collective over the communicator of the balancer, whose cuts are not used. `keys` has an entry
 *  for each point, `place` is an rrcb_group_place. If it fails, `*groups` is left unchanged. */
RRCB_API int rrcb_groups_create(const rrcb_balancer* balancer, const rrcb_points* points,
                                const uint64_t* keys, int place, rrcb_groups** groups);

/** Frees groups, which may be null, and their points. Not collective. */
RRCB_API void rrcb_groups_destroy(rrcb_groups* groups);

/** Shows the groups of this rank as points, for rrcb_balance; they belong to the groups. Not
 *  collective. */
RRCB_API int rrcb_groups_points(const rrcb_groups* groups, rrcb_points* points);

/** Fetches columns with the values of the groups of points, such as parts, as rrcb::fetch.
 *
 *  Collective. A column has an entry for each group of this rank, its result for each of its
 *  points. `limits` may be null, for the default, and so may `report`. */
RRCB_API int rrcb_groups_fetch(const rrcb_groups* groups, size_t num_columns,
                               const rrcb_column* columns, const rrcb_transfer_limits* limits,
                               rrcb_transfer_report* report);

/** Writes the sums of values over the points of each group of this rank, as rrcb::sums.
 *
 *  Collective. `values` has `components` for each point of this rank, `sums` for each group. */
RRCB_API int rrcb_groups_sums(const rrcb_groups* groups, size_t components, const double* values,
                              double* sums);

#ifdef __cplusplus
}
#endif

#endif
