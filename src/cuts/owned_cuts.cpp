#include "cuts/owned_cuts.hpp"

#include "arithmetic/least_number.hpp"

#include <algorithm>

namespace rrcb {

namespace {

/// Returns the first part whose first rank is `rank` or higher.
Part first_part_from(int rank, int num_parts, int num_ranks) {
    return least_number(0, num_parts - 1, [&](Part part) {
        return ranks_of_part(part, num_parts, num_ranks).first_rank >= rank;
    });
}

}  // namespace

PartRange parts_on(int rank, int num_parts, int num_ranks) {
    const auto [first, end] = parts_from(rank, num_parts, num_ranks);
    return {std::min(first, end - 1), end};
}

PartRange parts_from(int rank, int num_parts, int num_ranks) {
    return {first_part_from(rank, num_parts, num_ranks),
            first_part_from(rank + 1, num_parts, num_ranks)};
}

PartRange parts_from(int rank, std::span<const RankRange> ranks_of_parts) {
    // std::ranges::equal_range would do, but clang 14 cannot compile it with GCC's library.
    const auto first = std::ranges::lower_bound(ranks_of_parts, rank, {}, &RankRange::first_rank);
    const auto end = std::ranges::upper_bound(ranks_of_parts, rank, {}, &RankRange::first_rank);
    return {static_cast<Part>(first - ranks_of_parts.begin()),
            static_cast<Part>(end - ranks_of_parts.begin())};
}

}  // namespace rrcb
