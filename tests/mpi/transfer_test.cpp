#include "../support/ranks.hpp"
#include "../support/same_error.hpp"

#include <rrcb/error.hpp>
#include <rrcb/transfer.hpp>

namespace rrcb {
namespace {

/// Names a point by where it lay before.
std::int64_t number_of(int origin, LocalIndex index) {
    return 1'000'000 * std::int64_t{origin} + static_cast<std::int64_t>(index);
}

/// Every third rank is empty; the others hold different numbers of points, of any part.
std::vector<Part> mixed_parts(int num_parts, int round = 0) {
    std::vector<Part> parts(rank() % 3 == 1 ? 0 : static_cast<std::size_t>(40 + 11 * rank()));
    for (std::size_t i = 0; i < parts.size(); ++i)
        parts[i] = (static_cast<Part>(i * i) + 5 * rank() + round) % num_parts;
    return parts;
}

/// All points of this rank go to the next one.
Plan shift(std::size_t num_points) {
    const std::vector<Part> parts(num_points, (rank() + 1) % num_ranks());
    return plan(parts, num_ranks(), MPI_COMM_WORLD);
}

std::vector<std::int64_t> numbers_before(const Plan& plan) {
    std::vector<std::int64_t> numbers;
    for (LocalIndex i = 0; i < plan.num_points; ++i) numbers.push_back(number_of(rank(), i));
    return numbers;
}

/// As the manual has it, from the lists alone.
std::vector<std::int64_t> numbers_after(const Plan& plan) {
    std::vector<std::int64_t> numbers;
    for (LocalIndex i = 0; i < plan.num_points; ++i)
        if (std::ranges::find(plan.export_indices, i) == plan.export_indices.end())
            numbers.push_back(number_of(rank(), i));
    for (std::size_t k = 0; k < plan.import_indices.size(); ++k)
        numbers.push_back(number_of(plan.import_ranks[k], plan.import_indices[k]));
    return numbers;
}

TEST(Transfer, gives_what_stays_and_then_what_comes_by_rank) {
    for (const int num_parts : {num_ranks(), 2 * num_ranks() + 1, (num_ranks() + 1) / 2, 1}) {
        const Plan lists = plan(mixed_parts(num_parts), num_parts, MPI_COMM_WORLD);
        EXPECT_EQ(transfer(lists, numbers_before(lists), MPI_COMM_WORLD), numbers_after(lists));
    }
}

TEST(Transfer, moves_nothing_along_an_empty_plan) {
    const Plan none;
    TransferReport report{1, 1, 1};
    EXPECT_TRUE(transfer(none, std::vector<double>(), MPI_COMM_WORLD, {.report = &report}).empty());
    EXPECT_EQ(report.num_messages, 0u);
    EXPECT_EQ(report.peak_bytes, 0u);
}

struct Large {
    std::int64_t number;
    std::array<char, 1001> rest;
};

TEST(Transfer, moves_columns_of_any_type_and_width_in_one_message_for_each_pair) {
    const Plan lists = plan(mixed_parts(num_ranks()), num_ranks(), MPI_COMM_WORLD);
    const std::vector<std::int64_t> numbers = numbers_before(lists);
    std::vector<double> positions;
    std::vector<char> letters;
    std::vector<Large> large;
    for (const std::int64_t number : numbers) {
        for (const double offset : {0.0, 0.25, 0.5})
            positions.push_back(static_cast<double>(number) + offset);
        letters.push_back(static_cast<char>(number % 100));
        large.push_back({number, {}});
        large.back().rest.back() = letters.back();
    }
    TransferReport report;
    const auto [x, letter, first, again] =
        transfer(lists, columns(column(positions, 3), letters, large, std::span(numbers)),
                 MPI_COMM_WORLD, {.report = &report});

    const std::vector<std::int64_t> expected = numbers_after(lists);
    ASSERT_EQ(x.size(), 3 * expected.size());
    ASSERT_EQ(letter.size(), expected.size());
    ASSERT_EQ(first.size(), expected.size());
    EXPECT_EQ(again, expected);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(x[3 * i], static_cast<double>(expected[i]));
        EXPECT_EQ(x[3 * i + 2], static_cast<double>(expected[i]) + 0.5);
        EXPECT_EQ(letter[i], static_cast<char>(expected[i] % 100));
        EXPECT_EQ(first[i].number, expected[i]);
        EXPECT_EQ(first[i].rest.back(), letter[i]);
    }
    const std::set<int> receivers(lists.export_ranks.begin(), lists.export_ranks.end());
    EXPECT_EQ(report.num_messages, receivers.size());
    EXPECT_EQ(report.bytes_sent, lists.export_ranks.size() * (24 + 1 + sizeof(Large) + 8));
}

TEST(Transfer, of_no_columns_at_all_is_legal) {
    const Plan lists = shift(3);
    const std::tuple<> none = transfer(lists, columns(), MPI_COMM_WORLD);
    EXPECT_EQ(std::tuple_size_v<decltype(none)>, 0u);
}

TEST(Transfer, follows_lists_that_send_a_point_to_its_own_rank) {
    Plan lists;
    lists.num_points = 3;
    lists.export_indices = {1};
    lists.export_ranks = lists.import_ranks = {rank()};
    lists.import_indices = {1};
    const std::vector<int> values{10, 11, 12};
    EXPECT_EQ(transfer(lists, values, MPI_COMM_WORLD), (std::vector{10, 12, 11}));
}

TEST(Transfer, keeps_calls_apart_that_follow_each_other_at_once) {
    for (int round = 0; round < 60; ++round) {
        const Plan lists = plan(mixed_parts(num_ranks(), round), num_ranks(), MPI_COMM_WORLD);
        std::vector<std::int64_t> numbers = numbers_before(lists);
        const TransferOptions limits{round % 2 == 0 ? std::size_t{96} : std::size_t{1} << 20};
        const auto once = transfer(lists, numbers, MPI_COMM_WORLD, limits);
        for (std::int64_t& number : numbers) number = -number;
        auto twice = transfer(lists, numbers, MPI_COMM_WORLD, limits);
        for (std::int64_t& number : twice) number = -number;
        ASSERT_EQ(once, numbers_after(lists));
        ASSERT_EQ(twice, once);
    }
}

TEST(Transfer, keeps_to_its_limit_of_memory_in_any_pattern) {
    for (const std::size_t bytes : {std::size_t{16}, std::size_t{17}, std::size_t{100},
                                    std::size_t{1000}, std::size_t{4096}}) {
        const Plan lists = plan(mixed_parts(num_ranks()), num_ranks(), MPI_COMM_WORLD);
        TransferReport report;
        EXPECT_EQ(transfer(lists, numbers_before(lists), MPI_COMM_WORLD, {bytes, &report}),
                  numbers_after(lists));
        EXPECT_LE(report.peak_bytes, bytes);
    }
}

TEST(Transfer, sends_fifty_times_its_limit_in_pieces) {
    constexpr std::size_t limit = 8192;
    const Plan lists = shift(50 * limit / sizeof(std::int64_t) + 1);
    TransferReport report;
    EXPECT_EQ(transfer(lists, numbers_before(lists), MPI_COMM_WORLD, {limit, &report}).back(),
              num_ranks() == 1 ? number_of(0, lists.num_points - 1)
                               : number_of(lists.import_ranks[0], lists.num_points - 1));
    if (num_ranks() == 1) return;
    EXPECT_GE(report.bytes_sent, 50 * limit);
    EXPECT_LE(report.peak_bytes, limit);
    EXPECT_GT(report.peak_bytes, limit / 2);
    EXPECT_GE(report.num_messages, 50u);
}

/// What is wrong on the last rank, and what all ranks are told.
struct Fault {
    const char* text;
    std::function<void(Plan& plan, std::vector<double>& column, TransferOptions& limits)> make;
};

const std::vector<Fault>& faults() {
    static const std::vector<Fault> faults{
        {"a column has 8 values for 7 points of the plan; give 1 for each",
         [](auto&, auto& column, auto&) { column.push_back(0); }},
        {"a column has 0 values for 7 points", [](auto&, auto& column, auto&) { column.clear(); }},
        {"names a rank that is none of this communicator",
         [](auto& plan, auto&, auto&) { plan.export_ranks[0] = num_ranks(); }},
        {"names a rank that is none of this communicator",
         [](auto& plan, auto&, auto&) { plan.import_ranks[0] = -1; }},
        {"lists of exports of the plan differ in length",
         [](auto& plan, auto&, auto&) { plan.export_ranks.pop_back(); }},
        {"export_indices of the plan must ascend below num_points; give the plan as it was made",
         [](auto& plan, auto&, auto&) { plan.export_indices[1] = plan.export_indices[0]; }},
        {"export_indices of the plan must ascend below num_points; give the plan as it was made",
         [](auto& plan, auto&, auto&) { plan.export_indices.back() = 7; }},
        {"import_ranks of the plan must ascend; give the plan as it was made",
         [](auto& plan, auto&, auto&) {
             plan.import_ranks.insert(plan.import_ranks.begin(), num_ranks());
         }},
        {"rank 0 sends 0 points, not 1 as this plan has it",
         [](auto& plan, auto&, auto&) { plan.import_ranks.insert(plan.import_ranks.begin(), 0); }},
        {"TransferOptions::max_bytes must hold two",
         [](auto&, auto&, auto& limits) { limits = {15}; }},
    };
    return faults;
}

/// The text of the Error that a call throws, empty when it throws none.
std::string text_of(const std::function<void()>& call) {
    try {
        call();
        return {};
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
        return error.what();
    }
}

TEST(Transfer, tells_all_ranks_what_is_wrong_on_one_of_them) {
    if (num_ranks() < 3) GTEST_SKIP() << "needs three ranks, so that rank 0 sends the last nothing";
    // The last rank sends to rank 1 and gets from the one before it.
    const int next = rank() == num_ranks() - 2 ? num_ranks() - 1 : rank();
    const std::vector<Part> parts(7, is_last_rank() ? 1 : next);
    const Plan lists = plan(parts, num_ranks(), MPI_COMM_WORLD);
    const std::vector<double> values(7, rank());
    const auto expected = transfer(lists, values, MPI_COMM_WORLD);
    for (const Fault& fault : faults()) {
        Plan wrong = lists;
        std::vector<double> column = values;
        TransferOptions limits;
        if (is_last_rank()) fault.make(wrong, column, limits);
        const std::vector<double> before = column;
        test::expect_same_error([&] { transfer(wrong, column, MPI_COMM_WORLD, limits); },
                                "rank " + std::to_string(num_ranks() - 1) + ": ");
        test::expect_same_error([&] { transfer(wrong, column, MPI_COMM_WORLD, limits); },
                                fault.text);
        EXPECT_EQ(column, before);
        EXPECT_EQ(transfer(lists, values, MPI_COMM_WORLD), expected);
    }
}

TEST(Transfer, refuses_limits_that_differ_between_ranks) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const std::vector<double> values(4);
    const TransferOptions limits{is_last_rank() ? std::size_t{2000} : std::size_t{1000}};
    test::expect_same_error([&] { transfer(shift(4), values, MPI_COMM_WORLD, limits); },
                            "TransferOptions::max_bytes differs between rank 0 and rank");
}

