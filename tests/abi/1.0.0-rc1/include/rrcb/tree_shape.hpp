#pragma once

namespace rrcb {

/// Shape of a tree of cuts: the number of parts on each side of each cut.
///
/// The tree first divides groups of parts, then the parts of each group. A group may be the parts
/// of one machine; by default it is a single part. The cut of a node above several groups halves
/// the number of groups; within a group it halves the number of parts.
///
/// The ends of the tree are numbered from the lowest: first the ends of the first group, then those
/// of the second, and so on. End k has part k, unless parts are dealt.
struct TreeShape {
    int group_size = 1;         ///< number of parts in a group, >= 1; the last group may have
                                ///< fewer; in Options also 0: the parts of each machine
    bool larger_below = false;  ///< whether the larger half of an odd number is below the cut
    int round_robin_block = 0;  ///< number of consecutive parts dealt to a group before the next
                                ///< group gets its turn; 0: all parts of a group are consecutive

    /// Returns how many of a node's parts are below its cut; `num_parts` must be at least 2. Not
    /// collective.
    constexpr int lower_parts(int num_parts) const {
        if (group_size <= 1 || num_parts <= group_size) return lower_half(num_parts);
        return lower_half(num_groups(num_parts)) * group_size;
    }

    /// Returns the part at an end of a tree of `num_parts` parts. number_fits() must be true for
    /// `num_parts`. Not collective.
    constexpr int part_at(int end, int num_parts) const {
        if (round_robin_block == 0) return end;
        const int turn =
            end % group_size / round_robin_block * num_groups(num_parts) + end / group_size;
        return turn * round_robin_block + end % round_robin_block;
    }

    /// Returns the end of the tree that has a part. This is the reverse of part_at(). Not
    /// collective.
    constexpr int end_of(int part, int num_parts) const {
        if (round_robin_block == 0) return part;
        const int turn = part / round_robin_block;
        const int groups = num_groups(num_parts);
        return turn % groups * group_size + turn / groups * round_robin_block +
               part % round_robin_block;
    }

    /// Returns true if this number of parts can be dealt to the groups: all groups get the same
    /// number, or the last group gets one turn less. Not collective.
    constexpr bool number_fits(int num_parts) const {
        if (round_robin_block == 0) return true;
        return round_robin_block > 0 && group_size % round_robin_block == 0 &&
               num_parts % round_robin_block == 0 &&
               (num_parts % group_size == 0 ||
                num_parts % group_size == group_size - round_robin_block);
    }

    /// Returns true if both shapes give every node the same numbers of parts. Not collective.
    friend constexpr bool operator==(const TreeShape& a, const TreeShape& b) {
        return a.group_size == b.group_size && a.larger_below == b.larger_below &&
               a.round_robin_block == b.round_robin_block;
    }

  private:
    constexpr int num_groups(int num_parts) const { return (num_parts - 1) / group_size + 1; }

    constexpr int lower_half(int number) const {
        return number / 2 + (larger_below ? number % 2 : 0);
    }
};

}  // namespace rrcb
