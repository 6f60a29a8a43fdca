#include "../support/ranks.hpp"
#include "../support/same_error.hpp"

#include <rrcb/error.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/quality.hpp>

namespace rrcb {
namespace {

TEST(RanksOfPart, remainder_goes_to_the_last_ranks) {
    // 7 parts on 3 ranks: 2, 2, 3.
    const std::vector<int> expected{0, 0, 1, 1, 2, 2, 2};
    for (Part part = 0; part < 7; ++part) {
        EXPECT_EQ(ranks_of_part(part, 7, 3).first_rank, expected[static_cast<std::size_t>(part)]);
        EXPECT_EQ(ranks_of_part(part, 7, 3).count, 1);
    }
}

TEST(RanksOfPart, fewer_parts_than_ranks_spread_over_consecutive_ranks) {
    // 3 parts on 7 ranks: ranks 0-1, 2-4, 5-6; on 4 ranks: 0, 1-2, 3.
    EXPECT_EQ(ranks_of_part(0, 3, 7).first_rank, 0);
    EXPECT_EQ(ranks_of_part(0, 3, 7).count, 2);
    EXPECT_EQ(ranks_of_part(1, 3, 7).first_rank, 2);
    EXPECT_EQ(ranks_of_part(2, 3, 7).first_rank, 5);
    EXPECT_EQ(ranks_of_part(2, 3, 7).count, 2);
    EXPECT_EQ(ranks_of_part(1, 3, 4).first_rank, 1);
    EXPECT_EQ(ranks_of_part(1, 3, 4).count, 2);
}

TEST(Plan, imports_mirror_exports) {
    // Rank r holds r + 2 points; point i goes to part (r + i) mod P.
    std::vector<Part> parts;
    for (int i = 0; i < rank() + 2; ++i) parts.push_back((rank() + i) % num_ranks());
    const Plan result = plan(parts, num_ranks(), MPI_COMM_WORLD);

    std::size_t next = 0;
    for (LocalIndex i = 0; i < parts.size(); ++i) {
        if (parts[i] == rank()) continue;
        ASSERT_LT(next, result.export_indices.size());
        EXPECT_EQ(result.export_indices[next], i);
        EXPECT_EQ(result.export_ranks[next], parts[i]);
        EXPECT_EQ(result.export_parts[next++], parts[i]);
    }
    EXPECT_EQ(next, result.export_indices.size());

    next = 0;
    for (int source = 0; source < num_ranks(); ++source) {
        for (int i = 0; i < source + 2; ++i) {
            if (source == rank() || (source + i) % num_ranks() != rank()) continue;
            ASSERT_LT(next, result.import_indices.size());
            EXPECT_EQ(result.import_ranks[next], source);
            EXPECT_EQ(result.import_indices[next], static_cast<LocalIndex>(i));
            EXPECT_EQ(result.import_parts[next++], rank());
        }
    }
    EXPECT_EQ(next, result.import_indices.size());
}

TEST(PartWeights, are_added_up_over_the_ranks_however_many_parts_there_are) {
    for (const int num_parts : {1, 1023, 1024, 5000}) {
        // Rank r has the weight r + 1 in the first part and in the last.
        const std::vector<double> x(2);
        const std::vector<double> weights(2, rank() + 1.0);
        const std::vector<Part> parts{0, num_parts - 1};
        const auto sums = part_weights(Points(x, 1, weights), parts, num_parts, MPI_COMM_WORLD);
        ASSERT_EQ(sums.size(), static_cast<std::size_t>(num_parts));
        const double all = num_ranks() * (num_ranks() + 1) / 2;
        EXPECT_EQ(sums.front(), num_parts == 1 ? 2 * all : all);
        EXPECT_EQ(sums.back(), num_parts == 1 ? 2 * all : all);
        EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), 0.0), 2 * all);
    }
}

TEST(PartWeights, of_points_without_a_part_are_refused_on_all_ranks) {
    const std::vector<double> x(2);
    const std::vector<Part> parts(is_last_rank() ? 1 : 2);
    test::expect_same_error([&] { part_weights(Points(x, 1), parts, 2, MPI_COMM_WORLD); },
                            "rank " + std::to_string(num_ranks() - 1) +
                                ": parts has 1 entries for 2 points; give one per point");
}

/// Calls of the functions that take parts.
using Call = std::function<void(std::span<const Part> parts, int num_parts)>;

const std::vector<Call>& calls() {
    static const std::vector<double> x(5);
    const auto points_of = [](std::span<const Part> parts) {
        return Points(std::span(x).first(parts.size()), 1);
    };
    static const std::vector<Call> all{
        [](auto parts, int num_parts) { plan(parts, num_parts, MPI_COMM_WORLD); },
        [=](auto parts, int num_parts) {
            const Points points = points_of(parts);
            const double sum = part_weights(points, parts, num_parts, MPI_COMM_WORLD)[0];
            EXPECT_EQ(sum, static_cast<double>(parts.size()) * num_ranks());
        },
        [=](auto parts, int num_parts) {
            moved_fraction(points_of(parts), parts, num_parts, MPI_COMM_WORLD);
        }};
    return all;
}

TEST(Parts, that_are_none_on_one_rank_are_refused_on_all) {
    const std::vector<Part> parts{is_last_rank() ? 7 : 0};
    for (const Call& call : calls())
        test::expect_same_error(
            [&] { call(parts, 2); },
            "rank " + std::to_string(num_ranks() - 1) +
                ": part 7 of point 0 is none of the 2 parts; they count from 0");
}

/// The last rank divides into so many parts that messages of their length would be others.
TEST(Parts, of_numbers_that_differ_are_refused_on_all_ranks) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const std::vector<Part> parts(5);
    for (const Call& call : calls())
        for (const int other : {2, 3, 5000}) {
            test::expect_same_error([&] { call(parts, is_last_rank() ? other : 1); },
                                    "num_parts differs between rank 0 and rank " +
                                        std::to_string(num_ranks() - 1) +
                                        "; give the same value on every rank");
            call(parts, 2);
        }
}

TEST(MovedFraction, counts_the_weight_that_changes_rank) {
    // Two points per rank, weights 1 and 3; the heavy one goes to the next rank.
    const std::vector<double> x{0, 1};
    const std::vector<double> weights{1, 3};
    const std::vector<Part> parts{rank(), (rank() + 1) % num_ranks()};
    const Points points(x, 1, weights);
    const double expected = num_ranks() == 1 ? 0 : 0.75;
    EXPECT_DOUBLE_EQ(moved_fraction(points, parts, num_ranks(), MPI_COMM_WORLD), expected);
}

TEST(RanksOfPart, of_a_part_or_rank_that_is_none_are_refused) {
    EXPECT_THROW(ranks_of_part(5, 3, 2), Error);
    EXPECT_THROW(ranks_of_part(-1, 3, 2), Error);
    EXPECT_THROW(ranks_of_part(3, 3, 8), Error);
    EXPECT_THROW(ranks_of_part(0, 0, 2), Error);
    EXPECT_THROW(ranks_of_part(0, 3, 0), Error);
    EXPECT_THROW(ranks_of_part(0, 3, -1), Error);
}

TEST(Parts, that_are_no_number_of_are_refused_on_all_ranks) {
    for (const int num_parts : {0, -1})
        for (const Call& call : calls()) {
            EXPECT_THROW(call({}, num_parts), Error);
            EXPECT_THROW(call({}, is_last_rank() ? num_parts : 1), Error);
        }
}

}  // namespace
}  // namespace rrcb
