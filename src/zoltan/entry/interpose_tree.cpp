#include "zoltan/entry/optional_call.hpp"
#include "zoltan/handle/lookups.hpp"

using namespace rrcb::zoltan;

RRCB_DECLARE_REAL(Zoltan_RCB_Partition_Tree)

RRCB_EXPORT int Zoltan_RCB_Partition_Tree(Zoltan_Struct* zz, int node, int* parent, int* left_leaf,
                                          int* right_leaf) {
    return guarded("Zoltan_RCB_Partition_Tree", find_state(zz), [&] {
        const State* state = look_up_state(zz);
        if (state == nullptr) {
            auto* const real = RRCB_REAL(Zoltan_RCB_Partition_Tree, rcb_partition_tree);
            return real(zz, node, parent, left_leaf, right_leaf);
        }
        const TreeNode found = tree_node_of(*state, node);
        *parent = found.parent, *left_leaf = found.lower, *right_leaf = found.upper;
        return ZOLTAN_OK;
    });
}
