#include "gather/contribution.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rrcb {
namespace {

TEST(AutomaticMesh, has_a_cell_for_every_sixteen_points_up_to_a_limit) {
    for (const bool is_uneven : {false, true}) {
        EXPECT_EQ(automatic_cells_per_axis(2, 0, is_uneven), 1);
        EXPECT_EQ(automatic_cells_per_axis(2, 15, is_uneven), 1);
        EXPECT_EQ(automatic_cells_per_axis(2, 16 * 49, is_uneven), 7);
        EXPECT_EQ(automatic_cells_per_axis(3, 16 * 27, is_uneven), 3);
        EXPECT_EQ(automatic_cells_per_axis(1, 100'000'000, is_uneven), 400);
        EXPECT_EQ(automatic_cells_per_axis(2, 100'000'000, is_uneven), 42);
        EXPECT_EQ(automatic_cells_per_axis(3, 100'000'000, is_uneven), 15);
    }
    EXPECT_EQ(automatic_cells_per_axis(1, 20'000, false), 128);
    EXPECT_EQ(automatic_cells_per_axis(2, 50'000, false), 22);
    EXPECT_EQ(automatic_cells_per_axis(2, 200 * 31 * 31, false), 31);
    EXPECT_EQ(automatic_cells_per_axis(2, 50'000, true), 42);
    EXPECT_EQ(automatic_cells_per_axis(3, 50'000, false), 10);
    EXPECT_EQ(automatic_cells_per_axis(3, 50'000, true), 14);
}

Options asking_for_mesh(int cells) {
    Options options;
    options.support_mesh = cells;
    return options;
}

TEST(MostCells, is_a_fixed_number_unless_the_mesh_was_asked_for) {
    EXPECT_EQ(most_cells(Options{}), 8192u);
    EXPECT_GT(most_cells(asking_for_mesh(500)), std::size_t{1} << 62);
    Options options;
    options.domain = DomainKind::points;
    EXPECT_GT(most_cells(options), std::size_t{1} << 62);
}

Summary summary_of(int rank, int num_parts) {
    Options options;
    options.num_parts = num_parts;
    Summary summary;
    summary.first_rank = rank;
    summary.request = request_of(options, 2, nullptr);
    summary.num_points = 10;
    summary.weight = 2.5;
    return summary;
}

TEST(Summaries, add_up) {
    Summary all = summary_of(0, 4);
    Summary next = summary_of(1, 4);
    all.box.lower = {1, 2, 0};
    all.box.upper = {3, 4, 0};
    next.box.lower = {-1, 3, 0};
    next.box.upper = {2, 5, 0};
    join(all, next);
    EXPECT_TRUE(all.is_usable());
    EXPECT_EQ(all.num_points, 20);
    EXPECT_EQ(all.weight, 5);
    EXPECT_EQ(all.box.lower, (Vector{-1, 2, 0}));
    EXPECT_EQ(all.box.upper, (Vector{3, 5, 0}));
}

TEST(BinnedByOptions, is_finer_where_few_cells_hold_many_points) {
    // 16 points in each of 22 x 22 places, and a crowd at one of them.
    std::vector<double> x;
    for (int i = 0; i < 22 * 22 * 16; ++i) {
        x.push_back(i % 22 + 0.01 * (i % 7));
        x.push_back(i / 22 % 22 + 0.01 * (i % 5));
    }
    const auto cells_per_axis = [&](DomainKind kind) {
        const Points points = interleaved_points(x, 2);
        Options options;
        options.domain = kind;
        return bin_by_options(points, bounding_box(points), options).mesh.cells[0];
    };
    EXPECT_EQ(cells_per_axis(DomainKind::analytic), 22);
    for (int i = 0; i < 1000; ++i) x.insert(x.end(), {11 + 1e-4 * i, 11 + 1e-4 * (i % 100)});
    EXPECT_EQ(cells_per_axis(DomainKind::analytic), 23) << "of 8744 points, 16 in each cell";
    EXPECT_EQ(cells_per_axis(DomainKind::sampled), 22);
}

TEST(Summaries, keep_the_first_rank_that_fails) {
    Summary all = summary_of(0, 4);
    Summary next = summary_of(3, 4);
    next.failing_rank = 5;
    join(all, next);
    next.failing_rank = 7;
    join(all, next);
    EXPECT_FALSE(all.is_usable());
    EXPECT_EQ(all.failing_rank, 5);
}

TEST(Summaries, tell_the_first_two_ranks_that_differ) {
    Summary all = summary_of(0, 4);
    join(all, summary_of(1, 4));
    EXPECT_TRUE(all.is_usable());
    Summary subtree = summary_of(8, 4);
    join(subtree, summary_of(9, 6));
    join(subtree, summary_of(10, 7));
    join(all, subtree);
    EXPECT_FALSE(all.is_usable());
    EXPECT_EQ(all.reference_rank, 8);
    EXPECT_EQ(all.differing_rank, 9);
    EXPECT_EQ(name_of_request(all.difference), "num_parts");
}

TEST(Places, are_taken_off_the_records_in_the_order_of_the_ranks) {
    Contribution all{summary_of(0, 4), {}, {1, 2}};
    Summary next = summary_of(1, 4);
    next.num_doubles = 5;
    next.num_place_doubles = 4;
    all.records = {10, 3, 4, 5, 6};
    absorb(all, next, 2, most_cells(Options{}));
    EXPECT_EQ(all.records, (std::vector<double>{10}));
    EXPECT_EQ(all.places, (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

}  // namespace
}  // namespace rrcb
