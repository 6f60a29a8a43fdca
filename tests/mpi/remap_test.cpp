#include "../support/same_error.hpp"
#include "part_ranks.hpp"

#include <rrcb/error.hpp>
#include <rrcb/remap.hpp>

namespace rrcb {
namespace {

using test::ranks_of_parts;

TEST(Remap, undoes_a_rotation_of_the_parts) {
    const int parts_now = num_ranks();
    const std::vector<Part> parts(10, (rank() + 1) % parts_now);
    const Remap result = remap(parts, ranks_of_parts(parts_now), MPI_COMM_WORLD);
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
    const Remap result = remap(parts, ranks_of_parts(parts_now), MPI_COMM_WORLD);
    EXPECT_TRUE(result.identity);
    EXPECT_EQ(result.numbers, parts);
    EXPECT_EQ(result.kept_after, result.kept_before);
}

TEST(Remap, keeps_points_on_their_rank_in_any_part_of_it) {
    const int parts_now = 2 * num_ranks();
    // Part p goes round to the rank behind: 2 -> rank 0, 3 -> rank 0, ...
    const Part first = (2 * rank() + 2) % parts_now;
    const std::vector<Part> parts = {first, first, first + 1};
    const Remap result = remap(parts, ranks_of_parts(parts_now), MPI_COMM_WORLD);
    EXPECT_EQ(result.kept_after, 3 * num_ranks());
    for (const Part part : parts) {
        EXPECT_EQ(result.numbers[static_cast<std::size_t>(part)] / 2, rank());
    }
}

TEST(Remap, keeps_the_numbers_of_earlier_parts) {
    const int parts_now = 2 * num_ranks();
    const std::vector<Part> previous = {2 * rank(), 2 * rank() + 1, parts_now, -1};
    const std::vector<Part> parts = {2 * rank() + 1, 2 * rank(), 0, 0};
    const Remap result = remap(parts, previous, ranks_of_parts(parts_now), MPI_COMM_WORLD);
    EXPECT_EQ(result.kept_before, 0);
    EXPECT_EQ(result.kept_after, 2 * num_ranks());
    EXPECT_EQ(result.numbers[static_cast<std::size_t>(2 * rank())], 2 * rank() + 1);
}

TEST(Remap, takes_ranks_without_points) {
    const bool holder = rank() == 0;
    const std::vector<Part> parts(holder ? 5 : 0, num_ranks() - 1);
    const std::vector<Part> previous(parts.size(), 0);
    EXPECT_EQ(remap(parts, ranks_of_parts(num_ranks()), MPI_COMM_WORLD).kept_after, 5);
    EXPECT_EQ(remap(parts, previous, ranks_of_parts(num_ranks()), MPI_COMM_WORLD).kept_after, 5);
    const Remap nothing = remap({}, ranks_of_parts(num_ranks()), MPI_COMM_WORLD);
    EXPECT_TRUE(nothing.identity);
    EXPECT_EQ(nothing.num_points, 0);
}

/// Most points that any permutation keeps, by trying all.
GlobalCount most_kept(const std::vector<GlobalCount>& overlaps, int num_parts) {
    std::vector<Part> numbers(static_cast<std::size_t>(num_parts));
    std::iota(numbers.begin(), numbers.end(), 0);
    GlobalCount most = 0;
    do {
        GlobalCount kept = 0;
        for (std::size_t part = 0; part < numbers.size(); ++part)
            kept += overlaps[static_cast<std::size_t>(numbers[part]) * numbers.size() + part];
        most = std::max(most, kept);
    } while (std::ranges::next_permutation(numbers).found);
    return most;
}

TEST(Remap, keeps_half_of_the_points_that_any_permutation_keeps_in_their_part) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        std::mt19937_64 engine(1000 * seed + static_cast<unsigned>(rank()));
        const int num_parts = 5 + static_cast<int>(seed % 3);
        const auto squared = static_cast<std::size_t>(num_parts * num_parts);
        std::vector<Part> parts(engine() % 200);
        std::vector<Part> previous(parts.size());
        std::vector<GlobalCount> overlaps(squared);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            parts[i] = static_cast<Part>(engine() % static_cast<unsigned>(num_parts));
            previous[i] = static_cast<Part>(engine() % static_cast<unsigned>(num_parts + 1)) - 1;
            if (previous[i] >= 0)
                ++overlaps[static_cast<std::size_t>(previous[i] * num_parts + parts[i])];
        }
        MPI_Allreduce(MPI_IN_PLACE, overlaps.data(), static_cast<int>(squared), MPI_INT64_T,
                      MPI_SUM, MPI_COMM_WORLD);
        const std::vector<RankRange> ranks(static_cast<std::size_t>(num_parts));
        const Remap result = remap(parts, previous, ranks, MPI_COMM_WORLD);
        GlobalCount before = 0;
        GlobalCount after = 0;
        for (Part part = 0; part < num_parts; ++part) {
            const Part number = result.numbers[static_cast<std::size_t>(part)];
            before += overlaps[static_cast<std::size_t>(part * num_parts + part)];
            after += overlaps[static_cast<std::size_t>(number * num_parts + part)];
        }
        EXPECT_EQ(result.kept_before, before) << "seed " << seed;
        EXPECT_EQ(result.kept_after, after) << "seed " << seed;
        EXPECT_GE(2 * after, most_kept(overlaps, num_parts)) << "seed " << seed;
        EXPECT_GE(after, before) << "seed " << seed;
    }
}

