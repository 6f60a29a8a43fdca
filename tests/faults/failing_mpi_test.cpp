#include "mpi_layer.hpp"
#include "program.hpp"
#include "ranks.hpp"

#include <rrcb/paper.hpp>
#include <rrcb/rrcb.hpp>

#include <gtest/gtest.h>

#include <functional>

namespace rrcb {
namespace {

using zoltan_test::Outcome;
using zoltan_test::Program;

bool has_no_lists(const Outcome& outcome) {
    return outcome.changes == 0 && outcome.imports.count <= 0 && outcome.exports.count <= 0;
}

struct Cloud : Program {
    Cloud() { zoltan_test::scatter_points(*this, 200); }
    Points points() const { return Points(coordinates, dimension); }
};

/// Counts the calls of a run in which none fails, then fails each of them on all ranks.
void fail_each_call(const std::function<void()>& run, const std::function<void()>& expect) {
    run();  // what is done once for a communicator does not count
    mpi_layer::fail_call(0);
    run();
    const long num_calls = mpi_layer::counted_calls();
    ASSERT_GT(num_calls, 0);
    for (long call = 1; call <= num_calls; ++call) {
        SCOPED_TRACE(call);
        mpi_layer::fail_call(call);
        expect();
        mpi_layer::fail_call(0);
        run();
    }
}

void expect_one_code_and_no_lists(Cloud& cloud) {
    cloud.set("LB_METHOD", "RRCB");
    fail_each_call([&] { EXPECT_EQ(cloud.partition().code, ZOLTAN_OK); },
                   [&] {
                       const Outcome outcome = cloud.partition();
                       EXPECT_EQ(outcome.code, ZOLTAN_FATAL);
                       EXPECT_TRUE(test::same_on_all_ranks(outcome.code));
                       EXPECT_TRUE(has_no_lists(outcome));
                   });
}

TEST(FailingMpi, gives_all_ranks_one_code_and_no_lists_and_the_next_call_works) {
    for (const auto& [name, value] : {std::pair{"RRCB_REFINE", "NONE"},
                                      {"RRCB_REFINE", "TOLERANCE"},
                                      {"RRCB_REFINE", "EXACT"},
                                      {"RRCB_DOMAIN", "SAMPLED"},
                                      {"RRCB_DOMAIN", "POINTS"}}) {
        SCOPED_TRACE(value);
        Cloud cloud;
        cloud.set(name, value);
        expect_one_code_and_no_lists(cloud);
    }
}

TEST(FailingMpi, gives_no_lists_whichever_are_asked_for) {
    for (const char* lists : {"IMPORT", "EXPORT", "PARTS", "NONE"}) {
        SCOPED_TRACE(lists);
        Cloud cloud;
        cloud.set("RETURN_LISTS", lists);
        expect_one_code_and_no_lists(cloud);
    }
}

/// Each collective call of `run` fails on all ranks, which all throw an Error that names it.
void expect_errors(const std::function<void()>& run) {
    fail_each_call(run, [&] {
        try {
            run();
            ADD_FAILURE() << "nothing was thrown";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::mpi);
            EXPECT_NE(std::string(error.what()).find("MPI_"), std::string::npos);
        }
    });
}

TEST(FailingMpi, reaches_the_caller_of_balance_as_an_error_that_names_the_call) {
    const Cloud cloud;
    const Points points = cloud.points();
    expect_errors([&] { balance(points, MPI_COMM_WORLD); });
    const Cuts good = balance(points, MPI_COMM_WORLD).cuts;
    Cuts moved = good;
    for (Cut& cut : moved.tree) cut.at[static_cast<std::size_t>(cut.axis)] *= 0.9;
    for (const Cuts& previous : {good, moved})
        expect_errors([&] { balance(points, MPI_COMM_WORLD, Options{}, previous); });
}

TEST(FailingMpi, reaches_the_caller_of_a_method_of_the_paper) {
    const Cloud cloud;
    PaperOptions options;
    for (const PaperDomain domain : {PaperDomain::sampled, PaperDomain::points}) {
        options.domain = domain;
        expect_errors([&] { balance_as_in_paper(cloud.points(), MPI_COMM_WORLD, options); });
    }
}

TEST(FailingMpi, reaches_the_caller_of_what_follows_a_balance) {
    const Cloud cloud;
    const std::vector<Part> parts(cloud.points().count, (rank() + 1) % num_ranks());
    std::vector<RankRange> ranks;
    for (int rank = 0; rank < num_ranks(); ++rank) ranks.push_back({rank, 1});
    expect_errors([&] { plan(parts, num_ranks(), MPI_COMM_WORLD); });
    expect_errors([&] { remap(parts, ranks, MPI_COMM_WORLD); });
    expect_errors([&] { part_weights(cloud.points(), parts, num_ranks(), MPI_COMM_WORLD); });
    expect_errors([&] { moved_fraction(cloud.points(), parts, num_ranks(), MPI_COMM_WORLD); });
}

/// Every rank sends to every other one.
Plan plan_of_all_pairs() {
    std::vector<Part> parts(static_cast<std::size_t>(3 * num_ranks()));
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i] = static_cast<Part>(i) % num_ranks();
    return plan(parts, num_ranks(), MPI_COMM_WORLD);
}

