// A rank that leaves out a call, under RRCB_AGREE_SECONDS=1: the waiting ranks get an error that
// names it.
#include "ranks.hpp"

#include <rrcb/rrcb.hpp>

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace rrcb {
namespace {

using test::num_ranks;
using test::rank;

const std::vector<double> coordinates{0.1, 0.2, 0.3, 0.4};
const Points points = interleaved_points(coordinates, 2);
const std::vector<Part> parts{0, 0};

struct NamedCall {
    std::string name;
    std::function<void(MPI_Comm)> make;
};

/// The calls begin with messages of different kinds.
const std::vector<NamedCall> calls{
    {"balance", [](MPI_Comm comm) { balance(points, {}, comm); }},
    {"plan", [](MPI_Comm comm) { plan(parts, num_ranks(), comm); }},
    {"part_weights", [](MPI_Comm comm) { part_weights(points, parts, num_ranks(), comm); }},
};

std::string error_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::mpi);
        return error.what();
    }
    return "";
}

void expect_missing(int missing, const NamedCall& call, MPI_Comm comm) {
    SCOPED_TRACE("without " + call.name + " on rank " + std::to_string(missing));
    if (rank() != missing) {
        const std::string text = error_of([&] { call.make(comm); });
        EXPECT_EQ(text, "no call of " + call.name + " on ranks " + std::to_string(missing) +
                            " of " + std::to_string(num_ranks()) +
                            " within 1 s (RRCB_AGREE_SECONDS); every rank must make the same calls "
                            "in the same order; this communicator cannot be used further");
        EXPECT_EQ(error_of([&] { plan(parts, num_ranks(), comm); }), text);
    }
    MPI_Barrier(MPI_COMM_WORLD);
}

// The communicators stay: messages on them are pending.
MPI_Comm fresh() {
    MPI_Comm comm = MPI_COMM_NULL;
    MPI_Comm_dup(MPI_COMM_WORLD, &comm);
    return comm;
}

TEST(MissingCalls, are_named_on_the_ranks_that_wait_for_them) {
    for (const int i : {0, 1, 2}) {
        MPI_Comm comm = fresh();
        balance(points, {}, comm);
        expect_missing(i % 2, calls[static_cast<std::size_t>(i)], comm);
    }
}

TEST(MissingCalls, are_named_by_the_first_call_with_a_communicator) {
    expect_missing(1, calls[1], fresh());
}

TEST(MissingCalls, of_a_step_are_named_by_the_steps_that_follow) {
    Controller controller(MPI_COMM_WORLD);
    controller.step(1);
    // Rank 1 makes them too late. It would otherwise wait at the end of the controller.
    if (rank() == 1) std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    const std::string text = error_of([&] {
        for (int k = 0; k < 3; ++k) controller.step(1);
    });
    if (rank() != 1) {
        // Rank 1 does not forward messages of earlier steps either, so others may be late as well.
        EXPECT_EQ(text.find("no call of Controller::step on ranks "), 0u) << text;
    }
    EXPECT_NE(text, "");
    MPI_Barrier(MPI_COMM_WORLD);
}

// Late calls come after the roll call has begun, which is after 2.25 of 3 s.
TEST(LateCalls, are_waited_for_up_to_the_limit) {
    if (std::getenv("RRCB_AGREE_SECONDS") != std::string("3")) GTEST_SKIP() << "needs 3 s";
    const MPI_Comm comm = fresh();
    balance(points, {}, comm);
    for (const int late : {0, 1}) {
        MPI_Barrier(MPI_COMM_WORLD);
        std::this_thread::sleep_for(std::chrono::milliseconds(rank() == late ? 2400 : 0));
        EXPECT_EQ(error_of([&] { calls[static_cast<std::size_t>(late)].make(comm); }), "");
    }
}

}  // namespace
}  // namespace rrcb
