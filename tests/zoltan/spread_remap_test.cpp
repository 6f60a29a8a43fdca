// REMAP and objects that stay where many ranks make the parts, beside what one rank decides.
#include "moving.hpp"
#include "regions.hpp"
#include "same_lists.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace rrcb::zoltan_test {
namespace {

constexpr const char* by_one_rank = "1000000";

/// Objects on a line: ranks hold a stripe each, not that of their number, and some objects from
/// anywhere; one rank has none. Each part gets as many, so that the cuts lie between the same
/// objects whoever makes them.
struct Dealt : Moving {
    Dealt(int num_parts, const char* central, bool names_parts = false) : Moving(1) {
        std::mt19937 random(3);
        std::uniform_real_distribution<double> uniform(0, 1);
        const int count = num_parts * std::max(4, 1500 / num_parts);
        for (int i = 0; i < count; ++i) {
            const double x = uniform(random);
            const double y = i % 5 == 0 ? uniform(random) : x;
            int holder = (static_cast<int>(y * num_ranks) + num_ranks - 1) % num_ranks;
            if (holder == 1 && num_ranks > 2) holder = 2;
            if (holder == rank) add({x});
        }
        set("LB_METHOD", "RRCB");
        set("RRCB_REFINE", "EXACT");
        set("RRCB_COINCIDENT", "TOGETHER");
        set("RRCB_CENTRAL_PARTS", central);
        set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
        set("RETURN_LISTS", "ALL");
        if (!names_parts) return;
        tell_parts();
        for (int i = 0; i < size(); ++i)
            parts[static_cast<std::size_t>(i)] = (7 * rank + i / 3) % (num_parts + 2);
    }
};

/// Beyond 128 parts both ways are greedy.
TEST(SpreadRemap, gives_the_lists_of_numbers_that_one_rank_finds) {
    for (const int num_parts : {131, 160, 500}) {
        for (const bool names_parts : {false, true}) {
            for (const char* remap : {"0", "1"}) {
                SCOPED_TRACE(std::to_string(num_parts) + (names_parts ? " named" : ""));
                Dealt one(num_parts, by_one_rank, names_parts);
                one.set("REMAP", remap);
                const Outcome expected = one.partition();
                for (const char* central : {"2", "3", "4"}) {
                    Dealt many(num_parts, central, names_parts);
                    many.set("REMAP", remap);
                    const Outcome outcome = many.partition();
                    EXPECT_EQ(outcome.code, ZOLTAN_OK);
                    EXPECT_EQ(outcome.changes, expected.changes);
                    expect_same(outcome.exports, expected.exports);
                    expect_same(outcome.imports, expected.imports);
                }
            }
        }
    }
}

TEST(SpreadRemap, keeps_most_objects_of_one_part_each_on_their_ranks) {
    Dealt program(Program().num_ranks, "2");
    program.set("RETURN_LISTS", "PARTS");
    const Outcome outcome = program.partition();
    const auto stay = std::ranges::count(outcome.exports.ranks, program.rank);
    program.set("REMAP", "0");
    const Outcome without = program.partition();
    const auto stay_without = std::ranges::count(without.exports.ranks, program.rank);
    long counts[2] = {stay, stay_without};
    MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPI_LONG, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_GE(counts[0], counts[1] + (program.num_ranks < 3 ? 0 : 100));
}

TEST(SpreadRemap, leaves_objects_at_rest_that_were_sent_and_no_others) {
    for (const bool names_parts : {false, true}) {
        Moving probe(2);
        const int num_parts = names_parts ? 3 * probe.num_ranks : probe.num_ranks;
        Dealt program(num_parts, "2", names_parts);
        const Outcome first = program.partition();
        EXPECT_EQ(first.changes, program.num_ranks > 1 || names_parts);
        // Not at rest before they were sent.
        EXPECT_EQ(program.partition().changes, first.changes);
        program.send(first);
        EXPECT_LE(calls_until_rest(program, 3), 3);
        EXPECT_EQ(program.partition().changes, 0);
        // A weight that changes on one rank ends the rest of all.
        if (program.num_ranks == 1) continue;
        if (program.rank == 0 && program.size() > 0) std::ranges::fill(program.weights, 2.0F);
        program.set("RRCB_REFINE", "EXACT");
        EXPECT_EQ(program.partition().changes, 1);
    }
}

/// Every rank finds its objects by their new numbers.
void expect_found(Zoltan_Struct* zz, const Program& program, const std::vector<int>& parts) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
        double x = program.coordinates[i];
        int rank = -1, part = -1;
        ASSERT_EQ(Zoltan_LB_Point_PP_Assign(zz, &x, &rank, &part), ZOLTAN_OK);
        ASSERT_EQ(part, parts[i]);
        if (i % 10 != 0) continue;
        const Region region = region_of(zz, part);
        EXPECT_LE(region.lower[0], x);
        EXPECT_GE(region.upper[0], x);
    }
}

TEST(SpreadRemap, shows_new_numbers_to_look_ups) {
    for (const int num_parts : {Program().num_ranks, 150}) {
        Dealt program(num_parts, "2");
        program.set("RETURN_LISTS", "PARTS");
        program.set("KEEP_CUTS", "1");
        for (const char* refine : {"EXACT", "TOLERANCE"}) {
            program.set("RRCB_REFINE", refine);
            const std::vector<int> parts = parts_by_object(program.partition());
            expect_found(program.zz, program, parts);
            Zoltan_Struct* copy = Zoltan_Copy(program.zz);
            std::vector<char> bytes(Zoltan_Serialize_Size(copy));
            ASSERT_EQ(Zoltan_Serialize(copy, bytes.size(), bytes.data()), ZOLTAN_OK);
            expect_found(copy, program, parts);
            Zoltan_Destroy(&copy);
            Zoltan_Struct* unpacked = Zoltan_Create(MPI_COMM_WORLD);
            ASSERT_EQ(Zoltan_Deserialize(unpacked, bytes.size(), bytes.data()), ZOLTAN_OK);
            expect_found(unpacked, program, parts);
            Zoltan_Destroy(&unpacked);
        }
    }
}

TEST(SpreadRemap, shows_new_numbers_to_look_ups_that_are_asked_for_at_rest) {
    Dealt program(Program().num_ranks, "2");
    EXPECT_LE(calls_until_rest(program, 3), 3);
    program.set("KEEP_CUTS", "1");
    EXPECT_EQ(program.partition().changes, 0);
    expect_found(program.zz, program,
                 std::vector<int>(static_cast<std::size_t>(program.size()), program.rank));
}

TEST(SpreadRemap, fails_on_all_ranks_with_a_callback_on_one_and_works_in_the_next_call) {
    for (const bool names_parts : {false, true}) {
        Dealt program(140, "2", names_parts);
        const Outcome expected = program.partition();
        if (program.rank == program.num_ranks - 1)
            program.fault = [](const std::string& callback, int& code) {
                if (callback.find("GEOM") != std::string::npos) code = ZOLTAN_FATAL;
            };
        EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
        program.fault = {};
        const Outcome again = program.partition();
        EXPECT_EQ(again.code, ZOLTAN_OK);
        expect_same(again.exports, expected.exports);
    }
}

TEST(SpreadRemap, takes_callbacks_that_name_parts_on_some_ranks_only) {
    Dealt program(130, "2", Program().rank % 2 == 0);
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    int counts[2] = {outcome.imports.count, outcome.exports.count};
    MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_EQ(counts[0], counts[1]);
}

}  // namespace
}  // namespace rrcb::zoltan_test