/// Fails unless columns of as many bytes are refused on all ranks if the last rank has other ones.
void expect_refusal(const auto& columns, const auto& of_last_rank, const std::string& text) {
    const Plan lists = shift(4);
    const std::string expected = "rank " + std::to_string(num_ranks() - 1) + ": " + text;
    test::expect_same_error(
        [&] {
            if (is_last_rank())
                transfer(lists, of_last_rank, MPI_COMM_WORLD);
            else
                transfer(lists, columns, MPI_COMM_WORLD);
        },
        expected);
}

struct Pair {
    float values[2];
};

TEST(Transfer, names_the_column_whose_type_differs_between_ranks) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const std::vector<double> wide(4);
    const std::vector<float> narrow(8);
    const std::vector<std::int32_t> whole(8);
    const std::vector<std::int64_t> long_whole(4);
    const std::vector<Pair> pairs(4);
    expect_refusal(columns(column(narrow, 2), wide), columns(wide, column(narrow, 2)),
                   "column 0 (the first is 0) has 1 per point, floating-point numbers of 8 bytes, "
                   "but 2 per point, floating-point numbers of 4 bytes on rank 0");
    expect_refusal(columns(wide, column(narrow, 2)), columns(wide, column(whole, 2)),
                   "column 1 (the first is 0) has 2 per point, whole numbers of 4 bytes, but 2 per "
                   "point, floating-point numbers of 4 bytes on rank 0");
    expect_refusal(columns(wide, wide, wide), columns(wide, wide, long_whole), "column 2 ");
    expect_refusal(column(wide), column(pairs),
                   "column 0 (the first is 0) has 1 per point, values of another type of 8 bytes");
    expect_refusal(columns(wide), columns(wide, column(narrow, 2)), "2 columns, but 1 on rank 0");
}

