// Keys of overlapping groups, joined across ranks, compared with those of all points in one place.
#include "../support/ranks.hpp"
#include "../support/same_error.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/experimental/join_keys.h>
#include <rrcb/experimental/join_keys.hpp>
#include <rrcb/groups.hpp>
#include <rrcb/rrcb.h>

namespace rrcb {
namespace {

using Keys = std::vector<std::uint64_t>;

/// Returns the joined key of each point, by repeated passes over all of them.
Keys joined_in_one_place(const Keys& keys, std::size_t width) {
    std::map<std::uint64_t, std::uint64_t> labels;
    for (const std::uint64_t key : keys) labels[key] = key;
    labels[no_group] = no_group;
    for (bool changes = true; changes;) {
        changes = false;
        for (std::size_t i = 0; i < keys.size(); i += width) {
            std::uint64_t least = no_group;
            for (std::size_t k = i; k < i + width; ++k) least = std::min(least, labels[keys[k]]);
            for (std::size_t k = i; k < i + width; ++k) {
                if (keys[k] == no_group || labels[keys[k]] == least) continue;
                labels[keys[k]] = least;
                changes = true;
            }
        }
    }
    Keys joined;
    for (std::size_t i = 0; i < keys.size(); i += width) {
        std::uint64_t least = no_group;
        for (std::size_t k = i; k < i + width; ++k) least = std::min(least, labels[keys[k]]);
        joined.push_back(least);
    }
    return joined;
}

/// Returns the entries of the points of this rank, of `width` for each point.
Keys here(const Keys& all, std::size_t width, const std::vector<int>& homes) {
    Keys mine;
    for (std::size_t i = 0; i < homes.size(); ++i)
        if (homes[i] == rank())
            mine.insert(mine.end(), all.begin() + static_cast<std::ptrdiff_t>(i * width),
                        all.begin() + static_cast<std::ptrdiff_t>((i + 1) * width));
    return mine;
}

TEST(JoinedKeys, are_those_of_all_points_in_one_place) {
    std::mt19937_64 engine(3);
    for (int round = 0; round < 40; ++round) {
        const std::size_t width = 1 + engine() % 3;
        const std::size_t count = engine() % 60;
        const std::uint64_t num_keys = 1 + engine() % 80;
        Keys keys(count * width);
        for (std::uint64_t& key : keys)
            key = engine() % 3 == 0 ? no_group : engine() % num_keys * 0x123456789;
        std::vector<int> homes(count);
        for (int& home : homes)
            home = static_cast<int>(engine() % static_cast<unsigned>(num_ranks()));
        EXPECT_EQ(experimental::join_keys(here(keys, width, homes), width, MPI_COMM_WORLD),
                  here(joined_in_one_place(keys, width), 1, homes))
            << "round " << round;
    }
}

TEST(JoinedKeys, pass_along_a_chain_through_all_ranks) {
    // Rank r joins keys R - r and R - r - 1.
    const auto top = static_cast<std::uint64_t>(num_ranks() - rank());
    EXPECT_EQ(experimental::join_keys(Keys{top, top - 1}, 2, MPI_COMM_WORLD), Keys{0});
}

TEST(JoinedKeys, keep_cells_of_two_wells_with_both) {
    // Cells in a row; wells 1 and 2 share the third cell.
    const std::vector<double> x{0, 1, 2, 3, 4, 5, 6, 7};
    const Keys all{1, no_group, 1, no_group, 1,        2,        no_group, 2,
                   2, no_group, 7, 7,        no_group, no_group, 9,        no_group};
    std::vector<int> homes(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) homes[i] = static_cast<int>(i) * 3 % num_ranks();
    std::vector<double> mine;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (homes[i] == rank()) mine.push_back(x[i]);
    const Points points(mine, 1);
    const Keys joined = experimental::join_keys(here(all, 2, homes), 2, MPI_COMM_WORLD);
    const Groups wells = groups(points, joined, MPI_COMM_WORLD);
    Options options{.num_parts = 3};
    const Balance result = balance(wells.points(), MPI_COMM_WORLD, options);
    const std::vector<Part> parts = to_points(wells, result.parts, MPI_COMM_WORLD);
    std::vector<Part> of_all(x.size(), -1);
    for (std::size_t k = 0; k < mine.size(); ++k)
        of_all[static_cast<std::size_t>(mine[k])] = parts[k];
    MPI_Allreduce(MPI_IN_PLACE, of_all.data(), 8, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    EXPECT_EQ(std::set<Part>(of_all.begin(), of_all.begin() + 5).size(), 1U);

    Keys in_c(mine.size());
    rrcb_balancer* balancer = nullptr;
    ASSERT_EQ(rrcb_balancer_create(MPI_COMM_WORLD, &balancer), RRCB_OK);
    const Keys given = here(all, 2, homes);
    EXPECT_EQ(rrcb_join_keys(balancer, in_c.size(), 2, given.data(), in_c.data()), RRCB_OK);
    EXPECT_EQ(in_c, joined);
    EXPECT_EQ(rrcb_join_keys(balancer, 1, 2, nullptr, nullptr), RRCB_INVALID_ARGUMENT);
    rrcb_balancer_destroy(&balancer);
}

TEST(JoinedKeys, of_a_wrong_length_are_refused_on_all_ranks) {
    const Keys keys(is_last_rank() ? 3 : 4);
    test::expect_same_error([&] { (void)experimental::join_keys(keys, 2, MPI_COMM_WORLD); },
                            "keys_per_point");
    test::expect_same_error([&] { (void)experimental::join_keys({}, 0, MPI_COMM_WORLD); },
                            "keys_per_point");
}

}  // namespace
}  // namespace rrcb
