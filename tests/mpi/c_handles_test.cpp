// Handles of C that are null, in use or destroyed, and options that are all 0.
#include "c_calls.hpp"

#include <rrcb/experimental/cost.h>

namespace rrcb {
namespace {

using test::cuts_of;
using test::expect_refused;

/// Two points on each rank, balanced, with ghosts.
class CHandles : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_EQ(rrcb_balancer_create(MPI_COMM_WORLD, &balancer), RRCB_OK);
        ASSERT_EQ(rrcb_balance(balancer, &points, parts.data()), RRCB_OK) << rrcb_last_error();
        rrcb_cuts shown = RRCB_CUTS_INIT;
        ASSERT_EQ(rrcb_get_cuts(balancer, &shown), RRCB_OK);
        ASSERT_EQ(rrcb_set_cuts(balancer, &shown), RRCB_OK);
        ASSERT_EQ(rrcb_controller_create(MPI_COMM_WORLD, &controller), RRCB_OK);
        ASSERT_EQ(rrcb_cost_model_create(MPI_COMM_WORLD, controller, 1, &model), RRCB_OK);
        ASSERT_EQ(rrcb_groups_create(balancer, &points, keys.data(), RRCB_CENTRE, &groups),
                  RRCB_OK);
        rrcb_ghost_options options = RRCB_GHOST_OPTIONS_INIT;
        options.cutoff = 0.1;
        ASSERT_EQ(rrcb_ghosts_create(balancer, &points, &options, &ghosts), RRCB_OK)
            << rrcb_last_error();
    }
    void TearDown() override { destroy(); }

    void destroy() {
        rrcb_cost_model_destroy(&model);
        rrcb_controller_destroy(&controller);
        rrcb_groups_destroy(&groups);
        rrcb_ghosts_destroy(&ghosts);
        rrcb_balancer_destroy(&balancer);
    }

    std::array<double, 4> coordinates{0.1, 0.2, 0.3, 0.4};
    std::array<std::uint64_t, 2> keys{0, 1};
    std::array<std::int32_t, 2> parts{};
    rrcb_points points = rrcb_interleaved_points(RRCB_DOUBLE, 2, 2, coordinates.data(), nullptr);
    rrcb_balancer* balancer = nullptr;
    rrcb_controller* controller = nullptr;
    rrcb_cost_model* model = nullptr;
    rrcb_groups* groups = nullptr;
    rrcb_ghosts* ghosts = nullptr;
};

TEST_F(CHandles, are_null_after_they_are_destroyed_once_or_twice) {
    destroy();
    destroy();
    EXPECT_TRUE(!balancer && !controller && !model && !groups && !ghosts);
    int due = 0;
    rrcb_points shown = RRCB_POINTS_INIT;
    rrcb_ghost_plan plan = RRCB_GHOST_PLAN_INIT;
    const std::string gone = " is null: it was not created, or is destroyed";
    expect_refused(rrcb_balance(balancer, &points, parts.data()), "balancer" + gone);
    expect_refused(rrcb_controller_due(controller, &due), "controller" + gone);
    expect_refused(rrcb_cost_model_uses_costs(model, &due), "model" + gone);
    expect_refused(rrcb_groups_points(groups, &shown), "groups" + gone);
    expect_refused(rrcb_ghosts_get_plan(ghosts, &plan), "ghosts" + gone);
    rrcb_balancer_destroy(nullptr);
    rrcb_ghosts_destroy(nullptr);
}

TEST_F(CHandles, in_use_are_refused_as_room_for_new_ones) {
    const std::string in_use = " is not null; destroy what was created before";
    rrcb_balancer* fresh = nullptr;
    rrcb_balancer** room = is_last_rank() ? &balancer : &fresh;
    rrcb_balancer* const before = balancer;
    expect_refused(rrcb_balancer_create(MPI_COMM_WORLD, room), "balancer" + in_use);
    EXPECT_EQ(fresh, nullptr);
    EXPECT_EQ(balancer, before);
    rrcb_ghost_options options = RRCB_GHOST_OPTIONS_INIT;
    options.cutoff = 0.1;
    expect_refused(rrcb_controller_create(MPI_COMM_WORLD, &controller), "controller" + in_use);
    expect_refused(rrcb_cost_model_create(MPI_COMM_WORLD, nullptr, 1, &model), "model" + in_use);
    expect_refused(rrcb_groups_create(balancer, &points, keys.data(), RRCB_CENTRE, &groups),
                   "groups" + in_use);
    expect_refused(rrcb_ghosts_create(balancer, &points, &options, &ghosts), "ghosts" + in_use);
}

