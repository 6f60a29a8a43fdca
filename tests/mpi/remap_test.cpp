#include "ranks.hpp"

#include <rrcb/error.hpp>
#include <rrcb/remap.hpp>

#include <gtest/gtest.h>

#include <numeric>
#include <string>

namespace rrcb {
namespace {

using test::num_ranks;
using test::rank;

std::vector<RankRange> ranks_of(int num_parts) {
    std::vector<RankRange> ranks;
    for (Part part = 0; part < num_parts; ++part) {
        ranks.push_back(ranks_of_part(part, num_parts, num_ranks()));
    }
    return ranks;
}

TEST(Remap, undoes_a_rotation_of_the_parts) {
    const int parts_now = num_ranks();
    const std::vector<Part> parts(10, (rank() + 1) % parts_now);
    const Remap result = remap(parts, ranks_of(parts_now), MPI_COMM_WORLD);
    EXPECT_EQ(result.num_points, 10 * num_ranks());
    EXPECT_EQ(result.kept_before, parts_now == 1 ? 10 : 0);
    EXPECT_EQ(result.kept_after, 10 * num_ranks());
    for (Part part = 0; part < parts_now; ++part) {
        EXPECT_EQ(result.numbers[static_cast<std::size_t>(part)],
                  (part + parts_now - 1) % parts_now);
    }
}

TEST(Remap, leaves_the_numbers_where_nothing_is_gained) {
    const int parts_now = num_ranks();
    // Everybody has one point for every part: any permutation keeps as many.
    std::vector<Part> parts(static_cast<std::size_t>(parts_now));
    std::iota(parts.begin(), parts.end(), 0);
    const Remap result = remap(parts, ranks_of(parts_now), MPI_COMM_WORLD);
    EXPECT_TRUE(result.identity);
    EXPECT_EQ(result.numbers, parts);
    EXPECT_EQ(result.kept_after, result.kept_before);
}

TEST(Remap, keeps_points_on_their_rank_in_any_part_of_it) {
    const int parts_now = 2 * num_ranks();
    // Part p goes round to the rank behind: 2 -> rank 0, 3 -> rank 0, ...
    const Part first = (2 * rank() + 2) % parts_now;
    const std::vector<Part> parts = {first, first, first + 1};
    const Remap result = remap(parts, ranks_of(parts_now), MPI_COMM_WORLD);
    EXPECT_EQ(result.kept_after, 3 * num_ranks());
    for (const Part part : parts) {
        EXPECT_EQ(result.numbers[static_cast<std::size_t>(part)] / 2, rank());
    }
}

TEST(Remap, keeps_the_numbers_of_earlier_parts) {
    const int parts_now = 2 * num_ranks();
    const std::vector<Part> previous = {2 * rank(), 2 * rank() + 1, parts_now, -1};
    const std::vector<Part> parts = {2 * rank() + 1, 2 * rank(), 0, 0};
    const Remap result = remap(parts, previous, ranks_of(parts_now), MPI_COMM_WORLD);
    EXPECT_EQ(result.kept_before, 0);
    EXPECT_EQ(result.kept_after, 2 * num_ranks());
    EXPECT_EQ(result.numbers[static_cast<std::size_t>(2 * rank())], 2 * rank() + 1);
}

TEST(Remap, takes_ranks_without_points) {
    const bool holder = rank() == 0;
    const std::vector<Part> parts(holder ? 5 : 0, num_ranks() - 1);
    const std::vector<Part> previous(parts.size(), 0);
    EXPECT_EQ(remap(parts, ranks_of(num_ranks()), MPI_COMM_WORLD).kept_after, 5);
    EXPECT_EQ(remap(parts, previous, ranks_of(num_ranks()), MPI_COMM_WORLD).kept_after, 5);
    const Remap nothing = remap({}, ranks_of(num_ranks()), MPI_COMM_WORLD);
    EXPECT_TRUE(nothing.identity);
    EXPECT_EQ(nothing.num_points, 0);
}

TEST(Remap, refuses_on_all_ranks_what_one_gets_wrong) {
    const auto expect_error = [](const std::vector<Part>& parts, const std::vector<Part>& previous,
                                 const std::string& expected) {
        try {
            remap(parts, previous, ranks_of(num_ranks()), MPI_COMM_WORLD);
            ADD_FAILURE() << "expected: " << expected;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
            EXPECT_EQ(error.what(), "rank " + std::to_string(num_ranks() - 1) + ": " + expected);
        }
    };
    const std::string number = std::to_string(num_ranks());
    const std::vector<Part> fine{0, 0, 0};
    const std::vector<Part> too_few{0, 0};
    for (const Part bad : {-1, num_ranks()}) {
        const std::vector<Part> wrong{0, bad, 0};
        expect_error(
            test::is_last_rank() ? wrong : fine, fine,
            "part " + std::to_string(bad) + " of point 1 is none of the " + number + " parts");
    }
    expect_error(fine, test::is_last_rank() ? too_few : fine,
                 "previous has 2 entries, parts has 3; give one of each per point");
}

}  // namespace
}  // namespace rrcb
