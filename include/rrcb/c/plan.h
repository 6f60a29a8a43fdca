#ifndef RRCB_C_PLAN_H
#define RRCB_C_PLAN_H

#include <rrcb/c/points.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Consecutive ranks that hold a part, as rrcb::RankRange. Never changes, as arrays contain it. */
typedef struct rrcb_rank_range {
    int first_rank; /**< the lowest of them */
    int count;      /**< of ranks */
} rrcb_rank_range;

/** Number of points to or from one rank, as rrcb::RankCount. Never changes, as arrays contain it.
 */
typedef struct rrcb_rank_count {
    int rank;     /**< of the communicator */
    size_t count; /**< of points */
} rrcb_rank_count;

/** Lists of the points whose rank changes, as rrcb::Plan; indices count from 0. */
typedef struct rrcb_plan_lists {
    size_t size;                  /**< of this struct, set by RRCB_PLAN_LISTS_INIT */
    size_t num_points;            /**< that this rank holds before */
    size_t num_points_after;      /**< that it holds then */
    size_t num_exports;           /**< length of the lists of exports */
    const size_t* export_indices; /**< of my points that leave, ascending */
    const int* export_ranks;      /**< their destinations */
    const int32_t* export_parts;  /**< their new parts */
    size_t num_imports;           /**< length of the lists of imports */
    const int* import_ranks;      /**< sources of my new points, ascending */
    const size_t* import_indices; /**< their index there, ascending per rank */
    const int32_t* import_parts;  /**< their new parts */
} rrcb_plan_lists;

/** Lists without points. */
#define RRCB_PLAN_LISTS_INIT \
    { sizeof(rrcb_plan_lists), 0, 0, 0, NULL, NULL, NULL, 0, NULL, NULL, NULL }

/** A column of the points, and room for its result. The type and the components are the
 *  same on every rank. */
typedef struct rrcb_column {
    size_t size;       /**< of this struct, set by RRCB_COLUMN_INIT; of all in an array the same */
    int32_t type;      /**< of the values, an rrcb_type */
    size_t components; /**< values of a point; its bytes for RRCB_BYTE */
    const void* from;  /**< the column; null without values */
    void* to;          /**< room for the result; null without values */
} rrcb_column;

/** A column with these members. */
#define RRCB_COLUMN_INIT(type, components, from, to) \
    { sizeof(rrcb_column), (int32_t)(type), components, from, to }

/** Bounds of a call that sends columns, as rrcb::TransferLimits. */
typedef struct rrcb_transfer_limits {
    size_t size;  /**< of this struct, set by RRCB_TRANSFER_LIMITS_INIT */
    size_t bytes; /**< most memory for messages on each rank, the same on every rank */
} rrcb_transfer_limits;

/** The default limits: 64 MiB. */
#define RRCB_TRANSFER_LIMITS_INIT \
    { sizeof(rrcb_transfer_limits), (size_t)64 << 20 }

/** Memory and messages of a call on this rank, as rrcb::TransferReport. */
typedef struct rrcb_transfer_report {
    size_t size;         /**< of this struct, set by RRCB_TRANSFER_REPORT_INIT */
    size_t peak_bytes;   /**< most memory in use for messages at a time */
    size_t bytes_sent;   /**< of columns */
    size_t num_messages; /**< sent */
} rrcb_transfer_report;

/** A report without messages. */
#define RRCB_TRANSFER_REPORT_INIT \
    { sizeof(rrcb_transfer_report), 0, 0, 0 }

/** Points that stay under the old and new numbers of parts, over all ranks; as rrcb::Remap. */
typedef struct rrcb_remap_report {
    size_t size;         /**< of this struct, set by RRCB_REMAP_REPORT_INIT */
    int identity;        /**< 1: no number changes */
    int64_t num_points;  /**< over all ranks */
    int64_t kept_before; /**< of the points, those that stay when no number changes */
    int64_t kept_after;  /**< those that stay under the new numbers */
} rrcb_remap_report;

/** No points. */
#define RRCB_REMAP_REPORT_INIT \
    { sizeof(rrcb_remap_report), 0, 0, 0, 0 }

/** Writes the ranks of a part, as rrcb::ranks_of_part. Not collective.
 *
 * @param part      0 ... num_parts - 1
 * @param num_parts 1 or more
 * @param num_ranks 1 or more
 * @param ranks     gets the consecutive ranks */
RRCB_API int rrcb_ranks_of_part(int32_t part, int num_parts, int num_ranks, rrcb_rank_range* ranks);

#ifdef __cplusplus
}
#endif

#endif