TEST(FailingMpi, reaches_the_caller_of_what_moves_columns) {
    const Cloud cloud;
    const Plan lists = plan_of_all_pairs();
    const std::vector<int> values(lists.num_points);
    expect_errors([&] { transfer(lists, values, MPI_COMM_WORLD); });
    Cuts cuts = balance(cloud.points(), MPI_COMM_WORLD).cuts;
    cuts = unstamped(cuts);  // the points stay where they are
    expect_errors([&] { ghost_plan(cuts, cloud.points(), MPI_COMM_WORLD, {.cutoff = 0.1}); });
    const GhostPlan near = ghost_plan(cuts, cloud.points(), MPI_COMM_WORLD, {.cutoff = 0.1});
    const std::vector<int> colours(near.num_points);
    expect_errors([&] {
        near.kept.reset();
        fetch(near, colours, MPI_COMM_WORLD);
    });
}

/// Fails each message of a call on the last rank, one after the other; the call expects its result
/// itself. Of a failure in those that announce the others, which come first, all ranks hear.
void fail_each_message(const std::function<void()>& call) {
    mpi_layer::fail_message(0);
    call();
    long num_messages = mpi_layer::counted_messages();
    MPI_Bcast(&num_messages, 1, MPI_LONG, num_ranks() - 1, MPI_COMM_WORLD);
    const long num_announced = num_messages - 2 * (num_ranks() - 1);
    ASSERT_GE(num_announced, num_ranks() > 1 ? 2 : 0);
    for (long message = 1; message <= num_messages; ++message) {
        SCOPED_TRACE(message);
        mpi_layer::fail_message(is_last_rank() ? message : 0);
        bool threw = false;
        try {
            call();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::mpi) << error.what();
            threw = true;
        }
        EXPECT_EQ(threw, is_last_rank() || message <= num_announced);
        mpi_layer::fail_message(0);
        call();
    }
}

TEST(FailingMpi, of_one_message_of_a_column_leaves_no_rank_waiting_and_the_next_is_right) {
    const Plan lists = plan_of_all_pairs();
    const std::vector<int> values(lists.num_points, rank());
    const std::vector<int> expected = transfer(lists, values, MPI_COMM_WORLD);
    fail_each_message([&] { EXPECT_EQ(transfer(lists, values, MPI_COMM_WORLD), expected); });
}

TEST(FailingMpi, of_one_message_of_a_plan_leaves_no_rank_waiting_and_the_next_is_right) {
    const Plan expected = plan_of_all_pairs();
    fail_each_message(
        [&] { EXPECT_EQ(plan_of_all_pairs().import_indices, expected.import_indices); });
}

/// The error of a call of `balance` in which that message fails on that rank.
void expect_error_of(int rank, long message, const Points& points, const Options& options) {
    mpi_layer::fail_message(rank == test::rank() ? message : 0);
    try {
        balance(points, MPI_COMM_WORLD, options);
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::mpi);
        EXPECT_NE(std::string(error.what()).find("rank " + std::to_string(rank) + ": MPI_"),
                  std::string::npos)
            << error.what();
    }
}

/// Fails each message of each rank, in calls by these options, of which every `step`-th is tried.
void fail_each_message_of_each_rank(const Options& options, long step) {
    const Cloud cloud;
    const Points points = cloud.points();
    mpi_layer::fail_message(0);
    balance(points, MPI_COMM_WORLD, options);
    const long mine = mpi_layer::counted_messages();
    for (int rank = 0; rank < num_ranks(); ++rank) {
        long num_messages = mine;
        MPI_Bcast(&num_messages, 1, MPI_LONG, rank, MPI_COMM_WORLD);
        if (num_ranks() > 1) {
            EXPECT_GT(num_messages, 0);
        }
        for (long message = 1; message <= num_messages; message += step) {
            SCOPED_TRACE("rank " + std::to_string(rank) + ", message " + std::to_string(message));
            expect_error_of(rank, message, points, options);
            mpi_layer::fail_message(0);
            balance(points, MPI_COMM_WORLD, options);
        }
    }
}

