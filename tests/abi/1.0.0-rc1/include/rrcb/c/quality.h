#ifndef RRCB_C_QUALITY_H
#define RRCB_C_QUALITY_H

#include <rrcb/c/balancer.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Writes the weight of the heaviest part divided by the mean, as rrcb::imbalance. Not
 * collective.
 *
 * @param num_parts    length of the arrays
 * @param part_weights weight of each part
 * @param part_sizes   relative, one for each part; null: equal parts
 * @param imbalance    gets the ratio */
RRCB_API int rrcb_imbalance(size_t num_parts, const double* part_weights, const double* part_sizes,
                            double* imbalance);

/** Writes sizes of the parts that make their loads more even, as rrcb::balanced_sizes. Not
 * collective.
 *
 * @param num_parts  length of the arrays
 * @param loads      of each part in the last step, in any unit
 * @param part_sizes of the last call; null: equal parts
 * @param sizes      gets one for each part; may be `part_sizes` */
RRCB_API int rrcb_balanced_sizes(size_t num_parts, const double* loads, const double* part_sizes,
                                 double* sizes);

/** Writes the weight of each part of the cuts over all ranks, as rrcb::part_weights. Collective.
 *
 * @param balancer     with cuts
 * @param points       of this rank
 * @param parts        the part of each point
 * @param num_parts    that of the cuts, length of `part_weights`
 * @param part_weights gets one for each part */
RRCB_API int rrcb_part_weights(const rrcb_balancer* balancer, const rrcb_points* points,
                               const int32_t* parts, size_t num_parts, double* part_weights);

/** Writes which share of the weight has to move, because its rank does not hold its new part; as
 * rrcb::moved_fraction. Collective.
 *
 * @param balancer with cuts
 * @param points   of this rank
 * @param parts    the new part of each point
 * @param fraction gets the share, from 0 to 1 */
RRCB_API int rrcb_moved_fraction(const rrcb_balancer* balancer, const rrcb_points* points,
                                 const int32_t* parts, double* fraction);

#ifdef __cplusplus
}
#endif

#endif
