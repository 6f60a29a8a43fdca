#pragma once

#include <algorithm>
#include <cstdint>

namespace rrcb {

/// Tree along which contributions are sent to rank 0. Each rank first adds those of its children.
///
/// A rank that is a multiple of radix^k receives, for each smaller power s of the radix, the
/// subtrees of s ranks each that begin s, 2 s, ... (radix - 1) s after it.
struct MergeTree {
    int num_ranks = 1;
    int radix = 8;

    /// Calls `visit(child)` for the children of a rank, in the order in which it receives them: by
    /// rank.
    template <class Visit>
    void for_each_child(int rank, Visit&& visit) const {
        for (std::int64_t stride = 1; stride < num_ranks && rank % (stride * radix) == 0;
             stride *= radix)
            for (std::int64_t child = rank + stride;
                 child < std::min<std::int64_t>(num_ranks, rank + stride * radix); child += stride)
                visit(static_cast<int>(child));
    }

    /// Returns the rank that receives the contribution of `rank` (> 0).
    int parent(int rank) const {
        std::int64_t stride = radix;
        while (rank % stride == 0) stride *= radix;
        return static_cast<int>(rank - rank % stride);
    }
};

}  // namespace rrcb
