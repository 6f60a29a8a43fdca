#pragma once

#include <algorithm>
#include <cstdint>

namespace rrcb {

/// Tree along which contributions are sent to rank 0. Each rank first joins its children's
/// contributions to its own.
///
/// A rank that is a multiple of radix^k receives from k levels of subtrees: for each power s = 1,
/// radix, ... radix^(k-1), those of s ranks each that begin at distances s, 2 s, ... (radix - 1) s.
struct MergeTree {
    int num_ranks = 1;
    int radix = 8;

    /// Calls visit(child) for the children of a rank, in ascending order; contributions are
    /// received in this order.
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
