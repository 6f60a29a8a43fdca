#ifndef RRCB_ZOLTAN_RENAME_H
#define RRCB_ZOLTAN_RENAME_H

/** For programs that hold Zoltan as a static archive, which no shared library can stand before:
 *  gives the calls that RRCB answers the names of the entry points in librrcb_zoltan_static.a.
 * Those forward to the archive what is not RRCB's.
 *
 *  Include it before zoltan_cpp.h in every file that calls Zoltan, or leave the files as they are
 *  and compile them with -include rrcb/zoltan/rrcb_zoltan_rename.h. RRCB_Zoltan_Active() gives 1 in
 *  the files that have it, 0 in others. */

#include <rrcb/zoltan/rrcb_zoltan.h>

#include <zoltan.h>
#include <zoltan_partition_tree.h>

#ifdef __cplusplus
extern "C" {
#endif

int RRCB_Zoltan_Renamed_Active(void);

extern __typeof__(Zoltan_Create) RRCB_Zoltan_Create;
extern __typeof__(Zoltan_Copy) RRCB_Zoltan_Copy;
extern __typeof__(Zoltan_Copy_To) RRCB_Zoltan_Copy_To;
extern __typeof__(Zoltan_Destroy) RRCB_Zoltan_Destroy;
extern __typeof__(Zoltan_Set_Param) RRCB_Zoltan_Set_Param;
extern __typeof__(Zoltan_Set_Param_Vec) RRCB_Zoltan_Set_Param_Vec;
extern __typeof__(Zoltan_LB_Partition) RRCB_Zoltan_LB_Partition;
extern __typeof__(Zoltan_LB_Balance) RRCB_Zoltan_LB_Balance;
extern __typeof__(Zoltan_LB_Set_Part_Sizes) RRCB_Zoltan_LB_Set_Part_Sizes;
extern __typeof__(Zoltan_LB_Point_PP_Assign) RRCB_Zoltan_LB_Point_PP_Assign;
extern __typeof__(Zoltan_LB_Point_Assign) RRCB_Zoltan_LB_Point_Assign;
extern __typeof__(Zoltan_LB_Box_PP_Assign) RRCB_Zoltan_LB_Box_PP_Assign;
extern __typeof__(Zoltan_LB_Box_Assign) RRCB_Zoltan_LB_Box_Assign;
extern __typeof__(Zoltan_RCB_Partition_Tree) RRCB_Zoltan_RCB_Partition_Tree;
extern __typeof__(Zoltan_Serialize_Size) RRCB_Zoltan_Serialize_Size;
extern __typeof__(Zoltan_Serialize) RRCB_Zoltan_Serialize;
extern __typeof__(Zoltan_Deserialize) RRCB_Zoltan_Deserialize;

#ifdef __cplusplus
}
#endif

#define RRCB_Zoltan_Active RRCB_Zoltan_Renamed_Active
#define Zoltan_Create RRCB_Zoltan_Create
#define Zoltan_Copy RRCB_Zoltan_Copy
#define Zoltan_Copy_To RRCB_Zoltan_Copy_To
#define Zoltan_Destroy RRCB_Zoltan_Destroy
#define Zoltan_Set_Param RRCB_Zoltan_Set_Param
#define Zoltan_Set_Param_Vec RRCB_Zoltan_Set_Param_Vec
#define Zoltan_LB_Partition RRCB_Zoltan_LB_Partition
#define Zoltan_LB_Balance RRCB_Zoltan_LB_Balance
#define Zoltan_LB_Set_Part_Sizes RRCB_Zoltan_LB_Set_Part_Sizes
#define Zoltan_LB_Point_PP_Assign RRCB_Zoltan_LB_Point_PP_Assign
#define Zoltan_LB_Point_Assign RRCB_Zoltan_LB_Point_Assign
#define Zoltan_LB_Box_PP_Assign RRCB_Zoltan_LB_Box_PP_Assign
#define Zoltan_LB_Box_Assign RRCB_Zoltan_LB_Box_Assign
#define Zoltan_RCB_Box RRCB_Zoltan_RCB_Box
#define Zoltan_RCB_Partition_Tree RRCB_Zoltan_RCB_Partition_Tree
#define Zoltan_Serialize_Size RRCB_Zoltan_Serialize_Size
#define Zoltan_Serialize RRCB_Zoltan_Serialize
#define Zoltan_Deserialize RRCB_Zoltan_Deserialize
#define Zoltan_Register_Fort_Malloc RRCB_Zoltan_Register_Fort_Malloc

#endif
