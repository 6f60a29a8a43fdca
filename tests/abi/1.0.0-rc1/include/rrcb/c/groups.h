#ifndef RRCB_C_GROUPS_H
#define RRCB_C_GROUPS_H

#include <rrcb/c/balancer.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Key of a point that is a group of its own. */
#define RRCB_NO_GROUP UINT64_MAX

/** Groups of points, each of which goes to one part as a single point; as rrcb::Groups. */
typedef struct rrcb_groups rrcb_groups;

/** Position of a group, as rrcb::GroupPlace. */
typedef enum rrcb_group_place {
    RRCB_CENTRE = 0,     /**< centre of weight */
    RRCB_FIRST_POINT = 1 /**< position of the first point on the lowest rank */
} rrcb_group_place;

/** Finds the groups of all points with equal keys, as rrcb::groups. Collective.
 *
 * @param balancer whose communicator is used; its cuts are not
 * @param points   of this rank
 * @param keys     one for each point; RRCB_NO_GROUP for a point that is in no group
 * @param place    an rrcb_group_place, the same on every rank
 * @param groups   as for rrcb_balancer_create */
RRCB_API int rrcb_groups_create(const rrcb_balancer* balancer, const rrcb_points* points,
                                const uint64_t* keys, int place, rrcb_groups** groups);

/** Frees groups and their points. Not collective.
 *
 * @param groups as for rrcb_balancer_destroy */
RRCB_API void rrcb_groups_destroy(rrcb_groups** groups);

/** Gives access to the groups of this rank as points, for rrcb_balance. Not collective.
 *
 * @param groups own the points
 * @param points get a view of them */
RRCB_API int rrcb_groups_points(const rrcb_groups* groups, rrcb_points* points);

/** Fetches for each point the values of its group, for example its part, as rrcb::fetch.
 * Collective.
 *
 * @param groups      of these points
 * @param num_columns must be the same on every rank
 * @param columns     `from` has an entry for each group of this rank, `to` has room for each
 * point
 * @param options     null: the default */
RRCB_API int rrcb_groups_to_points(const rrcb_groups* groups, size_t num_columns,
                                   const rrcb_column* columns,
                                   const rrcb_transfer_options* options);

/** Writes the sums of values over the points of each group of this rank, as rrcb::sums.
 * Collective.
 *
 * @param groups     of these points
 * @param components number of values of each point
 * @param values     `components` for each point of this rank
 * @param sums       gets `components` for each group of this rank */
RRCB_API int rrcb_groups_sums(const rrcb_groups* groups, size_t components, const double* values,
                              double* sums);

#ifdef __cplusplus
}
#endif

#endif
