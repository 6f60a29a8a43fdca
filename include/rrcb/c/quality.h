#ifndef RRCB_C_QUALITY_H
#define RRCB_C_QUALITY_H

#include <rrcb/c/balancer.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Writes heaviest part / mean part, as rrcb::imbalance; `part_sizes` has an entry for each part,
 *  or is null for equal parts. Not collective. */
RRCB_API int rrcb_imbalance(size_t num_parts, const double* part_weights, const double* part_sizes,
                            double* imbalance);

/** Writes the load unbalance of each part in percent, as rrcb::load_unbalance_percent. Not
 *  collective. */
RRCB_API int rrcb_load_unbalance_percent(size_t num_parts, const double* part_weights,
                                         const double* part_sizes, double* percent);

/** Writes the largest absolute value of rrcb_load_unbalance_percent. Not collective. */
RRCB_API int rrcb_worst_load_unbalance_percent(size_t num_parts, const double* part_weights,
                                               const double* part_sizes, double* percent);

/** Writes the weight of each part of the cuts over all ranks, as rrcb::part_weights. Collective.
 *
 *  `parts` has an entry for each point, `part_weights` num_parts, one for each part. */
RRCB_API int rrcb_part_weights(const rrcb_balancer* balancer, const rrcb_points* points,
                               const int32_t* parts, size_t num_parts, double* part_weights);

/** Writes the share of the weight whose rank is not among those of its new part, as
 *  rrcb::moved_fraction. Collective. */
RRCB_API int rrcb_moved_fraction(const rrcb_balancer* balancer, const rrcb_points* points,
                                 const int32_t* parts, double* fraction);

#ifdef __cplusplus
}
#endif

#endif