TEST_F(CHandles, take_no_zeroed_options) {
    rrcb_ghosts* more = nullptr;
    const rrcb_ghost_options no_radius = RRCB_GHOST_OPTIONS_INIT;
    expect_refused(rrcb_ghosts_create(balancer, &points, &no_radius, &more),
                   "cutoff is 0, and cutoffs is null; give one of them");
    const std::array<double, 2> none{};
    rrcb_ghost_options radii_of_0 = RRCB_GHOST_OPTIONS_INIT;
    radii_of_0.cutoffs = none.data();
    EXPECT_EQ(rrcb_ghosts_create(balancer, &points, &radii_of_0, &more), RRCB_OK);
    rrcb_ghosts_destroy(&more);
    rrcb_ghost_options no_ranks = RRCB_GHOST_OPTIONS_INIT;
    no_ranks.cutoff = 0.1;
    no_ranks.num_parts = static_cast<std::size_t>(num_ranks());
    expect_refused(rrcb_ghosts_create(balancer, &points, &no_ranks, &more),
                   "ranks_of_parts is null");
    const rrcb_column no_type = RRCB_COLUMN_INIT(0, 2, coordinates.data(), coordinates.data());
    expect_refused(rrcb_ghosts_fetch(ghosts, 1, &no_type, nullptr), "must be an rrcb_type");
    std::array<double, 4> room{};
    const rrcb_column no_components =
        RRCB_COLUMN_INIT(RRCB_DOUBLE, 0, coordinates.data(), room.data());
    expect_refused(rrcb_ghosts_fetch(ghosts, 1, &no_components, nullptr), "must be 1 or more");
    rrcb_transfer_options no_bytes = RRCB_TRANSFER_OPTIONS_INIT;
    no_bytes.max_bytes = 0;
    const rrcb_column doubles = RRCB_COLUMN_INIT(RRCB_DOUBLE, 2, coordinates.data(), room.data());
    expect_refused(rrcb_groups_to_points(groups, 1, &doubles, &no_bytes),
                   "TransferOptions::max_bytes must hold two");
    const rrcb_report no_report = RRCB_REPORT_INIT;
    expect_refused(rrcb_controller_rebalanced(controller, &no_report, 1), "rrcb_get_report");
}

TEST_F(CHandles, take_no_zeroed_points_cuts_or_ranks) {
    const rrcb_points nowhere = RRCB_POINTS_INIT;
    expect_refused(rrcb_balance(balancer, &nowhere, parts.data()), "1, 2 or 3 dimensions");
    rrcb_points untyped = points;
    untyped.type = {};
    expect_refused(rrcb_balance(balancer, &untyped, parts.data()), "RRCB_DOUBLE or RRCB_FLOAT");
    const rrcb_cuts no_cuts = RRCB_CUTS_INIT;
    expect_refused(rrcb_set_cuts(balancer, &no_cuts), "1, 2 or 3 dimensions");
    const std::vector<rrcb_rank_range> no_ranks(static_cast<std::size_t>(num_ranks()));
    std::vector<std::int32_t> numbers(no_ranks.size());
    expect_refused(rrcb_remap(balancer, 2, parts.data(), nullptr, no_ranks.data(), no_ranks.size(),
                              numbers.data(), nullptr),
                   "must name ranks of this communicator");
}

TEST_F(CHandles, take_and_show_the_numbers_and_the_debt_of_cuts) {
    const std::array<rrcb_cut, 2> tree{rrcb_cut{0, 0, {1, 0, 0}}, rrcb_cut{0, 0, {2, 0, 0}}};
    const std::array<std::int32_t, 3> numbers{2, 0, 1};
    const rrcb_cuts cuts = cuts_of(1, 3, tree.data(), 1, 0, 0, numbers.data(), 0.25);
    ASSERT_EQ(rrcb_set_cuts(balancer, &cuts), RRCB_OK) << rrcb_last_error();
    rrcb_cuts shown = RRCB_CUTS_INIT;
    ASSERT_EQ(rrcb_get_cuts(balancer, &shown), RRCB_OK);
    EXPECT_TRUE(std::ranges::equal(std::span(shown.numbers, 3), numbers));
    EXPECT_EQ(shown.debt, 0.25);
    for (std::size_t end = 0; end < 3; ++end) {
        const double position[3] = {static_cast<double>(end) + 0.5, 0, 0};
        std::int32_t part = -1;
        ASSERT_EQ(rrcb_part_of(balancer, position, &part), RRCB_OK);
        EXPECT_EQ(part, numbers[end]);
    }
    for (const std::array<std::int32_t, 3>& wrong :
         {std::array{0, 0, 1}, std::array{0, 1, 3}, std::array{-1, 0, 1}}) {
        const rrcb_cuts given = cuts_of(1, 3, tree.data(), 1, 0, 0, wrong.data(), 0);
        expect_refused(rrcb_set_cuts(balancer, &given), "name each part once");
    }
}

TEST_F(CHandles, make_one_part_for_each_rank_if_asked_for_none) {
    for (const char* number : {"0", "AUTO"}) {
        ASSERT_EQ(rrcb_balancer_set(balancer, "num_parts", "7"), RRCB_OK);
        ASSERT_EQ(rrcb_balancer_set(balancer, "num_parts", number), RRCB_OK) << rrcb_last_error();
        ASSERT_EQ(rrcb_balance(balancer, &points, parts.data()), RRCB_OK) << rrcb_last_error();
        rrcb_cuts cuts = RRCB_CUTS_INIT;
        ASSERT_EQ(rrcb_get_cuts(balancer, &cuts), RRCB_OK);
        EXPECT_EQ(cuts.num_parts, num_ranks());
    }
    expect_refused(rrcb_balancer_set(balancer, "num_parts", "-1"),
                   "or 0 or AUTO for one part per rank");
}

}  // namespace
}  // namespace rrcb
