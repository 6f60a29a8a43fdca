#ifndef RRCB_ZOLTAN_OPTIONAL_FUNCTIONS_H
#define RRCB_ZOLTAN_OPTIONAL_FUNCTIONS_H

/** @file
 * Functions that not every Zoltan has, nor its headers declare: a Zoltan built by its own configure
 * has no Zoltan_RCB_Partition_Tree, one before 3.9 no Zoltan_Serialize. RRCB answers all of them
 * for handles with LB_METHOD=RRCB. Other handles get ZOLTAN_FATAL, or the size 0, with a message.
 */

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

struct Zoltan_Struct;

/** Returns a node of the tree of cuts, as in Zoltan's zoltan_partition_tree.h. Not collective.
 *
 * @param zz         partitioned with KEEP_CUTS
 * @param node       its number there
 * @param parent     gets that of its parent
 * @param left_leaf  gets the node below the cut
 * @param right_leaf gets the node above the cut */
int Zoltan_RCB_Partition_Tree(struct Zoltan_Struct* zz, int node, int* parent, int* left_leaf,
                              int* right_leaf);
/** Returns the bytes that Zoltan_Serialize needs; 0 if Zoltan lacks it. */
size_t Zoltan_Serialize_Size(struct Zoltan_Struct const* zz);
/** Writes a handle into a buffer. Not collective.
 *
 * @param zz     the handle
 * @param size   from Zoltan_Serialize_Size
 * @param buffer of `size` bytes */
int Zoltan_Serialize(struct Zoltan_Struct const* zz, size_t size, char* buffer);
/** Fills a handle from a buffer that Zoltan_Serialize wrote. Not collective.
 *
 * @param zz     the handle, from Zoltan_Create
 * @param size   of the buffer
 * @param buffer of `size` bytes */
int Zoltan_Deserialize(struct Zoltan_Struct* zz, size_t size, char* buffer);

#ifdef __cplusplus
}
#endif

#endif