/// Counts of all ranks that `numbers` keep in their earlier part.
GlobalCount kept_by(std::span<const Part> numbers, std::span<const Part> parts,
                    std::span<const Part> previous) {
    GlobalCount kept = 0;
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (numbers[static_cast<std::size_t>(parts[i])] == previous[i]) ++kept;
    MPI_Allreduce(MPI_IN_PLACE, &kept, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    return kept;
}

TEST(Remap, leaves_the_parts_of_a_group_together) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937_64 engine(1000 * seed + static_cast<unsigned>(rank()));
        const int group_size = 1 + static_cast<int>(seed % 4);
        const int num_parts = 7 + static_cast<int>(seed % 6);
        std::vector<Part> parts(engine() % 200);
        std::vector<Part> previous(parts.size());
        for (std::size_t i = 0; i < parts.size(); ++i) {
            parts[i] = static_cast<Part>(engine() % static_cast<unsigned>(num_parts));
            // Most points were in a part of another group.
            const auto shift = engine() % 4 == 0 ? engine() : seed;
            previous[i] = static_cast<Part>((static_cast<unsigned>(parts[i]) + shift) %
                                            static_cast<unsigned>(num_parts));
        }
        const std::vector<RankRange> ranks(static_cast<std::size_t>(num_parts));
        const Remap result = remap(parts, previous, ranks, MPI_COMM_WORLD, {group_size});
        std::vector<Part> sorted = result.numbers;
        std::ranges::sort(sorted);
        for (Part part = 0; part < num_parts; ++part) {
            EXPECT_EQ(sorted[static_cast<std::size_t>(part)], part);
            const Part first = part / group_size * group_size;
            EXPECT_EQ(result.numbers[static_cast<std::size_t>(part)] / group_size,
                      result.numbers[static_cast<std::size_t>(first)] / group_size);
        }
        std::vector<Part> unchanged(static_cast<std::size_t>(num_parts));
        std::iota(unchanged.begin(), unchanged.end(), 0);
        EXPECT_EQ(result.kept_before, kept_by(unchanged, parts, previous));
        EXPECT_EQ(result.kept_after, kept_by(result.numbers, parts, previous));
        EXPECT_GE(result.kept_after, result.kept_before);
        EXPECT_EQ(result.identity, result.numbers == unchanged);
    }
}

TEST(Remap, undoes_a_rotation_of_groups) {
    // Four groups of three parts and one of two, which keeps its place.
    const std::vector<RankRange> ranks(14);
    std::vector<Part> previous(14);
    std::iota(previous.begin(), previous.end(), 0);
    std::vector<Part> parts = previous;
    std::rotate(parts.begin(), parts.begin() + 6, parts.begin() + 12);
    const Remap result = remap(parts, previous, ranks, MPI_COMM_WORLD, {3});
    EXPECT_EQ(result.kept_before, 2 * num_ranks());
    EXPECT_EQ(result.kept_after, 14 * num_ranks());
}

TEST(Remap, of_groups_keeps_points_on_their_ranks) {
    // The parts of rank r come from rank r + 2, but for an odd number of ranks, where one stays.
    const int num_full = num_ranks() / 2 * 2;
    const int from = rank() < num_full ? (rank() + 2) % num_full : rank();
    const std::vector<Part> parts(10, from);
    const Remap result = remap(parts, ranks_of_parts(num_ranks()), MPI_COMM_WORLD, TreeShape{2});
    EXPECT_EQ(result.kept_after, 10 * num_ranks());
}

