#ifndef RRCB_C_POINTS_H
#define RRCB_C_POINTS_H

#include <rrcb/export.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Structs that may get more members in later versions begin with their size in bytes. Initialise
 * each by the macro with its name, for example rrcb_points by RRCB_POINTS_INIT: the library
 * reads and writes no byte beyond this size. New members come at the end; 0 means that they are
 * not given. A struct without a size never changes. */

/** Type of a value; 0 stands for no type. */
typedef enum rrcb_type {
    RRCB_INT32 = 1,  /**< int32_t */
    RRCB_INT64 = 2,  /**< int64_t */
    RRCB_FLOAT = 3,  /**< float */
    RRCB_DOUBLE = 4, /**< double */
    RRCB_BYTE = 5    /**< byte of any other type; such values can be moved, but not added */
} rrcb_type;

/** Borrowed view of one rank's points, as rrcb::Points.
 *
 *  Coordinate a of point i is at axes[a] + i * stride bytes. */
typedef struct rrcb_points {
    size_t size;           /**< of this struct, set by RRCB_POINTS_INIT */
    int dimension;         /**< 1 to 3, the same on every rank */
    int32_t type;          /**< of the coordinates, RRCB_DOUBLE or RRCB_FLOAT */
    size_t count;          /**< points of this rank */
    size_t stride;         /**< distance from a point to the next, in bytes */
    const void* axes[3];   /**< addresses of the first point's coordinates */
    const double* weights; /**< one per point; null on all ranks with points: all weigh 1 */
} rrcb_points;

/** A view of dimension 0 without points. */
#define RRCB_POINTS_INIT \
    { sizeof(rrcb_points), 0, 0, 0, 0, {NULL, NULL, NULL}, NULL }

/** Returns a view of points stored one after another. Not collective.
 *
 * @param type        RRCB_DOUBLE or RRCB_FLOAT
 * @param dimension   1 to 3
 * @param count       points of this rank
 * @param coordinates dimension * count
 * @param weights     one for each point; null: all weigh 1 */
static inline rrcb_points rrcb_interleaved_points(rrcb_type type, int dimension, size_t count,
                                                  const void* coordinates, const double* weights) {
    const size_t bytes = type == RRCB_FLOAT ? sizeof(float) : sizeof(double);
    rrcb_points points = RRCB_POINTS_INIT;
    points.dimension = dimension;
    points.type = (int32_t)type;
    points.count = count;
    points.stride = dimension > 0 ? (size_t)dimension * bytes : 0;
    points.weights = weights;
    for (size_t axis = 0; axis < 3 && (int)axis < dimension && coordinates != NULL; ++axis)
        points.axes[axis] = (const char*)coordinates + axis * bytes;
    return points;
}

/** Returns a view of one array per axis. Not collective.
 *
 * @param type      RRCB_DOUBLE or RRCB_FLOAT
 * @param dimension 1 to 3
 * @param count     points of this rank
 * @param columns   `dimension` arrays of length `count`
 * @param weights   one for each point; null: all weigh 1 */
static inline rrcb_points rrcb_column_points(rrcb_type type, int dimension, size_t count,
                                             const void* const* columns, const double* weights) {
    rrcb_points points = rrcb_interleaved_points(type, 1, count, NULL, weights);
    points.dimension = dimension;
    for (int axis = 0; axis < 3 && axis < dimension && columns != NULL; ++axis)
        points.axes[axis] = columns[axis];
    return points;
}

/** Writes the smallest box that holds all points, as rrcb::bounding_box. Not collective.
 *
 * @param points of this rank
 * @param lower  gets the lower end, of length 3
 * @param upper  gets the upper end, of length 3 */
RRCB_API int rrcb_bounding_box(const rrcb_points* points, double* lower, double* upper);

#ifdef __cplusplus
}
#endif

#endif
