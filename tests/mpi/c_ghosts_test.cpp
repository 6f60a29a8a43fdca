// Ghosts, part numbers and measures in C beside those in C++, which are the reference.
#include "c_calls.hpp"

namespace rrcb {
namespace {

using test::equal;
using test::expect_refused;

constexpr Box unit{{0, 0, 0}, {1, 1, 1}};

/// Points in the unit cube with their weights; the second rank holds none. Balanced in C.
class CGhosts : public testing::Test {
  protected:
    void SetUp() override {
        std::mt19937_64 random(static_cast<unsigned>(rank() + 1));
        std::uniform_real_distribution<double> uniform(0, 1);
        const std::size_t count = rank() == 1 ? 0 : 200;
        for (std::size_t i = 0; i < 3 * count; ++i) coordinates.push_back(uniform(random));
        for (std::size_t i = 0; i < count; ++i) weights.push_back(uniform(random));
        parts.resize(count);
        ASSERT_EQ(rrcb_balancer_create(MPI_COMM_WORLD, &balancer), RRCB_OK);
        in_c = rrcb_interleaved_points(RRCB_DOUBLE, 3, count, coordinates.data(), weights.data());
        ASSERT_EQ(rrcb_balance(balancer, &in_c, parts.data()), RRCB_OK) << rrcb_last_error();
        cuts = rrcb::balance(points(), MPI_COMM_WORLD).cuts;
        forget_points();
    }
    void TearDown() override {
        rrcb_ghosts_destroy(&ghosts);
        rrcb_balancer_destroy(&balancer);
    }

    /// Lets points stay where they are.
    void forget_points() {
        rrcb_cuts shown = RRCB_CUTS_INIT;
        ASSERT_EQ(rrcb_get_cuts(balancer, &shown), RRCB_OK);
        ASSERT_EQ(rrcb_set_cuts(balancer, &shown), RRCB_OK);
        cuts = unstamped(cuts);
    }

    Points points() const { return Points(coordinates, 3, weights); }

    void find(const rrcb_ghost_options& options) {
        rrcb_ghosts_destroy(&ghosts);
        ghosts = nullptr;
        ASSERT_EQ(rrcb_ghosts_create(balancer, &in_c, &options, &ghosts), RRCB_OK)
            << rrcb_last_error();
    }

    /// Fails unless ghosts are those of C++, of which values come and return alike.
    void expect_same(const GhostOptions& options) {
        const GhostPlan expected = rrcb::ghost_plan(cuts, points(), MPI_COMM_WORLD, options);
        rrcb_ghost_plan plan = RRCB_GHOST_PLAN_INIT;
        ASSERT_EQ(rrcb_ghosts_get_plan(ghosts, &plan), RRCB_OK);
        EXPECT_EQ(plan.num_points, expected.num_points);
        EXPECT_TRUE(equal(plan.send_indices, plan.num_sent, expected.send_indices));
        const auto is_same = [](const rrcb_rank_count& a, const RankCount& b) {
            return a.rank == b.rank && a.count == b.count;
        };
        EXPECT_TRUE(std::equal(plan.send, plan.send + plan.num_send_ranks, expected.send.begin(),
                               expected.send.end(), is_same));
        EXPECT_TRUE(std::equal(plan.receive, plan.receive + plan.num_receive_ranks,
                               expected.receive.begin(), expected.receive.end(), is_same));
        EXPECT_EQ(plan.shifts != nullptr, !expected.shifts.empty());
        for (std::size_t k = 0; k < expected.shifts.size(); ++k)
            EXPECT_TRUE(std::equal(expected.shifts[k].begin(), expected.shifts[k].end(),
                                   plan.shifts + 3 * k));

        std::vector<double> near(3 * plan.num_ghosts);
        std::vector<double> masses(plan.num_ghosts);
        const std::array fetched{
            rrcb_column RRCB_COLUMN_INIT(RRCB_DOUBLE, 3, coordinates.data(), near.data()),
            rrcb_column RRCB_COLUMN_INIT(RRCB_DOUBLE, 1, weights.data(), masses.data())};
        ASSERT_EQ(rrcb_ghosts_fetch(ghosts, 2, fetched.data(), nullptr), RRCB_OK);
        auto [near_in_cpp, masses_in_cpp] =
            fetch(expected, columns(column(coordinates, 3), weights), MPI_COMM_WORLD);
        EXPECT_EQ(masses, masses_in_cpp);
        rrcb_points moved =
            rrcb_interleaved_points(RRCB_DOUBLE, 3, plan.num_ghosts, near.data(), nullptr);
        ASSERT_EQ(rrcb_ghosts_apply_shifts(ghosts, &moved), RRCB_OK);
        apply_shifts(expected, near_in_cpp);
        EXPECT_EQ(near, near_in_cpp);
        std::vector<float> floats(near.begin(), near.end());
        std::vector<float> floats_in_cpp = floats;
        moved = rrcb_interleaved_points(RRCB_FLOAT, 3, plan.num_ghosts, floats.data(), nullptr);
        ASSERT_EQ(rrcb_ghosts_apply_shifts(ghosts, &moved), RRCB_OK);
        apply_shifts(expected, floats_in_cpp);
        EXPECT_EQ(floats, floats_in_cpp);
        expect_same_sums(expected, near, masses);
    }