TEST(Remap, of_groups_to_which_parts_are_dealt_leaves_them_together) {
    const int groups = num_ranks() > 2 ? 3 : 1;
    const int num_parts = 12;
    std::vector<Part> parts;
    for (Part part = 0; part < num_parts; ++part)
        parts.insert(parts.end(), (part * 7 + rank() * 5) % 11, part);
    const TreeShape shape{num_parts / groups, false, 2};
    const std::vector<Part> previous(parts.rbegin(), parts.rend());
    const std::vector<RankRange> ranks(num_parts);
    const Remap result = remap(parts, previous, ranks, MPI_COMM_WORLD, shape);
    for (Part part = 0; part < num_parts; ++part)
        EXPECT_EQ(result.numbers[static_cast<std::size_t>(part)] / 2 % groups,
                  result.numbers[static_cast<std::size_t>(part / 2 % groups * 2)] / 2 % groups);
}

TEST(Remap, of_groups_that_divide_the_parts_of_a_rank_leaves_them_together) {
    // Two parts on each rank, in groups of three: numbers of some ranks are of two groups.
    const int num_parts = 2 * num_ranks();
    std::vector<Part> parts;
    for (Part part = 0; part < num_parts; ++part)
        parts.insert(parts.end(), (part * 7 + rank() * 5) % 11, part);
    const Remap result = remap(parts, ranks_of_parts(num_parts), MPI_COMM_WORLD, TreeShape{3});
    for (Part part = 0; part < num_parts; ++part)
        EXPECT_EQ(result.numbers[static_cast<std::size_t>(part)] / 3,
                  result.numbers[static_cast<std::size_t>(part / 3 * 3)] / 3);
    GlobalCount kept = std::ranges::count_if(parts, [&](Part part) {
        return result.numbers[static_cast<std::size_t>(part)] / 2 == rank();
    });
    MPI_Allreduce(MPI_IN_PLACE, &kept, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_EQ(result.kept_after, kept);
}

TEST(Remap, refuses_groups_without_parts_and_different_ones) {
    const std::vector<RankRange> ranks = ranks_of_parts(3);
    EXPECT_THROW(remap({}, ranks, MPI_COMM_WORLD, {-1}), Error);
    if (num_ranks() == 1) return;
    EXPECT_THROW(remap({}, ranks, MPI_COMM_WORLD, {is_last_rank() ? 2 : 3}), Error);
}

TEST(Remap, undoes_a_rotation_of_few_and_of_many_parts) {
    for (const int num_parts : {1, 2, 128, 129, 300}) {
        std::vector<Part> previous(static_cast<std::size_t>(num_parts));
        std::iota(previous.begin(), previous.end(), 0);
        std::vector<Part> parts = previous;
        std::rotate(parts.begin(), parts.begin() + 1 % num_parts, parts.end());
        // One origin each for a part of the ranks, so that every overlap can be told.
        for (Part part = 0; part < num_parts; ++part)
            if (part % num_ranks() != rank()) previous[static_cast<std::size_t>(part)] = -1;
        const std::vector<RankRange> ranks(parts.size());
        const Remap result = remap(parts, previous, ranks, MPI_COMM_WORLD);
        EXPECT_EQ(result.kept_before, num_parts == 1 ? 1 : 0);
        EXPECT_EQ(result.kept_after, num_parts);
        EXPECT_EQ(result.num_points, num_parts * num_ranks());
    }
}

TEST(Remap, leaves_the_numbers_of_more_than_131072_parts) {
    for (const bool is_more : {false, true}) {
        const int num_parts = (1 << 17) + (is_more ? 1 : 0);
        const std::vector<Part> previous{2, 1};
        const std::vector<Part> parts{1, 1};
        const std::vector<RankRange> ranks(static_cast<std::size_t>(num_parts));
        const std::vector<Part> more(3, 7);
        const std::vector<Part> moved(3, 8);
        const Remap result = rank() == 0 ? remap(more, moved, ranks, MPI_COMM_WORLD)
                                         : remap(parts, previous, ranks, MPI_COMM_WORLD);
        EXPECT_EQ(result.identity, is_more);
        ASSERT_EQ(std::ssize(result.numbers), num_parts);
        EXPECT_EQ(result.numbers[7], is_more ? 7 : 8);
        EXPECT_EQ(result.num_points, 3 + 2 * (num_ranks() - 1));
        EXPECT_EQ(result.kept_before, num_ranks() - 1);
        EXPECT_EQ(result.kept_after, num_ranks() - 1 + (is_more ? 0 : 3));
    }
}

TEST(Remap, needs_no_previous_parts_on_a_rank_without_points) {
    const std::vector<RankRange> ranks = ranks_of_parts(2 * num_ranks());
    std::vector<Part> parts(is_last_rank() ? 0 : 3, 2 * rank() + 1);
    const std::vector<Part> previous(parts.size(), 2 * rank());
    const Remap expected = remap(parts, previous, ranks, MPI_COMM_WORLD);
    const Remap found = parts.empty() ? remap(parts, ranks, MPI_COMM_WORLD)
                                      : remap(parts, previous, ranks, MPI_COMM_WORLD);
    EXPECT_EQ(found.numbers, expected.numbers);
    EXPECT_EQ(found.kept_after, expected.kept_after);
}

TEST(Remap, refuses_arguments_that_differ_between_ranks) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const auto expect_difference = [](const std::string& name, auto call) {
        test::expect_same_error([&] { call(); }, name + " differs between rank 0 and rank " +
                                                     std::to_string(num_ranks() - 1) +
                                                     "; give the same value on every rank");
        EXPECT_EQ(remap({}, ranks_of_parts(3), MPI_COMM_WORLD).num_points, 0);
    };
    const std::vector<Part> parts(3);
    for (const int other : {1, 129, 10000}) {
        const std::vector<RankRange> ranks = ranks_of_parts(is_last_rank() ? other : 100);
        expect_difference("ranks_of_parts", [&] { remap(parts, ranks, MPI_COMM_WORLD); });
        expect_difference("ranks_of_parts", [&] { remap(parts, parts, ranks, MPI_COMM_WORLD); });
    }
    std::vector<RankRange> elsewhere = ranks_of_parts(2);
    if (is_last_rank()) elsewhere[1].first_rank = 0;
    expect_difference("ranks_of_parts", [&] { remap(parts, elsewhere, MPI_COMM_WORLD); });
    test::expect_same_error(
        [&] {
            is_last_rank() ? (void)remap(parts, ranks_of_parts(3), MPI_COMM_WORLD)
                           : (void)remap(parts, parts, ranks_of_parts(3), MPI_COMM_WORLD);
        },
        "whether previous is given differs between rank 0 and rank " +
            std::to_string(num_ranks() - 1) + "; give the earlier part of each point");
}

