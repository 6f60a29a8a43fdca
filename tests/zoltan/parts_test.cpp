#include "program.hpp"
#include "regions.hpp"

namespace rrcb::zoltan_test {
namespace {

Outcome partition_with(Program& program, const char* method) {
    EXPECT_EQ(program.set("LB_METHOD", method), ZOLTAN_OK);
    program.set({{"RETURN_LISTS", "PARTS"}, {"REMAP", "0"}});
    return program.partition();
}

/// For every part and rank, whether objects of that part go to that rank.
std::vector<int> occupied(const Program& program, const Outcome& outcome, int num_parts) {
    std::vector<int> table(static_cast<std::size_t>(num_parts * program.num_ranks), 0);
    for (std::size_t i = 0; i < outcome.exports.parts.size(); ++i) {
        const int cell = outcome.exports.parts[i] * program.num_ranks + outcome.exports.ranks[i];
        table[static_cast<std::size_t>(cell)] = 1;
    }
    MPI_Allreduce(MPI_IN_PLACE, table.data(), static_cast<int>(table.size()), MPI_INT, MPI_MAX,
                  MPI_COMM_WORLD);
    return table;
}

TEST(Parts, lie_on_the_ranks_of_zoltan_for_any_number_of_them) {
    const int num_ranks = Program().num_ranks;
    for (int num_parts = 1; num_parts <= 2 * num_ranks + 1; ++num_parts) {
        SCOPED_TRACE(num_parts);
        Scattered program(2000);
        program.set({{"OBJ_WEIGHT_DIM", "1"}, {"NUM_GLOBAL_PARTS", std::to_string(num_parts)}});
        const Outcome zoltans = partition_with(program, "RCB");
        const Outcome ours = partition_with(program, "RRCB");
        EXPECT_EQ(ours.code, ZOLTAN_OK);
        EXPECT_EQ(ours.changes, zoltans.changes);
        EXPECT_EQ(occupied(program, ours, num_parts), occupied(program, zoltans, num_parts));
        EXPECT_LT(imbalance(program, ours, num_parts), 1.1);
    }
}

TEST(Parts, fewer_than_ranks_are_shared_evenly_by_their_ranks) {
    Program program;
    if (program.num_ranks < 4) GTEST_SKIP() << "needs two ranks per part";
    if (program.rank == 0) scatter_points(program, 4000);
    program.set("NUM_GLOBAL_PARTS", "2");
    const Outcome outcome = partition_with(program, "RRCB");
    std::vector<int> received(static_cast<std::size_t>(program.num_ranks), 0);
    for (std::size_t i = 0; i < outcome.exports.ranks.size(); ++i) {
        if (outcome.exports.parts[i] == 1)
            ++received[static_cast<std::size_t>(outcome.exports.ranks[i])];
    }
    MPI_Allreduce(MPI_IN_PLACE, received.data(), program.num_ranks, MPI_INT, MPI_SUM,
                  MPI_COMM_WORLD);
    EXPECT_EQ(received[0], 0);
    const int num_sharing = program.num_ranks / 2;
    const double share = 2000.0 / num_sharing;
    for (int r = program.num_ranks - num_sharing; r < program.num_ranks; ++r) {
        EXPECT_NEAR(received[static_cast<std::size_t>(r)], share, 0.15 * share) << r;
    }
}

TEST(Parts, asked_for_locally_lie_where_zoltan_puts_them) {
    const int num_ranks = Program().num_ranks;
    // Three parts on the last rank, none on the first unless it is alone, the rest not set.
    Scattered program(1000);
    const bool last = program.rank == num_ranks - 1;
    if (last) program.set("NUM_LOCAL_PARTS", "3");
    if (!last && program.rank == 0) program.set("NUM_LOCAL_PARTS", "0");
    const int num_free = std::max(0, num_ranks - 2);
    const int num_parts = 3 + 2 * num_free + (num_free > 0 ? 1 : 0);
    program.set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
    const Outcome zoltans = partition_with(program, "RCB");
    const Outcome ours = partition_with(program, "RRCB");
    EXPECT_EQ(ours.code, ZOLTAN_OK);
    EXPECT_EQ(occupied(program, ours, num_parts), occupied(program, zoltans, num_parts));
}

TEST(Parts, asked_for_locally_must_add_up) {
    Scattered program(10, {{"NUM_LOCAL_PARTS", "2"}});
    program.set("NUM_GLOBAL_PARTS", std::to_string(2 * program.num_ranks + 1));
    EXPECT_EQ(partition_with(program, "RRCB").code, ZOLTAN_FATAL);
    program.set("NUM_GLOBAL_PARTS", std::to_string(2 * program.num_ranks));
    EXPECT_EQ(partition_with(program, "RRCB").code, ZOLTAN_OK);
}

/// Code and highest part with both methods.
struct Asked {
    int code, most;
    bool operator==(const Asked&) const = default;
};

Asked ask_for_parts(const char* method, const std::function<void(Program&)>& set_parameters) {
    Scattered program(200);
    set_parameters(program);
    const Outcome outcome = partition_with(program, method);
    int most =
        outcome.exports.parts.empty() ? -1 : *std::ranges::max_element(outcome.exports.parts);
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return {outcome.code, most};
}

TEST(Parts, of_no_legal_number_are_as_many_as_zoltan_takes) {
    for (const char* value : {"0", "-1", "-7", "DEFAULT", "3 ", "2.7"}) {
        for (const auto& set_parameters : std::initializer_list<std::function<void(Program&)>>{
                 [&](Program& p) { p.set("NUM_GLOBAL_PARTS", value); },
                 [&](Program& p) { p.set("NUM_GLOBAL_PARTITIONS", value); },
                 [&](Program& p) {
                     p.set({{"NUM_GLOBAL_PARTS", "5"}, {"NUM_GLOBAL_PARTS", value}});
                 },
                 [&](Program& p) {
                     p.set({{"NUM_LOCAL_PARTS", "2"}, {"NUM_GLOBAL_PARTS", value}});
                 },
                 [&](Program& p) { p.set("NUM_GLOBAL_PARTS", p.rank == 0 ? value : "2"); }}) {
            EXPECT_EQ(ask_for_parts("RRCB", set_parameters), ask_for_parts("RCB", set_parameters))
                << value;
        }
    }
}

TEST(Parts, take_the_largest_number_that_any_rank_asks_for) {
    Scattered program(1000);
    if (program.rank == program.num_ranks - 1) program.set("NUM_GLOBAL_PARTS", "7");
    const Outcome ours = partition_with(program, "RRCB");
    EXPECT_EQ(ours.code, ZOLTAN_OK);
    int most = ours.exports.parts.empty() ? 0 : *std::ranges::max_element(ours.exports.parts);
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    EXPECT_EQ(most, 6);
}

/// Weight of part 0 over the weight of all parts.
double share_of_first_part(const Program& program, const Outcome& outcome) {
    std::array<double, 2> sums{};
    for (std::size_t i = 0; i < outcome.exports.parts.size(); ++i) {
        sums[1] += 1;
        if (outcome.exports.parts[i] == 0) sums[0] += 1;
    }
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_GT(sums[1], program.num_ranks);
    return sums[0] / sums[1];
}

TEST(Parts, get_the_sizes_that_were_set) {
    Scattered program(4000, {{"NUM_GLOBAL_PARTS", "4"}});
    int first_part = 0;
    float size = 3;
    // One rank asks; parts nobody speaks of have size 1, so part 0 is to get 3 of 6.
    if (program.rank == program.num_ranks - 1) {
        ASSERT_EQ(Zoltan_LB_Set_Part_Sizes(program.zz, 1, 1, &first_part, nullptr, &size),
                  ZOLTAN_OK);
    }
    EXPECT_NEAR(share_of_first_part(program, partition_with(program, "RRCB")), 0.5, 0.02);
    Zoltan_LB_Set_Part_Sizes(program.zz, 1, -1, nullptr, nullptr, nullptr);
    EXPECT_NEAR(share_of_first_part(program, partition_with(program, "RRCB")), 0.25, 0.02);
}

/// Which of three parts lies alone on its side of the first cut, across the longest axis: the one
/// that no cut bounds across the other.
int lone_part(const char* method) {
    Scattered program(3000);
    for (std::size_t i = 0; i < program.coordinates.size(); i += 2) program.coordinates[i] *= 1.2;
    program.set({{"NUM_GLOBAL_PARTS", "3"}, {"KEEP_CUTS", "1"}});
    partition_with(program, method);
    const auto is_alone = [&](int part) {
        const Region region = region_of(program.zz, part);
        return region.lower[1] == -DBL_MAX && region.upper[1] == DBL_MAX;
    };
    EXPECT_FALSE(is_alone(1));
    EXPECT_NE(is_alone(0), is_alone(2));
    return is_alone(0) ? 0 : 2;
}

TEST(Parts, of_an_odd_number_lie_above_by_one_more_where_zoltan_asks_the_ranks) {
    int num_ranks = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &num_ranks);
    EXPECT_EQ(lone_part("RRCB"), 0);
    EXPECT_EQ(lone_part("RCB"), num_ranks == 1 || num_ranks == 3 ? 2 : 0);
}

TEST(Parts, of_local_numbers_are_counted_from_the_first_one_of_the_rank) {
    Scattered program(4000);
    int first_part = 0;
    float size = program.rank == 0 ? 2.0F : 1.0F;
    program.set("NUM_GLOBAL_PARTS", std::to_string(2 * program.num_ranks));
    Zoltan_LB_Set_Part_Sizes(program.zz, 0, 1, &first_part, nullptr, &size);
    const double expected = 2.0 / (2 * program.num_ranks + 1);
    EXPECT_NEAR(share_of_first_part(program, partition_with(program, "RRCB")), expected, 0.02);
}

TEST(Parts, of_zero_size_stay_empty_and_not_all_may_be_zero) {
    Scattered program(500, {{"NUM_GLOBAL_PARTS", "2"}});
    std::array<int, 2> parts = {0, 1};
    std::array<float, 2> sizes = {0, 1};
    Zoltan_LB_Set_Part_Sizes(program.zz, 1, 2, parts.data(), nullptr, sizes.data());
    EXPECT_EQ(share_of_first_part(program, partition_with(program, "RRCB")), 0);
    sizes[1] = 0;
    Zoltan_LB_Set_Part_Sizes(program.zz, 1, -1, nullptr, nullptr, nullptr);
    Zoltan_LB_Set_Part_Sizes(program.zz, 1, 2, parts.data(), nullptr, sizes.data());
    EXPECT_EQ(partition_with(program, "RRCB").code, ZOLTAN_FATAL);
}

TEST(Parts, of_zero_size_hold_all_objects_where_there_is_one_part) {
    for (const char* method : {"RCB", "RRCB"}) {
        Scattered program(50, {{"NUM_GLOBAL_PARTS", "1"}});
        program.set_size(0, 0);
        const Outcome outcome = partition_with(program, method);
        EXPECT_EQ(outcome.code, ZOLTAN_OK) << method;
        EXPECT_EQ(outcome.exports.parts, std::vector<int>(50, 0)) << method;
    }
}

TEST(Parts, that_callbacks_name_decide_what_changes) {
    for (const char* word : {"EXPORT", "ALL", "PARTS"}) {
        SCOPED_TRACE(word);
        Program program(1);
        // Everything lies in its final part already: two coincident groups on every rank.
        for (int i = 0; i < 20; ++i) program.add({2.0 * program.rank + (i % 2)});
        ZOLTAN_PART_FN* part = [](void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR lid,
                                  int* code) {
            *code = ZOLTAN_OK;
            const auto& self = *static_cast<Program*>(data);
            return 2 * self.rank + static_cast<int>(*lid % 2);
        };
        Zoltan_Set_Part_Fn(program.zz, part, &program);
        program.set({{"NUM_GLOBAL_PARTS", std::to_string(2 * program.num_ranks)}, {"REMAP", "0"}});
        program.set({{"RETURN_LISTS", word}, {"LB_METHOD", "RCB"}});
        const Outcome zoltans = program.partition();
        program.set("LB_METHOD", "RRCB");
        const Outcome ours = program.partition();
        EXPECT_EQ(zoltans.changes, 0);
        EXPECT_EQ(ours.changes, 0);
        EXPECT_EQ(ours.imports.count, zoltans.imports.count);
        EXPECT_EQ(ours.exports.count, zoltans.exports.count);
    }
}

TEST(Balance, refuses_other_numbers_of_parts_than_ranks) {
    Scattered program(50);
    program.set(
        {{"LB_METHOD", "RRCB"}, {"NUM_GLOBAL_PARTS", std::to_string(program.num_ranks + 1)}});
    EXPECT_EQ(program.balance().code, ZOLTAN_FATAL);
    program.set("NUM_GLOBAL_PARTS", std::to_string(program.num_ranks));
    EXPECT_EQ(program.balance().code, ZOLTAN_OK);
}

}  // namespace
}  // namespace rrcb::zoltan_test
