#include "../support/ranks.hpp"
#include "../support/same_error.hpp"

#include <rrcb/transfer.hpp>

namespace rrcb {
namespace {

/// Points of this rank, numbered over all ranks, with two more values each.
struct Rows {
    std::vector<std::int64_t> numbers;
    std::vector<double> values;

    explicit Rows(std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            numbers.push_back(1'000'000 * rank() + static_cast<std::int64_t>(i));
            values.insert(values.end(), {1.0 * static_cast<double>(numbers.back()), -1.0 * rank()});
        }
    }
};

/// The order of the manual: arriving points at the end, the last ones in the places of leaving
/// ones.
std::vector<std::int64_t> expected_order(const Plan& lists,
                                         const std::vector<std::int64_t>& after_transfer,
                                         std::vector<std::int64_t> numbers) {
    const std::size_t num_kept = lists.num_points - lists.export_indices.size();
    numbers.insert(numbers.end(), after_transfer.begin() + static_cast<std::ptrdiff_t>(num_kept),
                   after_transfer.end());
    std::vector<bool> leaves(numbers.size());
    for (const LocalIndex i : lists.export_indices) leaves[i] = true;
    std::size_t from = after_transfer.size();
    for (std::size_t i = 0; i < after_transfer.size(); ++i) {
        if (!leaves[i]) continue;
        while (leaves[from]) ++from;
        numbers[i] = numbers[from++];
    }
    numbers.resize(after_transfer.size());
    return numbers;
}

TEST(TransferInPlace, moves_the_points_of_transfer_and_leaves_others_where_they_are) {
    for (unsigned round = 0; round < 200; ++round) {
        std::mt19937_64 engine(100 * round + static_cast<unsigned>(rank()));
        const std::size_t count = engine() % 4 == 0 ? 0 : engine() % 60;
        const unsigned share = 1 + round % 5;
        std::vector<Part> parts(count, rank());
        for (Part& part : parts)
            if (engine() % share == 0)
                part = static_cast<Part>(engine() % static_cast<unsigned>(num_ranks()));
        const Plan lists = plan(parts, num_ranks(), MPI_COMM_WORLD);
        Rows rows(count);
        const auto moved = transfer(lists, rows.numbers, MPI_COMM_WORLD);
        const auto expected = expected_order(lists, moved, rows.numbers);
        if (round % 2 == 0) {
            transfer_in_place(lists, MPI_COMM_WORLD, column(rows.numbers), column(rows.values, 2));
        } else {
            transfer_in_place(lists, MPI_COMM_WORLD, column(rows.values, 2));
            transfer_in_place(lists, MPI_COMM_WORLD, column(rows.numbers));
        }
        ASSERT_EQ(rows.numbers, expected);
        ASSERT_EQ(rows.values.size(), 2 * expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            EXPECT_EQ(rows.values[2 * i], static_cast<double>(expected[i]));
            EXPECT_EQ(rows.values[2 * i + 1], -1.0 * static_cast<double>(expected[i] / 1'000'000));
        }
    }
}

TEST(TransferInPlace, leaves_vectors_unchanged_if_it_is_refused) {
    const std::vector<Part> parts(10, (rank() + 1) % num_ranks());
    const Plan lists = plan(parts, num_ranks(), MPI_COMM_WORLD);
    Rows rows(10);
    if (is_last_rank()) rows.values.pop_back();
    const Rows before = rows;
    test::expect_same_error(
        [&] {
            transfer_in_place(lists, MPI_COMM_WORLD, column(rows.numbers), column(rows.values, 2));
        },
        "a column has 19 values for 10 points of the plan");
    EXPECT_EQ(rows.numbers, before.numbers);
    EXPECT_EQ(rows.values, before.values);
}

TEST(TransferInPlace, refuses_an_array_given_twice) {
    const std::vector<Part> parts(10, (rank() + 1) % num_ranks());
    const Plan lists = plan(parts, num_ranks(), MPI_COMM_WORLD);
    Rows rows(10);
    const Rows before = rows;
    test::expect_same_error(
        [&] {
            transfer_in_place(lists, MPI_COMM_WORLD, column(rows.numbers), column(rows.values, 2),
                              column(rows.numbers));
        },
        "columns 0 and 2 (the first is 0) are the same array");
    EXPECT_EQ(rows.numbers, before.numbers);
}

}  // namespace
}  // namespace rrcb
