#pragma once

namespace rrcb {

/// Shape of a tree of cuts: the parts that lie below each of them.
///
/// A node of several groups halves the number of groups, a node within one group the number of its
/// parts. The parts of a group are therefore all parts of one node. The default halves the number
/// of parts at every node.
struct TreeShape {
    int group_size = 1;  ///< consecutive parts in a group, such as those of one machine, >= 1;
                         ///< the last group may have fewer
    bool larger_below = false;  ///< side of the larger half if the number is odd

    /// Returns the number of a node's parts below its cut; `num_parts` >= 2. Not collective.
    constexpr int lower_parts(int num_parts) const {
        if (group_size <= 1 || num_parts <= group_size) return lower_half(num_parts);
        return lower_half((num_parts - 1) / group_size + 1) * group_size;
    }

    /// Returns true if both give every node the same parts. Not collective.
    friend constexpr bool operator==(const TreeShape& a, const TreeShape& b) {
        return a.group_size == b.group_size && a.larger_below == b.larger_below;
    }

  private:
    constexpr int lower_half(int number) const {
        return number / 2 + (larger_below ? number % 2 : 0);
    }
};

}  // namespace rrcb
