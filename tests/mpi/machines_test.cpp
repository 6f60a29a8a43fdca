// Whole machines are cut off first. The machines are made up: this program answers
// MPI_Comm_split_type in place of the MPI library.
#include "clouds_of_all_ranks.hpp"

#include <rrcb/rrcb.hpp>

namespace rrcb {
namespace {

/// Machine of each rank of a communicator, by the rank and the number of ranks.
std::function<int(int, int)> machine_of = [](int, int) { return 0; };

/// Runs a test on a communicator of its own, for which the machines are found anew.
template <class Test>
void with_machines(std::function<int(int, int)> machine, Test&& test) {
    machine_of = std::move(machine);
    MPI_Comm comm = MPI_COMM_NULL;
    MPI_Comm_dup(MPI_COMM_WORLD, &comm);
    test(comm);
    MPI_Comm_free(&comm);
    machine_of = [](int, int) { return 0; };
}

auto blocks_of(int size) {
    return [size](int rank, int) { return rank / size; };
}

struct Cloud {
    std::vector<double> coordinates;
    Points points;

    explicit Cloud(int dimension, std::size_t count = 6000)
        : coordinates(
              test::share_of_cloud(count, dimension, [](std::size_t, int, double u) { return u; })),
          points(Points(coordinates, dimension)) {}
};

/// Options by which the machines give the shape of the tree.
const Options by_machines{.expert = {.tree = {.group_size = 0}}};

int group_size(std::function<int(int, int)> machine, const Options& options = by_machines) {
    const Cloud cloud(2);
    int size = 0;
    with_machines(std::move(machine), [&](MPI_Comm comm) {
        size = balance(cloud.points, comm, options).cuts.shape.group_size;
    });
    return size;
}

/// Whether machines of `size` ranks make another tree than halving.
bool matters(int size) {
    const int machines = (num_ranks() - 1) / size + 1;
    return machines > 1 && ((machines & (machines - 1)) != 0 || num_ranks() % size != 0);
}

TEST(Machines, are_the_groups_of_the_tree_where_halving_would_divide_them) {
    for (const int size : {1, 2, 3, 4, 5, 6})
        EXPECT_EQ(group_size(blocks_of(size)), matters(size) ? size : 1) << size;
}

TEST(Machines, count_several_parts_on_a_rank) {
    Options options{.num_parts = 3 * num_ranks(), .expert = {.tree = {.group_size = 0}}};
    for (const int size : {2, 3, 4})
        EXPECT_EQ(group_size(blocks_of(size), options), matters(size) ? 3 * size : 1) << size;
    options.num_parts = 3 * num_ranks() + 1;
    EXPECT_EQ(group_size(blocks_of(2), options), 1);
}

auto dealt_to(int machines) {
    return [machines](int rank, int) { return rank % machines; };
}

/// Whether all but the last of so many machines have as many ranks, and the last one fewer at most.
bool can_be_dealt(int machines) {
    return machines < num_ranks() && (num_ranks() + 1) % machines <= 1;
}

TEST(Machines, to_which_ranks_are_dealt_in_turn_have_the_parts_of_these_ranks) {
    const Cloud cloud(2);
    for (const int machines : {2, 3, 4, 5}) {
        if (!can_be_dealt(machines)) {
            EXPECT_EQ(group_size(dealt_to(machines)), 1) << machines;
            continue;
        }
        for (const int parts_each : {1, 3}) {
            SCOPED_TRACE(testing::Message() << machines << " machines, " << parts_each << " parts");
            Options options{.num_parts = parts_each * num_ranks(),
                            .expert = {.tree = {.group_size = 0}}};
            with_machines(dealt_to(machines), [&](MPI_Comm comm) {
                const Balance made = balance(cloud.points, comm, options);
                const int size = (num_ranks() - 1) / machines + 1;
                EXPECT_EQ(made.cuts.shape, (TreeShape{parts_each * size, false, parts_each}));
                std::vector<Part> parts(cloud.points.count);
                assign(made.cuts, cloud.points, parts);
                EXPECT_EQ(parts, made.parts);
                EXPECT_EQ(assign(made.cuts, cloud.points, comm), made.parts);
                EXPECT_EQ(part_weights(cloud.points, made.parts, options.num_parts, comm),
                          made.report.part_weights);
                EXPECT_EQ(balance(cloud.points, comm, options, made.cuts).parts, made.parts);
                // Points that lie where they should are kept.
                const auto mine = transfer(plan(made, comm), column(cloud.coordinates, 2), comm);
                const Balance again = balance(Points(mine, 2), comm, options);
                EXPECT_EQ(again.report.kept, parts_each == 1);
                if (parts_each > 1) return;
                EXPECT_EQ(again.parts, std::vector<Part>(mine.size() / 2, rank()));
                assign(again.cuts, Points(mine, 2), parts = again.parts);
                EXPECT_EQ(parts, again.parts);
                EXPECT_EQ(part_weights(cloud.points, made.parts, options.num_parts, comm),
                          again.report.part_weights);
            });
        }
    }
}

TEST(Machines, that_are_not_alike_are_not_looked_at) {
    if (num_ranks() < 4) return;
    EXPECT_EQ(group_size([](int rank, int) { return rank / 2 % 2; }), 1);
    EXPECT_EQ(group_size([](int rank, int) { return rank == 0 ? 0 : 1; }), 1);
    EXPECT_EQ(group_size([](int rank, int n) { return rank < n - 2 ? 2 - rank % 2 : 0; }), 1);
}

TEST(Machines, leave_the_default_tree_and_one_that_was_asked_for) {
    Options options;
    EXPECT_EQ(group_size(blocks_of(2), options), 1);
    options.expert.tree.group_size = 4;
    EXPECT_EQ(group_size(blocks_of(2), options), 4);
}

TEST(Machines, ask_for_the_shape_of_the_tree_that_given_axes_are_for) {
    if (!matters(2)) return;
    const Cloud cloud(2);
    Options options = by_machines;
    options.expert.axes.order =
        AxisOrder::given(std::vector<int>(static_cast<std::size_t>(num_ranks()) - 1, 0));
    with_machines(blocks_of(2), [&](MPI_Comm comm) {
        EXPECT_THROW(balance(cloud.points, comm, options), Error);
        options.expert.tree.group_size = 2;
        EXPECT_EQ(balance(cloud.points, comm, options).cuts.shape.group_size, 2);
    });
}

TEST(Machines, of_earlier_cuts_stay) {
    const Cloud cloud(2);
    Balance first;
    with_machines(blocks_of(2), [&](MPI_Comm comm) {
        first = balance(cloud.points, comm, by_machines);
        EXPECT_EQ(balance(cloud.points, comm, by_machines, first.cuts).parts, first.parts);
    });
    with_machines(blocks_of(3), [&](MPI_Comm comm) {
        EXPECT_EQ(balance(cloud.points, comm, by_machines, first.cuts).cuts.shape,
                  first.cuts.shape);
    });
}

/// Ghosts that come from other machines, of all ranks, and all ghosts.
std::pair<GlobalCount, GlobalCount> ghosts_of(const Balance& balance, const Cloud& cloud,
                                              MPI_Comm comm) {
    const int dimension = cloud.points.dimension;
    const auto mine = transfer(plan(balance, comm), column(cloud.coordinates, dimension), comm);
    const GhostPlan near =
        ghost_plan(balance.cuts, Points(mine, dimension), comm, {.cutoff = 0.02});
    GlobalCount counts[2] = {};
    for (const RankCount& from : near.receive) {
        if (machine_of(from.rank, num_ranks()) != machine_of(rank(), num_ranks()))
            counts[0] += static_cast<GlobalCount>(from.count);
        counts[1] += static_cast<GlobalCount>(from.count);
    }
    MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPI_INT64_T, MPI_SUM, comm);
    return {counts[0], counts[1]};
}

void expect_fewer_ghosts(std::function<int(int, int)> machine) {
    for (const int dimension : {2, 3}) {
        SCOPED_TRACE(dimension);
        const Cloud cloud(dimension, 24000);
        with_machines(machine, [&](MPI_Comm comm) {
            const Balance halved = balance(cloud.points, comm);
            const Balance grouped = balance(cloud.points, comm, by_machines);
            const auto [off, all] = ghosts_of(grouped, cloud, comm);
            const auto [off_halved, all_halved] = ghosts_of(halved, cloud, comm);
            EXPECT_LT(static_cast<double>(off), 0.9 * static_cast<double>(off_halved));
            EXPECT_LT(static_cast<double>(all), 1.15 * static_cast<double>(all_halved));
            EXPECT_LE(grouped.report.imbalance, 1.01);
        });
    }
}

TEST(Machines, make_the_same_parts_however_their_ranks_are_numbered) {
    for (const int size : {2, 3, 4}) {
        if (num_ranks() % size != 0 || num_ranks() == size) continue;
        SCOPED_TRACE(size);
        const Cloud cloud(3, 24000);
        std::array<std::pair<GlobalCount, GlobalCount>, 2> ghosts;
        with_machines(blocks_of(size), [&](MPI_Comm comm) {
            ghosts[0] = ghosts_of(balance(cloud.points, comm, by_machines), cloud, comm);
        });
        with_machines(dealt_to(num_ranks() / size), [&](MPI_Comm comm) {
            ghosts[1] = ghosts_of(balance(cloud.points, comm, by_machines), cloud, comm);
        });
        EXPECT_EQ(ghosts[0], ghosts[1]);
    }
}

TEST(Machines, send_each_other_fewer_ghosts_at_the_same_balance) {
    for (const int size : {2, 4}) {
        if (num_ranks() % size != 0) continue;
        SCOPED_TRACE(testing::Message() << size << " ranks a machine");
        if (matters(size)) expect_fewer_ghosts(blocks_of(size));
    }
}

}  // namespace
}  // namespace rrcb

extern "C" int MPI_Comm_split_type(MPI_Comm comm, int, int key, MPI_Info, MPI_Comm* made) {
    int rank = 0;
    int size = 0;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
    return PMPI_Comm_split(comm, rrcb::machine_of(rank, size), key, made);
}