TEST(Remap, refuses_on_all_ranks_what_one_gets_wrong) {
    const auto expect_error = [](const std::vector<Part>& parts, const std::vector<Part>& previous,
                                 const std::string& expected) {
        test::expect_same_error(
            [&] { remap(parts, previous, ranks_of_parts(num_ranks()), MPI_COMM_WORLD); },
            "rank " + std::to_string(num_ranks() - 1) + ": " + expected);
    };
    const std::string number = std::to_string(num_ranks());
    const std::vector<Part> fine{0, 0, 0};
    const std::vector<Part> too_few{0, 0};
    for (const Part bad : {-1, num_ranks()}) {
        const std::vector<Part> wrong{0, bad, 0};
        expect_error(is_last_rank() ? wrong : fine, fine,
                     "part " + std::to_string(bad) + " of point 1 is none of the " + number +
                         " parts; they count from 0");
    }
    expect_error(fine, is_last_rank() ? too_few : fine,
                 "previous has 2 entries, parts has 3; give one of each per point");
}

TEST(Remap, refuses_ranks_of_parts_that_are_none_of_the_communicator) {
    const std::vector<Part> parts{0, 1};
    std::vector<RankRange> descending(2);
    descending[0].first_rank = num_ranks() - 1;
    for (const std::vector<RankRange>& wrong : {std::vector<RankRange>{},
                                                {{0, 1}, {num_ranks(), 1}},
                                                {{-1, 1}, {0, 1}},
                                                {{0, 0}, {0, 1}},
                                                {{0, 1}, {0, num_ranks() + 1}},
                                                {{0, 1}, {1, std::numeric_limits<int>::max()}}}) {
        EXPECT_THROW(remap(parts, wrong, MPI_COMM_WORLD), Error);
        EXPECT_THROW(remap(parts, parts, wrong, MPI_COMM_WORLD), Error);
    }
    if (num_ranks() > 1) {
        EXPECT_THROW(remap(parts, descending, MPI_COMM_WORLD), Error);
    }
    EXPECT_EQ(remap(parts, ranks_of_parts(2), MPI_COMM_WORLD).num_points, 2 * num_ranks());
}

}  // namespace
}  // namespace rrcb
