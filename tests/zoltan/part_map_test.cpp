// Where Zoltan lays parts out, on one process.
#include "zoltan/handle/part_map.hpp"

#include "../support/common.hpp"
#include "zoltan/real/message.hpp"

namespace rrcb::zoltan {
namespace {

/// First rank and number of ranks of each part.
using Ranges = std::vector<std::pair<int, int>>;

Ranges ranges_of(const PartMap& map) {
    Ranges ranges;
    for (Part part = 0; part < map.num_parts; ++part)
        ranges.emplace_back(map.ranks_of(part).first_rank, map.ranks_of(part).count);
    return ranges;
}

std::string refusal(const std::vector<int>& local_parts, int num_global_parts) {
    try {
        num_parts_of(local_parts, num_global_parts);
    } catch (const ZoltanError& error) {
        return error.what();
    }
    return "";
}

TEST(PartMap, has_one_part_on_each_rank_where_there_are_as_many) {
    const PartMap map = even_part_map(3, 3);
    EXPECT_TRUE(map.one_each);
    EXPECT_EQ(ranges_of(map), (Ranges{{0, 1}, {1, 1}, {2, 1}}));
}

TEST(PartMap, gives_surplus_parts_to_the_last_ranks) {
    const PartMap map = even_part_map(5, 3);
    EXPECT_FALSE(map.one_each);
    EXPECT_EQ(ranges_of(map), (Ranges{{0, 1}, {1, 1}, {1, 1}, {2, 1}, {2, 1}}));
}

TEST(PartMap, spreads_a_part_over_ranks_where_there_are_fewer) {
    const PartMap map = even_part_map(2, 4);
    EXPECT_FALSE(map.one_each);
    EXPECT_EQ(ranges_of(map), (Ranges{{0, 2}, {2, 2}}));
}

TEST(PartMap, is_a_formula_where_many_parts_lie_evenly) {
    for (const auto& [num_parts, num_ranks] :
         {std::pair{5000, 5000}, {5000, 7}, {4999, 5000}, {4500, 12000}}) {
        const PartMap map = even_part_map(num_parts, num_ranks);
        EXPECT_TRUE(map.listed.empty());
        std::vector<int> counts(static_cast<std::size_t>(num_ranks));
        for (Part part = 0; part < num_parts; ++part)
            for (int k = 0; k < map.ranks_of(part).count; ++k)
                ++counts[static_cast<std::size_t>(map.ranks_of(part).first_rank + k)];
        for (int rank = 0; rank < num_ranks; ++rank) {
            const auto [first, end] = map.parts_on(rank);
            EXPECT_EQ(end - first, counts[static_cast<std::size_t>(rank)]);
        }
        if (num_parts < num_ranks) continue;
        const PartMap asked = local_part_map(counts, num_parts);
        EXPECT_TRUE(asked.is_even);
        EXPECT_TRUE(asked.listed.empty());
        EXPECT_EQ(ranges_of(asked), ranges_of(map));
        std::swap(counts.front(), counts.back());
        ++counts.front();
        EXPECT_FALSE(local_part_map(counts, num_parts + 1).is_even);
    }
}

TEST(PartMap, counts_the_parts_that_ranks_ask_for) {
    EXPECT_EQ(num_parts_of(std::vector{2, 0, 1}, -1), 3);
    EXPECT_EQ(num_parts_of(std::vector{2, -1, 1}, -1), 3);
    EXPECT_EQ(num_parts_of(std::vector{2, -1, 1}, 7), 7);
}

TEST(PartMap, refuses_numbers_that_do_not_add_up) {
    EXPECT_EQ(refusal({0, 0}, -1), "Zero parts requested");
    EXPECT_EQ(refusal({3, 2}, 4), "Sum of NUM_LOCAL_PARTS 5 > NUM_GLOBAL_PARTS 4");
    EXPECT_EQ(refusal({3, -1}, 2), "Sum of NUM_LOCAL_PARTS 3 > NUM_GLOBAL_PARTS 2");
    EXPECT_EQ(refusal({1, 2}, 4), "Sum of NUM_LOCAL_PARTS 3 < NUM_GLOBAL_PARTS 4");
}

TEST(PartMap, shares_what_is_left_among_the_ranks_that_ask_for_nothing) {
    EXPECT_EQ(ranges_of(local_part_map(std::vector{2, -1, -1}, 5)),
              (Ranges{{0, 1}, {0, 1}, {1, 1}, {2, 1}, {2, 1}}));
    EXPECT_EQ(ranges_of(local_part_map(std::vector{-1, 1, -1}, 2)), (Ranges{{1, 1}, {2, 1}}));
}

TEST(PartMap, leaves_ranks_without_parts_that_ask_for_none) {
    const PartMap map = local_part_map(std::vector{0, 3, 0}, 3);
    EXPECT_EQ(ranges_of(map), (Ranges{{1, 1}, {1, 1}, {1, 1}}));
    EXPECT_FALSE(map.is_even);
    EXPECT_EQ(map.parts_on(1).end, 3);
    EXPECT_EQ(first_part_of(map, 0), -1);
    EXPECT_EQ(first_part_of(map, 1), 0);
}

TEST(PartMap, knows_the_first_part_of_each_rank_of_a_part) {
    const PartMap map = even_part_map(2, 4);
    EXPECT_EQ(first_part_of(map, 1), 0);
    EXPECT_EQ(first_part_of(map, 2), 1);
    EXPECT_EQ(first_part_of(map, 3), 1);
}

TEST(PartMap, keeps_objects_on_a_rank_of_their_part_and_deals_out_the_others) {
    const PartMap map = even_part_map(2, 4);
    EXPECT_EQ(map.destination(0, 5, 1), 1);
    EXPECT_EQ(map.destination(1, 4, 1), 2);
    EXPECT_EQ(map.destination(1, 5, 1), 3);
    EXPECT_EQ(even_part_map(3, 3).destination(2, 5, 0), 2);
}

}  // namespace
}  // namespace rrcb::zoltan
