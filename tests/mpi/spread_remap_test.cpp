// Part numbers by all ranks together, beside those that one rank finds.
#include "../support/same_error.hpp"
#include "collective/duplicate.hpp"
#include "lists/remap_mpi.hpp"
#include "part_ranks.hpp"

#include <rrcb/error.hpp>
#include <rrcb/remap.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

namespace rrcb {
namespace {

using test::num_ranks;
using test::rank;
using test::ranks_of_parts;

/// Lets all ranks search, or rank 0 alone.
Remap found(bool together, std::span<const Part> parts, const PreviousParts& previous,
            int num_parts) {
    Participant self{mpi::enter(MPI_COMM_WORLD, CallName::none).comm};
    const auto ranks = ranks_of_parts(num_parts);
    return remap(parts, previous, ranks, {}, self, together ? 0 : num_parts);
}

void expect_same(const Remap& a, const Remap& b) {
    EXPECT_EQ(a.numbers, b.numbers);
    EXPECT_EQ(a.identity, b.identity);
    EXPECT_EQ(a.num_points, b.num_points);
    EXPECT_EQ(a.kept_before, b.kept_before);
    EXPECT_EQ(a.kept_after, b.kept_after);
}

/// Points of parts of another rank mostly, and of any.
std::vector<Part> dealt(int num_parts, unsigned seed) {
    std::mt19937_64 engine(100 * seed + static_cast<unsigned>(rank()));
    const auto draw = [&](int end) {
        return static_cast<int>(engine() % static_cast<unsigned>(end));
    };
    const int share = num_parts / num_ranks();
    const int shift = static_cast<int>(seed % 3) * share;
    std::vector<Part> parts(test::is_last_rank() ? 0 : 40 + engine() % 4000);
    for (Part& part : parts)
        part = draw(4) == 0 ? draw(num_parts) : (rank() * share + shift + draw(share)) % num_parts;
    return parts;
}

TEST(SpreadRemap, by_ranks_and_by_parts_finds_what_one_rank_does) {
    for (unsigned seed = 0; seed < 24; ++seed) {
        const int num_parts = num_ranks() + static_cast<int>(37 * (seed % 5));
        const std::vector<Part> parts = dealt(num_parts, seed);
        std::vector<Part> previous = dealt(num_parts + 3, seed + 1);
        previous.resize(parts.size());
        // The last rank has no points, and need not have previous parts.
        const PreviousParts some =
            parts.empty() && seed % 2 == 0 ? PreviousParts() : PreviousParts(previous);
        for (const PreviousParts& origins : {PreviousParts(), some})
            expect_same(found(true, parts, origins, num_parts),
                        found(false, parts, origins, num_parts));
    }
}

TEST(SpreadRemap, leaves_numbers_that_nobody_gains_by) {
    for (const int num_parts : {129, 200}) {
        std::vector<Part> parts;
        for (Part part = 0; part < num_parts; ++part)
            if (ranks_of_parts(num_parts)[static_cast<std::size_t>(part)].first_rank == rank())
                parts.insert(parts.end(), 3, part);
        const Remap result = found(true, parts, {}, num_parts);
        EXPECT_TRUE(result.identity);
        EXPECT_EQ(result.num_points, 3 * num_parts);
        EXPECT_EQ(result.kept_before, 3 * num_parts);
        EXPECT_EQ(result.kept_after, 3 * num_parts);
        EXPECT_TRUE(std::ranges::is_sorted(result.numbers));
        const Remap empty = found(true, {}, {}, num_parts);
        EXPECT_TRUE(empty.identity);
        EXPECT_EQ(empty.numbers, result.numbers);
    }
}

TEST(SpreadRemap, refuses_on_all_ranks_what_one_gets_wrong) {
    const std::vector<Part> wrong(3, test::is_last_rank() ? 200 : 0);
    for (int k = 0; k < 2; ++k) {
        test::expect_same_error(
            [&] { found(true, wrong, {}, 200); },
            "rank " + std::to_string(num_ranks() - 1) + ": " +
                "part 200 of point 0 is none of the 200 parts; they count from 0");
        EXPECT_EQ(found(true, dealt(200, 1), {}, 200).numbers.size(), 200u);
    }
}

}  // namespace
}  // namespace rrcb
