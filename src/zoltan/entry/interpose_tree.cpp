#include "zoltan/entry/look_up.hpp"
#include "zoltan/entry/optional_call.hpp"

using namespace rrcb::zoltan;

RRCB_DECLARE_REAL(Zoltan_RCB_Partition_Tree)

RRCB_EXPORT int Zoltan_RCB_Partition_Tree(Zoltan_Struct* zz, int node, int* parent, int* left_leaf,
                                          int* right_leaf) {
    const State* state = look_up_state(zz);
    if (state == nullptr) {
        return guarded("Zoltan_RCB_Partition_Tree", find_state(zz), [&] {
            auto* const real = RRCB_REAL(Zoltan_RCB_Partition_Tree, rcb_partition_tree);
            return real(zz, node, parent, left_leaf, right_leaf);
        });
    }
    return look_up("Zoltan_RCB_Partition_Tree", *state, [&](const LastPartition& last) {
        if (node < 0 || node >= last.cuts().num_parts)
            throw_fatal("Invalid tree node " + std::to_string(node));
        const TreeNode found = last.tree_node(node);
        *parent = found.parent, *left_leaf = found.lower, *right_leaf = found.upper;
    });
}