    void expect_same_sums(const GhostPlan& expected, const std::vector<double>& near,
                          const std::vector<double>& masses) {
        std::vector<double> sums = coordinates;
        std::vector<std::int32_t> numbers(weights.size(), rank());
        const std::vector<std::int32_t> ones(masses.size(), 1);
        const std::array added{
            rrcb_column RRCB_COLUMN_INIT(RRCB_DOUBLE, 3, near.data(), sums.data()),
            rrcb_column RRCB_COLUMN_INIT(RRCB_INT32, 1, ones.data(), numbers.data())};
        ASSERT_EQ(rrcb_ghosts_accumulate(ghosts, 2, added.data(), nullptr), RRCB_OK);
        const std::vector<std::int32_t> start(weights.size(), rank());
        const auto [sums_in_cpp, numbers_in_cpp] =
            accumulate(expected, columns(column(near, 3), ones),
                       columns(column(coordinates, 3), start), MPI_COMM_WORLD);
        EXPECT_EQ(sums, sums_in_cpp);
        EXPECT_EQ(numbers, numbers_in_cpp);
        std::vector<double> replies(3 * expected.send_indices.size());
        const rrcb_column sent = RRCB_COLUMN_INIT(RRCB_DOUBLE, 3, near.data(), replies.data());
        ASSERT_EQ(rrcb_ghosts_reply(ghosts, 1, &sent, nullptr), RRCB_OK);
        EXPECT_EQ(replies, reply(expected, column(near, 3), MPI_COMM_WORLD));
    }

    rrcb_balancer* balancer = nullptr;
    rrcb_ghosts* ghosts = nullptr;
    std::vector<double> coordinates;
    std::vector<double> weights;
    std::vector<std::int32_t> parts;
    rrcb_points in_c = RRCB_POINTS_INIT;
    Cuts cuts;
};

TEST_F(CGhosts, of_points_that_have_yet_to_leave_are_refused_on_all_ranks) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    rrcb_ghost_options options = RRCB_GHOST_OPTIONS_INIT;
    options.cutoff = 0.1;
    const auto refused = [&] {
        expect_refused(rrcb_ghosts_create(balancer, &in_c, &options, &ghosts),
                       "the points of the balance");
    };
    ASSERT_EQ(rrcb_assign_all(balancer, &in_c, parts.data()), RRCB_OK);
    refused();
    ASSERT_EQ(rrcb_balance(balancer, &in_c, parts.data()), RRCB_OK);
    refused();
}

TEST_F(CGhosts, are_those_of_a_call_in_cpp) {
    rrcb_ghost_options options = RRCB_GHOST_OPTIONS_INIT;
    options.cutoff = 0.1;
    find(options);
    expect_same({.cutoff = 0.1});
    options.lower = unit.lower.data();
    options.upper = unit.upper.data();
    find(options);
    expect_same({.cutoff = 0.1, .periodic = unit});
}

TEST_F(CGhosts, take_a_radius_of_each_point_and_ranks_of_parts) {
    std::vector<double> radii(weights.size());
    for (std::size_t i = 0; i < radii.size(); ++i) radii[i] = 0.2 * weights[i];
    std::vector<RankRange> ranks;
    std::vector<rrcb_rank_range> ranks_in_c;
    for (int part = 0; part < num_ranks(); ++part) {
        ranks.push_back({num_ranks() - 1 - part, 1});
        ranks_in_c.push_back({num_ranks() - 1 - part, 1});
    }
    rrcb_ghost_options options = RRCB_GHOST_OPTIONS_INIT;
    options.cutoffs = radii.data();
    options.ranks_of_parts = ranks_in_c.data();
    options.num_parts = ranks_in_c.size();
    find(options);
    GhostOptions expected;
    expected.cutoff = radii;
    expected.ranks_of_parts = ranks;
    expect_same(expected);
    for (const auto& [name, needs] : {std::pair(RRCB_NEEDS_GATHER, Needs::gather),
                                      std::pair(RRCB_NEEDS_SYMMETRIC, Needs::symmetric)}) {
        options.needs = name;
        expected.needs = needs;
        find(options);
        expect_same(expected);
    }
}

TEST_F(CGhosts, from_before_a_transfer_are_refused) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    rrcb_ghost_options options = RRCB_GHOST_OPTIONS_INIT;
    options.cutoff = 0.1;
    find(options);
    const std::vector<std::int32_t> to_next(weights.size(), (rank() + 1) % num_ranks());
    ASSERT_EQ(rrcb_plan(balancer, to_next.size(), to_next.data()), RRCB_OK);
    ASSERT_EQ(rrcb_transfer(balancer, 0, nullptr, nullptr), RRCB_OK);
    expect_refused(rrcb_ghosts_fetch(ghosts, 0, nullptr, nullptr),
                   "the points were transferred since");
}

