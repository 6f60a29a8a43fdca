#include "estimate/contribution.hpp"

#include "../support/brute_passes.hpp"
#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "estimate/mesh.hpp"

namespace rrcb {
namespace {

int cells_for(int dimension, LocalIndex num_points, int num_parts) {
    Options options{.num_parts = num_parts};
    return automatic_cells_per_axis(dimension, num_points, options);
}

TEST(AutomaticMesh, has_a_cell_for_every_sixteen_points_up_to_a_limit) {
    for (const int num_parts : {1, 4, 1 << 20}) {
        EXPECT_EQ(cells_for(2, 0, num_parts), 1);
        EXPECT_EQ(cells_for(2, 15, num_parts), 1);
        EXPECT_EQ(cells_for(2, 16 * 49, num_parts), 7);
        EXPECT_EQ(cells_for(3, 16 * 27, num_parts), 3);
        EXPECT_EQ(cells_for(1, 100'000'000, num_parts), 400);
        EXPECT_EQ(cells_for(2, 100'000'000, num_parts), 42);
        EXPECT_EQ(cells_for(3, 100'000'000, num_parts), 15);
    }
}

TEST(AutomaticMesh, has_sixty_four_cells_or_sixteen_for_each_part) {
    EXPECT_EQ(cells_for(1, 50'000, 4), 64);
    EXPECT_EQ(cells_for(2, 50'000, 4), 8);
    EXPECT_EQ(cells_for(3, 50'000, 4), 4);
    EXPECT_EQ(cells_for(2, 50'000, 16), 16);
    EXPECT_EQ(cells_for(2, 50'000, 1 << 20), 22) << "no more where there are many ranks";
    EXPECT_EQ(cells_for(3, 50'000, 1 << 20), 10);
    EXPECT_EQ(cells_for(2, 800 * 31 * 31, 4), 31) << "where cells cost little beside the points";
}

struct FewCells final : test::BrutePasses {
    using BrutePasses::BrutePasses;
    std::int64_t most_cells() const override { return 125; }
};

TEST(AutomaticMesh, has_no_more_cells_than_passes_add_up_fast) {
    const std::vector<double> x = test::uniform_cloud(30000, 3, 1);
    FewCells points(x, 3);
    const Box box{{0, 0, 0}, {1, 1, 1}};
    const Options options{.num_parts = 1000};
    EXPECT_EQ(mesh_by_options(points, box, options).cells, (std::array<int, 3>{5, 5, 5}));
    test::BrutePasses others(x, 3);
    EXPECT_EQ(mesh_by_options(others, box, options).cells, (std::array<int, 3>{10, 10, 10}));
    Options on_lines;
    on_lines.expert.axes.grid.assign(3, {.origin = 0, .spacing = 0.01});
    EXPECT_EQ(mesh_by_options(points, box, on_lines).cells, (std::array<int, 3>{5, 5, 5}));
    EXPECT_EQ(mesh_by_options(others, box, on_lines).cells, (std::array<int, 3>{10, 10, 10}));
    Options given{.expert = {.cells_per_axis = 9}};
    EXPECT_EQ(mesh_by_options(points, box, given).cells, (std::array<int, 3>{9, 9, 9}));
}

Options asking_for_mesh(int cells) {
    Options options{.expert = {.cells_per_axis = cells}};
    return options;
}

TEST(MostCells, is_a_fixed_number_unless_the_mesh_was_asked_for) {
    EXPECT_EQ(most_cells(Options{}), 8192u);
    EXPECT_GT(most_cells(asking_for_mesh(500)), SIZE_MAX / 4);
}

Summary summary_of(int rank, int num_parts) {
    Options options{.num_parts = num_parts};
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

TEST(Extents, are_taken_off_the_records_in_the_order_of_the_ranks) {
    Contribution all{summary_of(0, 4), {}, {1, 2}};
    Summary next = summary_of(1, 4);
    next.num_doubles = 5;
    next.num_extent_doubles = 4;
    all.records = {};
    absorb(all, next, std::vector<double>{10, 3, 4, 5, 6}, 2, most_cells(Options{}));
    EXPECT_EQ(all.records, (std::vector<double>{10}));
    EXPECT_EQ(all.extents, (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

}  // namespace
}  // namespace rrcb
