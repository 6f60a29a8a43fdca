#ifndef RRCB_C_PLAN_H
#define RRCB_C_PLAN_H

#include <rrcb/c/points.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Consecutive ranks that hold a part, as rrcb::RankRange. This struct never changes, because
 * arrays contain it. */
typedef struct rrcb_rank_range {
    int first_rank; /**< the lowest of them */
    int count;      /**< number of ranks */
} rrcb_rank_range;

/** Number of points to or from one rank, as rrcb::RankCount. Never changes, as arrays contain it.
 */
typedef struct rrcb_rank_count {
    int rank;     /**< in the communicator */
    size_t count; /**< number of points */
} rrcb_rank_count;

/** Lists of the points whose rank changes, as rrcb::Plan; indices count from 0. */
typedef struct rrcb_plan_lists {
    size_t size;                  /**< of this struct, set by RRCB_PLAN_LISTS_INIT */
    size_t num_points;            /**< points of this rank before */
    size_t num_points_after;      /**< points of this rank afterwards */
    size_t num_exports;           /**< length of the lists of exports */
    const size_t* export_indices; /**< points that leave this rank, ascending */
    const int* export_ranks;      /**< their destinations */
    const int32_t* export_parts;  /**< their new parts */
    size_t num_imports;           /**< length of the lists of imports */
    const int* import_ranks;      /**< sources of the points that arrive, ascending */
    const size_t* import_indices; /**< their indices there, ascending for each rank */
    const int32_t* import_parts;  /**< their new parts */
} rrcb_plan_lists;

/** Lists without points. */
#define RRCB_PLAN_LISTS_INIT \
    { sizeof(rrcb_plan_lists), 0, 0, 0, NULL, NULL, NULL, 0, NULL, NULL, NULL }

/** A column of the points, with memory for its result. The type and the number of components must
 * be the same on every rank. */
typedef struct rrcb_column {
    size_t size;  /**< of this struct, set by RRCB_COLUMN_INIT; the same in an array of these */
    int32_t type; /**< of the values, an rrcb_type */
    size_t components; /**< number of values of a point; for RRCB_BYTE its bytes */
    const void* from;  /**< the column; may be null if it is empty */
    void* to;          /**< memory for the result; may be null if that is empty */
} rrcb_column;

/** A column with these members. */
#define RRCB_COLUMN_INIT(type, components, from, to) \
    { sizeof(rrcb_column), (int32_t)(type), components, from, to }

/** Memory and messages of a call on this rank, as rrcb::TransferReport. */
typedef struct rrcb_transfer_report {
    size_t size;         /**< of this struct, set by RRCB_TRANSFER_REPORT_INIT */
    size_t peak_bytes;   /**< largest memory in use for messages at the same time */
    size_t bytes_sent;   /**< bytes of columns that were sent */
    size_t num_messages; /**< messages that were sent */
} rrcb_transfer_report;

/** A report without messages. */
#define RRCB_TRANSFER_REPORT_INIT \
    { sizeof(rrcb_transfer_report), 0, 0, 0 }

/** Options of a call that sends columns, as rrcb::TransferOptions. */
typedef struct rrcb_transfer_options {
    size_t size;      /**< of this struct, set by RRCB_TRANSFER_OPTIONS_INIT */
    size_t max_bytes; /**< maximum memory for messages on each rank, the same on every rank */
    rrcb_transfer_report* report; /**< gets memory and messages; null: is not wanted */
} rrcb_transfer_options;

/** The default options: 64 MiB, no report. */
#define RRCB_TRANSFER_OPTIONS_INIT \
    { sizeof(rrcb_transfer_options), (size_t)64 << 20, NULL }

/** How many points stay with the old and with the new numbers of parts, over all ranks; as
 * rrcb::Remap. */
typedef struct rrcb_remap_report {
    size_t size;         /**< of this struct, set by RRCB_REMAP_REPORT_INIT */
    int identity;        /**< 1: no number changes */
    int64_t num_points;  /**< over all ranks */
    int64_t kept_before; /**< points that stay if no number changes */
    int64_t kept_after;  /**< points that stay under the new numbers */
} rrcb_remap_report;

/** A report without points. */
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
