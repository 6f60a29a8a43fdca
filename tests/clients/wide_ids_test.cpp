// Compiled for ids of 64 bits, and linked with a Zoltan that says it has them. The plug-in was
// compiled for 32.
#include "program.hpp"

#include <gtest/gtest.h>

#include <set>

namespace rrcb::zoltan_test {
namespace {

static_assert(sizeof(ZOLTAN_ID_TYPE) == 8);

using Id = std::vector<ZOLTAN_ID_TYPE>;

constexpr ZOLTAN_ID_TYPE first_id = 0xabcdef0012345678;

struct WideProgram : Program {
    WideProgram(int gid, int lid) {
        scatter_points(*this, 300);
        first_id = zoltan_test::first_id;
        set("LB_METHOD", "RRCB");
        set("NUM_GID_ENTRIES", std::to_string(gid));
        set("NUM_LID_ENTRIES", std::to_string(lid));
    }

    Id global_id(int of_rank, int object) const {
        const ZOLTAN_ID_TYPE r = static_cast<ZOLTAN_ID_TYPE>(of_rank);
        const ZOLTAN_ID_TYPE o = static_cast<ZOLTAN_ID_TYPE>(object);
        if (gid_width == 1) return {first_id + 100000 * r + o};
        Id id = {first_id + o, first_id + r, first_id + 7 * o + r};
        id.resize(static_cast<std::size_t>(gid_width));
        return id;
    }

    Id local_id(int object) const {
        const ZOLTAN_ID_TYPE o = static_cast<ZOLTAN_ID_TYPE>(object);
        Id id = {first_id + o, first_id + 1000 + o};
        id.resize(static_cast<std::size_t>(lid_width));
        return id;
    }
};

/// Every entry is one object of the rank that holds it, in both ids, and none comes twice.
void expect_objects_of(const WideProgram& program, const ListCopy& list, bool held_here) {
    std::set<Id> seen;
    for (std::size_t i = 0; i < static_cast<std::size_t>(list.count); ++i) {
        const int holder = held_here ? program.rank : list.ranks[i];
        bool found = false;
        for (int object = 0; object < 300 && !found; ++object) {
            found = list.global_ids[i] == program.global_id(holder, object);
            if (found) {
                EXPECT_EQ(list.local_ids[i], program.local_id(object));
            }
        }
        EXPECT_TRUE(found) << i;
        EXPECT_TRUE(seen.insert(list.global_ids[i]).second);
    }
}

TEST(WideIds, arrive_whole_whatever_their_number) {
    for (int gid = 1; gid <= 3; ++gid) {
        for (int lid = 0; lid <= 2; ++lid) {
            SCOPED_TRACE(std::to_string(gid) + std::to_string(lid));
            WideProgram program(gid, lid);
            const Outcome outcome = program.partition();
            ASSERT_EQ(outcome.code, ZOLTAN_OK);
            EXPECT_EQ(outcome.exports.count > 0, program.num_ranks > 1);
            expect_objects_of(program, outcome.exports, true);
            expect_objects_of(program, outcome.imports, false);
            int balance = outcome.exports.count - outcome.imports.count;
            MPI_Allreduce(MPI_IN_PLACE, &balance, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
            EXPECT_EQ(balance, 0);
        }
    }
}

TEST(WideIds, arrive_whole_in_lists_of_parts) {
    WideProgram program(2, 1);
    program.set("RETURN_LISTS", "PARTS");
    const Outcome outcome = program.partition();
    ASSERT_EQ(outcome.exports.count, 300);
    expect_objects_of(program, outcome.exports, true);
}

}  // namespace
}  // namespace rrcb::zoltan_test