TEST_F(CGhosts, what_is_wrong_on_one_rank_fails_on_all) {
    rrcb_ghost_options options = RRCB_GHOST_OPTIONS_INIT;
    options.cutoff = 0.1;
    const rrcb_ghost_options* none_there = is_last_rank() ? nullptr : &options;
    expect_refused(rrcb_ghosts_create(balancer, &in_c, none_there, &ghosts), "options is null");
    EXPECT_EQ(ghosts, nullptr);
    rrcb_ghosts** no_room = is_last_rank() ? nullptr : &ghosts;
    expect_refused(rrcb_ghosts_create(balancer, &in_c, &options, no_room), "ghosts is null");
    const rrcb_points* no_points = is_last_rank() ? nullptr : &in_c;
    expect_refused(rrcb_ghosts_create(balancer, no_points, &options, &ghosts), "points is null");
    if (is_last_rank()) options.lower = unit.lower.data();
    expect_refused(rrcb_ghosts_create(balancer, &in_c, &options, &ghosts), "upper is null");
    options.lower = nullptr;
    options.cutoff = -1;
    expect_refused(rrcb_ghosts_create(balancer, &in_c, &options, &ghosts),
                   "the cutoff must be finite");
    options.cutoff = 0.1;
    const rrcb_rank_range to_first{0, 1};
    options.ranks_of_parts = is_last_rank() ? &to_first : nullptr;
    expect_refused(rrcb_ghosts_create(balancer, &in_c, &options, &ghosts), "parts, not 0");
    options.ranks_of_parts = nullptr;
    rrcb_points shifted = in_c;
    if (rank() == 0) shifted.stride = 3;
    expect_refused(rrcb_ghosts_create(balancer, &shifted, &options, &ghosts), "must be in bytes");
    find(options);
    double value = 0;
    rrcb_column column = RRCB_COLUMN_INIT(RRCB_DOUBLE, 0, &value, &value);
    expect_refused(rrcb_ghosts_accumulate(ghosts, 1, &column, nullptr), "must be 1 or more");
    column = RRCB_COLUMN_INIT(is_last_rank() ? RRCB_BYTE : RRCB_DOUBLE, 1, &value, &value);
    expect_refused(rrcb_ghosts_accumulate(ghosts, 1, &column, nullptr), "give a type of numbers");
    const rrcb_column* no_columns = is_last_rank() ? nullptr : &column;
    expect_refused(rrcb_ghosts_fetch(ghosts, 1, no_columns, nullptr), "columns is null");
    expect_refused(rrcb_ghosts_accumulate(ghosts, 1, no_columns, nullptr), "columns is null");
    expect_refused(rrcb_ghosts_fetch(nullptr, 0, nullptr, nullptr), "ghosts is null");
    if (num_ranks() > 1) {
        rrcb_transfer_options limits = RRCB_TRANSFER_OPTIONS_INIT;
        limits.max_bytes = is_last_rank() ? std::size_t{1} << 20 : 1 << 21;
        expect_refused(rrcb_ghosts_fetch(ghosts, 0, nullptr, &limits), "TransferOptions");
    }
}

