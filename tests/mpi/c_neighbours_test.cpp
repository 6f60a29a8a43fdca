// The exchanges with neighbours in C beside those in C++, which are the reference.
#include "../support/clouds.hpp"
#include "c_calls.hpp"

#include <cstdlib>

namespace rrcb {
namespace {

constexpr double radius = 0.1;
constexpr double travel = 0.05;

/// A periodic unit square of 600 points, in C and C++.
class CNeighbours : public testing::Test {
  protected:
    void SetUp() override {
        const std::vector<double> all = test::uniform_cloud(600, 2, 3);
        for (std::size_t i = static_cast<std::size_t>(rank()); i < 600;
             i += static_cast<std::size_t>(num_ranks())) {
            x_.insert(x_.end(), {all[2 * i], all[2 * i + 1]});
            ids_.push_back(static_cast<std::int64_t>(i));
        }
        const Balance made = balance(Points(x_, 2), MPI_COMM_WORLD);
        std::tie(x_, ids_) =
            transfer(plan(made, MPI_COMM_WORLD), columns(column(x_, 2), ids_), MPI_COMM_WORLD);
        cuts_ = made.cuts;
        ASSERT_EQ(rrcb_balancer_create(MPI_COMM_WORLD, &balancer_), RRCB_OK);
        std::vector<rrcb_cut> tree;
        for (const Cut& cut : cuts_.tree)
            tree.push_back({static_cast<std::int32_t>(cut.axis),
                            cut.divides ? 1 : 0,
                            {cut.at[0], cut.at[1], cut.at[2]}});
        const rrcb_cuts shown = test::cuts_of(2, cuts_.num_parts, tree.data());
        ASSERT_EQ(rrcb_set_cuts(balancer_, &shown), RRCB_OK) << rrcb_last_error();
        const double lower[3]{0, 0, 0};
        const double upper[3]{1, 1, 1};
        rrcb_neighbour_options options = RRCB_NEIGHBOUR_OPTIONS_INIT;
        options.cutoff = radius;
        options.travel = travel;
        options.lower = lower;
        options.upper = upper;
        ASSERT_EQ(rrcb_neighbours_create(balancer_, &options, &neighbours_), RRCB_OK)
            << rrcb_last_error();
        own_.emplace(
            cuts_, MPI_COMM_WORLD,
            NeighbourOptions{.cutoff = radius, .travel = travel, .periodic = Box{{}, {1, 1, 1}}});
        // Memory of malloc(), without room for more points, and a vector.
        columns_[0].values = std::malloc(x_.size() * sizeof(double) + 1);
        columns_[0].count = columns_[0].capacity = ids_.size();
        std::copy(x_.begin(), x_.end(), static_cast<double*>(columns_[0].values));
        ids_in_c_ = ids_;
        columns_[1].values = ids_in_c_.data();
        columns_[1].count = ids_.size();
        columns_[1].owner = &ids_in_c_;
        columns_[1].resize = [](void* owner, std::size_t count) -> void* {
            auto& ids = *static_cast<std::vector<std::int64_t>*>(owner);
            ids.resize(count);
            return ids.data();
        };
    }
    void TearDown() override {
        rrcb_neighbours_destroy(&neighbours_);
        rrcb_balancer_destroy(&balancer_);
        EXPECT_EQ(neighbours_, nullptr);
        for (const rrcb_array& array : {columns_[0], ghosts_[0], ghosts_[1]})
            std::free(array.values);
    }

    double* x_in_c() const { return static_cast<double*>(columns_[0].values); }
    rrcb_points points() const {
        return rrcb_interleaved_points(RRCB_DOUBLE, 2, columns_[0].count, x_in_c(), nullptr);
    }
    int migrate() {
        const rrcb_points positions = points();
        return rrcb_neighbours_migrate(neighbours_, &positions, 2, columns_);
    }
    int find() {
        const rrcb_points positions = points();
        return rrcb_neighbours_find_ghosts(neighbours_, &positions, nullptr);
    }
    int fetch() {
        const void* const from[]{columns_[0].values, columns_[1].values};
        return rrcb_neighbours_fetch(neighbours_, 2, from, ghosts_);
    }