TEST(Transfer, refuses_more_components_than_a_size_can_count) {
    const Plan none;
    const std::vector<double> empty;
    for (const std::size_t components :
         {std::size_t{1} << 30, std::numeric_limits<std::size_t>::max() / 8 + 1,
          std::numeric_limits<std::size_t>::max()})
        test::expect_same_error([&] { transfer(none, column(empty, components), MPI_COMM_WORLD); },
                                "a point has more bytes in these columns than a message holds");
}

TEST(Transfer, refuses_columns_without_components) {
    Plan one;
    one.num_points = 1;
    for (const std::size_t num_values : {0, 1}) {
        const std::vector<double> x(num_values);
        test::expect_same_error([&] { transfer(one, column(x, 0), MPI_COMM_WORLD); },
                                "components of a column must be 1 or more");
    }
}

TEST(Transfer, suggests_the_components_that_a_column_lacks) {
    Plan two;
    two.num_points = 2;
    for (const auto& [num_values, fix] :
         {std::pair{6, "; give 1 for each, or column(values, 3)"}, {5, "; give 1 for each"}}) {
        const std::vector<double> x(static_cast<std::size_t>(num_values));
        const std::string text = text_of([&] { transfer(two, x, MPI_COMM_WORLD); });
        EXPECT_TRUE(text.ends_with(fix)) << text;
    }
}

}  // namespace
}  // namespace rrcb