TEST_F(CGhosts, measures_are_those_of_cpp) {
    const std::vector<double> expected =
        part_weights(points(), parts, cuts.num_parts, MPI_COMM_WORLD);
    std::vector<double> of_parts(expected.size());
    ASSERT_EQ(rrcb_part_weights(balancer, &in_c, parts.data(), of_parts.size(), of_parts.data()),
              RRCB_OK);
    EXPECT_EQ(of_parts, expected);
    double number = -1;
    ASSERT_EQ(rrcb_moved_fraction(balancer, &in_c, parts.data(), &number), RRCB_OK);
    EXPECT_EQ(number, moved_fraction(points(), parts, cuts.num_parts, MPI_COMM_WORLD));
    ASSERT_EQ(rrcb_imbalance(of_parts.size(), of_parts.data(), nullptr, &number), RRCB_OK);
    EXPECT_EQ(number, imbalance(of_parts));
    std::vector<double> sizes(of_parts.size(), 2);
    sizes[0] = 1;
    const std::vector<double> expected_sizes = balanced_sizes(of_parts, sizes);
    ASSERT_EQ(rrcb_balanced_sizes(of_parts.size(), of_parts.data(), sizes.data(), sizes.data()),
              RRCB_OK);
    EXPECT_EQ(sizes, expected_sizes);
    expect_refused(rrcb_imbalance(1, nullptr, nullptr, &number),
                   "part_weights, or an array of one for each part, is null");
}

TEST_F(CGhosts, look_ups_are_those_of_cpp) {
    Vector lower;
    Vector upper;
    ASSERT_EQ(rrcb_bounding_box(&in_c, lower.data(), upper.data()), RRCB_OK);
    const Box box = bounding_box(points());
    EXPECT_EQ(lower, box.lower);
    EXPECT_EQ(upper, box.upper);
    lower = {0.4, 0.2, 0.1};
    upper = {0.6, 0.9, 0.9};
    const std::vector<Part> expected = parts_touching(cuts, {lower, upper});
    std::vector<std::int32_t> touched(expected.size() + 1, -1);
    std::size_t count = 0;
    ASSERT_EQ(rrcb_parts_touching(balancer, lower.data(), upper.data(), expected.size(),
                                  touched.data(), &count),
              RRCB_OK);
    EXPECT_EQ(count, expected.size());
    EXPECT_TRUE(equal(touched.data(), count, expected));
    EXPECT_EQ(touched.back(), -1);
    ASSERT_EQ(rrcb_parts_touching(balancer, lower.data(), upper.data(), 0, nullptr, &count),
              RRCB_OK);
    EXPECT_EQ(count, expected.size());
    rrcb_rank_range ranks;
    ASSERT_EQ(rrcb_ranks_of_part(2, 3, 7, &ranks), RRCB_OK);
    EXPECT_EQ(ranks.first_rank, ranks_of_part(2, 3, 7).first_rank);
    EXPECT_EQ(ranks.count, ranks_of_part(2, 3, 7).count);
    expect_refused(rrcb_ranks_of_part(3, 3, 7, &ranks), "");
    EXPECT_EQ(rrcb_release_buffers(balancer), RRCB_OK);
}

TEST_F(CGhosts, points_have_strides) {
    struct Particle {
        double mass;
        double at[3];
    };
    std::vector<Particle> particles;
    std::vector<double> axes[3];
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double* x = &coordinates[3 * i];
        particles.push_back({weights[i], {x[0], x[1], x[2]}});
        for (std::size_t a = 0; a < 3; ++a) axes[a].push_back(x[a]);
    }
    rrcb_points strided = in_c;
    strided.stride = sizeof(Particle);
    for (std::size_t a = 0; a < 3 && !particles.empty(); ++a) strided.axes[a] = &particles[0].at[a];
    std::vector<std::int32_t> again(parts.size());
    ASSERT_EQ(rrcb_assign(balancer, &strided, again.data()), RRCB_OK) << rrcb_last_error();
    EXPECT_EQ(again, parts);
    const std::array<const void*, 3> columns{axes[0].data(), axes[1].data(), axes[2].data()};
    const rrcb_points separate =
        rrcb_column_points(RRCB_DOUBLE, 3, weights.size(), columns.data(), nullptr);
    again.assign(parts.size(), -1);
    ASSERT_EQ(rrcb_assign(balancer, &separate, again.data()), RRCB_OK) << rrcb_last_error();
    EXPECT_EQ(again, parts);
}

TEST_F(CGhosts, coordinates_may_be_floats) {
    const std::vector<float> floats(coordinates.begin(), coordinates.end());
    std::vector<Part> expected(parts.size());
    assign(cuts, Points(floats, 3), expected);
    const rrcb_points short_points =
        rrcb_interleaved_points(RRCB_FLOAT, 3, parts.size(), floats.data(), nullptr);
    std::vector<std::int32_t> again(parts.size(), -1);
    ASSERT_EQ(rrcb_assign(balancer, &short_points, again.data()), RRCB_OK) << rrcb_last_error();
    EXPECT_EQ(again, expected);
    rrcb_points odd = in_c;
    odd.stride += 4;
    if (odd.count == 0) return;
    EXPECT_EQ(rrcb_assign(balancer, &odd, again.data()), RRCB_INVALID_ARGUMENT);
    EXPECT_NE(std::strstr(rrcb_last_error(), "stride"), nullptr) << rrcb_last_error();
}

