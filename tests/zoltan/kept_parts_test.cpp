// Objects that each rank got from a partition which the handle does not know, or that moved a
// little since: they stay where they are well.
#include "moving.hpp"
#include "regions.hpp"

namespace rrcb::zoltan_test {
namespace {

void use_rrcb(Program& program, const char* refine, const char* remap) {
    program.set(
        {{"LB_METHOD", "RRCB"}, {"RRCB_REFINE", refine}, {"REMAP", remap}, {"KEEP_CUTS", "1"}});
}

/// The objects of another program, on a handle that knows of no earlier call.
struct Successor : Moving {
    explicit Successor(const Moving& earlier) : Moving(earlier.dimension) {
        coordinates = earlier.coordinates;
        weights = earlier.weights;
    }
};

/// Objects at rest, whatever the first calls gain.
void come_to_rest(Moving& program, const char* refine, const char* remap) {
    scatter_points(program, 1000);
    for (int call = 0; call < 3; ++call) {
        Successor next(program);
        use_rrcb(next, refine, remap);
        next.send(next.partition());
        program.coordinates = next.coordinates;
        program.weights = next.weights;
    }
}

void expect_look_ups_find_owners(const Program& program) {
    for (std::size_t i = 0; i < program.weights.size(); ++i)
        expect_found(program, i, program.rank, program.rank);
}

TEST(KeptParts, leave_objects_to_a_new_handle_where_an_old_one_sent_them) {
    for (const char* refine : {"NONE", "TOLERANCE"}) {
        for (const char* remap : {"0", "1"}) {
            SCOPED_TRACE(std::string(refine) + " " + remap);
            Moving program(2);
            come_to_rest(program, refine, remap);
            Successor next(program);
            use_rrcb(next, refine, remap);
            const Outcome outcome = next.partition();
            EXPECT_EQ(outcome.code, ZOLTAN_OK);
            EXPECT_EQ(outcome.changes, 0);
            EXPECT_EQ(outcome.exports.count, 0);
            expect_look_ups_find_owners(next);
        }
    }
}

TEST(KeptParts, of_objects_that_drift_are_found_by_look_ups) {
    Moving program(2);
    come_to_rest(program, "TOLERANCE", "1");
    use_rrcb(program, "TOLERANCE", "1");
    int num_kept = 0;
    for (int call = 0; call < 8; ++call) {
        for (std::size_t i = 0; i < program.coordinates.size(); i += 2)
            program.coordinates[i] += 1e-5 * program.coordinates[i + 1];
        const Outcome outcome = program.partition();
        EXPECT_EQ(outcome.code, ZOLTAN_OK);
        num_kept += outcome.changes == 0 ? 1 : 0;
        program.send(outcome);
        expect_look_ups_find_owners(program);
    }
    EXPECT_GT(num_kept, 0);
}

TEST(KeptParts, do_not_count_where_objects_are_named_other_parts) {
    Moving program(2);
    if (program.num_ranks == 1) GTEST_SKIP() << "needs two ranks";
    come_to_rest(program, "TOLERANCE", "0");
    Successor named(program);
    use_rrcb(named, "TOLERANCE", "0");
    named.tell_parts();
    // On one rank alone.
    if (named.rank == 0) std::ranges::fill(named.parts, 1);
    named.set("RETURN_LISTS", "PARTS");
    const Outcome outcome = named.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    EXPECT_EQ(outcome.changes, 1);
    EXPECT_LE(imbalance(named, outcome, named.num_ranks), 1.1);
}

TEST(KeptParts, do_not_count_where_a_rank_has_several) {
    Moving program(2);
    if (program.num_ranks == 1) GTEST_SKIP() << "needs two ranks";
    come_to_rest(program, "TOLERANCE", "0");
    Successor next(program);
    use_rrcb(next, "TOLERANCE", "0");
    next.set("NUM_LOCAL_PARTS", next.rank == 0 ? "2" : next.rank == 1 ? "0" : "1");
    next.set("RETURN_LISTS", "PARTS");
    const Outcome outcome = next.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    EXPECT_LE(imbalance(next, outcome, next.num_ranks), 1.1);
    for (std::size_t i = 0; i < outcome.exports.ranks.size(); ++i) {
        const int part = outcome.exports.parts[i];
        EXPECT_EQ(outcome.exports.ranks[i], part < 2 ? 0 : part);
    }
}

}  // namespace
}  // namespace rrcb::zoltan_test