    /// Moves each point by up to half of the travel, and back into the box.
    static void drift(double* x, const std::vector<std::int64_t>& ids, int step) {
        for (std::size_t i = 0; i < 2 * ids.size(); ++i) {
            x[i] += 0.5 * travel *
                    std::sin(static_cast<double>(ids[i / 2] + 7 * step) + (i % 2 == 0 ? 0.0 : 2.0));
            x[i] -= std::floor(x[i]);
        }
    }

    /// Expects an error on every rank, whose text has this, within as many calls as there are
    /// ranks.
    void expect_error(const std::function<int()>& call, const std::string& text) {
        int code = RRCB_OK;
        for (int k = 0; k <= num_ranks() && code == RRCB_OK; ++k) code = call();
        EXPECT_EQ(code, RRCB_INVALID_ARGUMENT);
        EXPECT_NE(std::string(rrcb_last_error()).find(text), std::string::npos)
            << rrcb_last_error();
    }

    std::vector<double> x_;
    std::vector<std::int64_t> ids_;
    std::vector<std::int64_t> ids_in_c_;
    Cuts cuts_;
    std::optional<Neighbours> own_;
    rrcb_balancer* balancer_ = nullptr;
    rrcb_neighbours* neighbours_ = nullptr;
    rrcb_array columns_[2]{RRCB_ARRAY_INIT(RRCB_DOUBLE, 2), RRCB_ARRAY_INIT(RRCB_INT64, 1)};
    rrcb_array ghosts_[2]{RRCB_ARRAY_INIT(RRCB_DOUBLE, 2), RRCB_ARRAY_INIT(RRCB_INT64, 1)};
};

TEST_F(CNeighbours, give_the_points_ghosts_and_sums_of_cpp) {
    std::vector<double> ghost_x;
    std::vector<std::int64_t> ghost_ids;
    for (int step = 0; step < 6; ++step) {
        drift(x_.data(), ids_, step);
        drift(x_in_c(), ids_in_c_, step);
        own_->migrate(column(x_, 2), ids_);
        ASSERT_EQ(migrate(), RRCB_OK) << rrcb_last_error();
        ASSERT_EQ(columns_[0].count, ids_.size());
        ASSERT_EQ(columns_[1].count, ids_.size());
        EXPECT_TRUE(std::equal(x_.begin(), x_.end(), x_in_c()));
        EXPECT_EQ(ids_in_c_, ids_);

        own_->find_ghosts(column(x_, 2));
        own_->fetch(ghosts_of(ghost_x, ghost_ids), column(x_, 2), ids_);
        ASSERT_EQ(find(), RRCB_OK) << rrcb_last_error();
        ASSERT_EQ(fetch(), RRCB_OK) << rrcb_last_error();
        rrcb_ghost_plan lists = RRCB_GHOST_PLAN_INIT;
        ASSERT_EQ(rrcb_neighbours_ghost_plan(neighbours_, &lists), RRCB_OK);
        EXPECT_EQ(lists.num_ghosts, ghost_ids.size());
        EXPECT_TRUE(std::equal(lists.send_indices, lists.send_indices + lists.num_sent,
                               own_->ghost_plan().send_indices.begin(),
                               own_->ghost_plan().send_indices.end()));
        const rrcb_points near =
            rrcb_interleaved_points(RRCB_DOUBLE, 2, ghosts_[0].count, ghosts_[0].values, nullptr);
        ASSERT_EQ(rrcb_neighbours_apply_shifts(neighbours_, &near), RRCB_OK) << rrcb_last_error();
        apply_shifts(own_->ghost_plan(), ghost_x);
        ASSERT_EQ(ghosts_[0].count, ghost_ids.size());
        EXPECT_TRUE(
            std::equal(ghost_x.begin(), ghost_x.end(), static_cast<double*>(ghosts_[0].values)));
        EXPECT_TRUE(std::equal(ghost_ids.begin(), ghost_ids.end(),
                               static_cast<std::int64_t*>(ghosts_[1].values)));

        std::vector<double> sums(x_);
        std::vector<double> sums_in_c(x_);
        own_->accumulate(column(ghost_x, 2), column(sums, 2));
        const rrcb_column added =
            RRCB_COLUMN_INIT(RRCB_DOUBLE, 2, ghosts_[0].values, sums_in_c.data());
        ASSERT_EQ(rrcb_neighbours_accumulate(neighbours_, 1, &added), RRCB_OK) << rrcb_last_error();
        EXPECT_EQ(sums_in_c, sums);
    }
}

TEST_F(CNeighbours, add_shared_entries) {
    std::size_t count = 0;
    const int* ranks = nullptr;
    ASSERT_EQ(rrcb_neighbours_ranks(neighbours_, &count, &ranks), RRCB_OK);
    ASSERT_EQ(count, own_->ranks().size());
    EXPECT_TRUE(std::equal(ranks, ranks + count, own_->ranks().begin()));
    // The second of three entries is that of all neighbours.
    std::vector<rrcb_rank_count> shares;
    SharedEntries shared;
    for (const int other : own_->ranks()) {
        shares.push_back({other, 1});
        shared.ranks.push_back({other, 1});
        shared.indices.push_back(1);
    }
    rrcb_shared_entries given = RRCB_SHARED_ENTRIES_INIT;
    given.num_ranks = given.num_indices = count;
    given.ranks = shares.data();
    given.indices = shared.indices.data();
    std::vector<float> values{1, 0.1F * static_cast<float>(rank() + 1), 3};
    std::vector<float> expected = values;
    own_->sum(shared, expected);
    const rrcb_column summed = RRCB_COLUMN_INIT(RRCB_FLOAT, 1, nullptr, values.data());
    ASSERT_EQ(rrcb_neighbours_sum(neighbours_, &given, 3, 1, &summed), RRCB_OK)
        << rrcb_last_error();
    EXPECT_EQ(values, expected);
}

TEST_F(CNeighbours, refuse_room_below_the_count) {
    if (rank() == 0) columns_[0].capacity = columns_[0].count - 1;
    expect_error([&] { return migrate(); }, "capacity of array 0 (the first is 0) is below");
}

TEST_F(CNeighbours, refuse_an_array_given_twice) {
    columns_[1] = columns_[0];
    expect_error([&] { return migrate(); },
                 "array 1 (the first is 0) has the values of one before it");
}

TEST_F(CNeighbours, refuse_types_that_differ) {
    if (num_ranks() == 1) return;
    if (rank() == 0) columns_[1].type = RRCB_DOUBLE;
    expect_error([&] { return migrate(); }, "on rank ");
}

TEST_F(CNeighbours, refuse_no_type_and_bytes_to_add) {
    ASSERT_EQ(find(), RRCB_OK);
    ASSERT_EQ(fetch(), RRCB_OK) << rrcb_last_error();
    std::vector<double> sums(x_);
    const rrcb_column added =
        RRCB_COLUMN_INIT(rank() == 0 ? RRCB_BYTE : RRCB_DOUBLE, 2, ghosts_[0].values, sums.data());
    expect_error([&] { return rrcb_neighbours_accumulate(neighbours_, 1, &added); },
                 "RRCB_BYTE cannot be added");
}

TEST_F(CNeighbours, refuse_null_and_zeroed_arguments) {
    rrcb_neighbours* made = nullptr;
    const rrcb_neighbour_options none = RRCB_NEIGHBOUR_OPTIONS_INIT;
    EXPECT_EQ(rrcb_neighbours_create(balancer_, &none, &made), RRCB_INVALID_ARGUMENT);
    EXPECT_NE(std::string(rrcb_last_error()).find("cutoff and travel are both 0"),
              std::string::npos);
    EXPECT_EQ(rrcb_neighbours_create(balancer_, nullptr, &made), RRCB_INVALID_ARGUMENT);
    EXPECT_EQ(made, nullptr);
    EXPECT_EQ(rrcb_neighbours_migrate(nullptr, nullptr, 0, nullptr), RRCB_INVALID_ARGUMENT);
    if (rank() == num_ranks() - 1) columns_[1].type = rrcb_type{};
    expect_error([&] { return migrate(); }, "must be an rrcb_type");
}

TEST_F(CNeighbours, name_a_point_outside_of_the_box_and_lose_none) {
    if (rank() == 0) x_in_c()[0] = 1.7;
    expect_error([&] { return migrate(); }, "rank 0: point 0 (the first is 0)");
    std::int64_t sum = 0;
    for (const std::int64_t id : ids_in_c_) sum += id;
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_EQ(sum, 600 * 599 / 2);
}

}  // namespace
}  // namespace rrcb