TEST_F(CGhosts, groups_are_those_of_cpp) {
    std::vector<std::uint64_t> keys(parts.size());
    for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = i % 7 == 0 ? RRCB_NO_GROUP : i / 4;
    for (const bool first : {false, true}) {
        const Groups expected = rrcb::groups(points(), keys, MPI_COMM_WORLD,
                                             first ? GroupPlace::first_point : GroupPlace::centre);
        rrcb_groups* groups = nullptr;
        ASSERT_EQ(rrcb_groups_create(balancer, &in_c, keys.data(),
                                     first ? RRCB_FIRST_POINT : RRCB_CENTRE, &groups),
                  RRCB_OK)
            << rrcb_last_error();
        rrcb_points shown = RRCB_POINTS_INIT;
        ASSERT_EQ(rrcb_groups_points(groups, &shown), RRCB_OK);
        const std::size_t count = shown.count;
        ASSERT_EQ(count, expected.weights.size());
        const double* x = static_cast<const double*>(shown.axes[0]);
        EXPECT_TRUE(equal(x, 3 * count, expected.coordinates));
        EXPECT_TRUE(equal(shown.weights, count, expected.weights));

        std::vector<std::int32_t> numbers(count);
        for (std::size_t g = 0; g < count; ++g)
            numbers[g] = 1000 * rank() + static_cast<std::int32_t>(g);
        std::vector<std::int32_t> of_points(parts.size());
        const rrcb_column column =
            RRCB_COLUMN_INIT(RRCB_INT32, 1, numbers.data(), of_points.data());
        ASSERT_EQ(rrcb_groups_to_points(groups, 1, &column, nullptr), RRCB_OK);
        EXPECT_EQ(of_points, to_points(expected, numbers, MPI_COMM_WORLD));
        std::vector<double> added(3 * count);
        ASSERT_EQ(rrcb_groups_sums(groups, 3, coordinates.data(), added.data()), RRCB_OK);
        EXPECT_EQ(added, group_sums(expected, coordinates, MPI_COMM_WORLD, 3));
        rrcb_groups_destroy(&groups);
    }
    rrcb_groups* groups = nullptr;
    const int no_place = 7;
    expect_refused(rrcb_groups_create(balancer, &in_c, keys.data(), no_place, &groups),
                   "the place of groups must be");
    expect_refused(rrcb_groups_create(balancer, is_last_rank() ? nullptr : &in_c, keys.data(),
                                      RRCB_CENTRE, &groups),
                   "points is null");
}

TEST_F(CGhosts, part_numbers_are_those_of_cpp) {
    std::vector<Part> previous(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) previous[i] = (parts[i] + 1) % num_ranks();
    std::vector<RankRange> ranks;
    for (Part part = 0; part < num_ranks(); ++part)
        ranks.push_back(ranks_of_part(part, num_ranks(), num_ranks()));
    for (const bool by_previous : {false, true}) {
        const Remap expected = by_previous
                                   ? remap(parts, previous, ranks, MPI_COMM_WORLD, cuts.shape)
                                   : remap(parts, ranks, MPI_COMM_WORLD, cuts.shape);
        std::vector<std::int32_t> numbers(ranks.size());
        const std::int32_t* earlier = previous.empty() ? nullptr : previous.data();
        rrcb_remap_report kept = RRCB_REMAP_REPORT_INIT;
        ASSERT_EQ(rrcb_remap(balancer, parts.size(), parts.data(), by_previous ? earlier : nullptr,
                             nullptr, numbers.size(), numbers.data(), &kept),
                  RRCB_OK)
            << rrcb_last_error();
        EXPECT_EQ(numbers, expected.numbers);
        EXPECT_EQ(kept.identity, expected.identity ? 1 : 0);
        EXPECT_EQ(kept.num_points, expected.num_points);
        EXPECT_EQ(kept.kept_before, expected.kept_before);
        EXPECT_EQ(kept.kept_after, expected.kept_after);
        EXPECT_TRUE(!by_previous || kept.kept_after == kept.num_points);
    }
}

}  // namespace
}  // namespace rrcb