TEST(FailingMpi, of_one_rank_while_cells_travel_reaches_the_callers_of_all) {
    fail_each_message_of_each_rank({}, 1);
}

/// Fails each message of each rank in a call, which then throws at least there: a failure after
/// which no message follows stays on its rank.
void expect_errors_where_messages_fail(const std::function<void()>& call) {
    mpi_layer::fail_message(0);
    call();
    const long mine = mpi_layer::counted_messages();
    for (int rank = 0; rank < num_ranks(); ++rank) {
        long num_messages = mine;
        MPI_Bcast(&num_messages, 1, MPI_LONG, rank, MPI_COMM_WORLD);
        for (long message = 1; message <= num_messages; ++message) {
            SCOPED_TRACE("rank " + std::to_string(rank) + ", message " + std::to_string(message));
            mpi_layer::fail_message(rank == test::rank() ? message : 0);
            try {
                call();
                EXPECT_NE(rank, test::rank());
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::mpi) << error.what();
            }
            mpi_layer::fail_message(0);
            call();
        }
    }
}

TEST(FailingMpi, of_one_rank_while_earlier_cuts_are_kept_reaches_its_caller) {
    const Cloud cloud;
    const Points points = cloud.points();
    const Cuts cuts = balance(points, MPI_COMM_WORLD).cuts;
    expect_errors_where_messages_fail(
        [&] { EXPECT_EQ(balance(points, MPI_COMM_WORLD, {}, cuts).report.details.rounds, 1); });
}

TEST(FailingMpi, of_one_rank_in_a_remap_or_look_up_reaches_its_caller) {
    const Cloud cloud;
    const Options options{.expert = {.max_root_parts = 2}};
    const Balance made = balance(cloud.points(), MPI_COMM_WORLD, options);
    std::vector<RankRange> ranks;
    for (int rank = 0; rank < num_ranks(); ++rank) ranks.push_back({rank, 1});
    expect_errors_where_messages_fail(
        [&] { EXPECT_EQ(remap(made.parts, ranks, MPI_COMM_WORLD).numbers.size(), ranks.size()); });
    if (num_ranks() > 4) return;
    expect_errors_where_messages_fail(
        [&] { EXPECT_EQ(assign(made.cuts, cloud.points(), MPI_COMM_WORLD), made.parts); });
}

/// Options by which many ranks make the parts.
Options wide() {
    Options options{.refine = Refine::exact, .expert = {.max_root_parts = 2}};
    return options;
}

TEST(FailingMpi, of_one_rank_while_many_make_the_parts_reaches_the_callers_of_all) {
    if (num_ranks() > 2) fail_each_message_of_each_rank(wide(), num_ranks() > 4 ? 37 : 1);
}

TEST(FailingMpi, of_all_ranks_while_many_make_the_parts_reaches_their_callers) {
    const Cloud cloud;
    expect_errors([&] { balance(cloud.points(), MPI_COMM_WORLD, wide()); });
}

TEST(FailingMpi, makes_zoltan_create_give_a_handle_that_refuses_rrcb) {
    // Only a communicator that returns errors lets the duplication fail.
    MPI_Comm comm = MPI_COMM_NULL;
    MPI_Comm_dup(MPI_COMM_WORLD, &comm);
    MPI_Comm_set_errhandler(comm, MPI_ERRORS_RETURN);
    mpi_layer::fail_call(0);
    Zoltan_Struct* zz = Zoltan_Create(comm);
    const long num_calls = mpi_layer::counted_calls();
    Zoltan_Destroy(&zz);
    mpi_layer::fail_call(num_calls);
    zz = Zoltan_Create(comm);
    mpi_layer::fail_call(0);
    Zoltan_Set_Param(zz, "DEBUG_LEVEL", "0");
    EXPECT_EQ(Zoltan_Set_Param(zz, "LB_METHOD", "RRCB"), ZOLTAN_FATAL);
    Zoltan_Destroy(&zz);
    MPI_Comm_free(&comm);
}

}  // namespace
}  // namespace rrcb
