#ifndef RRCB_EXPERIMENTAL_JOIN_KEYS_H
#define RRCB_EXPERIMENTAL_JOIN_KEYS_H

#include <rrcb/c/groups.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Writes one key for each point of overlapping groups, as rrcb::experimental::join_keys.
 * Collective.
 *
 * @param balancer       whose communicator is used; its cuts are not
 * @param count          number of points of this rank
 * @param keys_per_point 1 or more, the same on every rank
 * @param keys           `keys_per_point` for each point; RRCB_NO_GROUP in place of missing ones
 * @param joined         gets one for each point, for rrcb_groups_create */
RRCB_API int rrcb_join_keys(const rrcb_balancer* balancer, size_t count, size_t keys_per_point,
                            const uint64_t* keys, uint64_t* joined);

#ifdef __cplusplus
}
#endif

#endif
