// Plans of ghosts that are used again make no collective call, and give the same.
#include "../support/clouds.hpp"
#include "../support/ranks.hpp"
#include "../support/same_error.hpp"
#include "mpi_layer.hpp"

#include <rrcb/rrcb.hpp>

namespace rrcb {
namespace {

const MPI_Comm world = MPI_COMM_WORLD;

class KeptPlans : public testing::Test {
  protected:
    KeptPlans() {
        const std::vector<double> all = test::uniform_cloud(400, 2, 3);
        Options options{.num_parts = num_ranks()};
        const Balance whole = balance(Points(all, 2), MPI_COMM_SELF, options);
        for (std::size_t i = 0; i < 400; ++i) {
            if (whole.parts[i] != rank()) continue;
            x_.insert(x_.end(), {all[2 * i], all[2 * i + 1]});
            ids_.push_back(static_cast<int>(i));
        }
        plan_ = ghost_plan(whole.cuts, Points(x_, 2), world,
                           {.cutoff = 0.1, .periodic = Box{{0, 0, 0}, {1, 1, 1}}});
    }

    static long collectives_of(const std::function<void()>& call) {
        mpi_layer::fail_call(0);
        call();
        return mpi_layer::counted_calls();
    }

    std::vector<double> x_;
    std::vector<int> ids_;
    GhostPlan plan_;
};

TEST_F(KeptPlans, make_no_collective_call_again) {
    const std::vector<double> first = fetch(plan_, column(x_, 2), world);
    const std::vector<double> sums(ids_.size(), 0.25);
    const std::vector<double> added(first.begin(), first.begin() + std::ssize(first) / 2);
    const std::vector<double> total = accumulate(plan_, added, sums, world);
    const std::vector<double> answers = reply(plan_, column(first, 2), world);
    for (int repeat = 0; repeat < 3; ++repeat) {
        TransferReport report;
        EXPECT_EQ(collectives_of([&] {
                      EXPECT_EQ(fetch(plan_, column(x_, 2), world, {.report = &report}), first);
                      EXPECT_EQ(accumulate(plan_, added, sums, world), total);
                      EXPECT_EQ(reply(plan_, column(first, 2), world), answers);
                  }),
                  0);
        EXPECT_EQ(report.num_messages > 0, num_ranks() > 1);
    }
    // Copies share the memory.
    const GhostPlan copy = plan_;
    EXPECT_EQ(collectives_of([&] { EXPECT_EQ(fetch(copy, column(x_, 2), world), first); }), 0);
}

TEST_F(KeptPlans, prove_other_columns_and_small_limits_again) {
    const std::vector<int> ids = fetch(plan_, ids_, world);
    EXPECT_GT(collectives_of([&] { static_cast<void>(fetch(plan_, column(x_, 2), world)); }), 0);
    for (int repeat = 0; repeat < 2; ++repeat) {
        TransferReport report;
        const auto again = [&] {
            EXPECT_EQ(fetch(plan_, ids_, world, {.max_bytes = 64, .report = &report}), ids);
        };
        EXPECT_EQ(collectives_of(again) > 0, num_ranks() > 1 || !ids.empty());
        EXPECT_LE(report.peak_bytes, 64U);
    }
}

TEST_F(KeptPlans, are_checked_again_after_a_transfer) {
    static_cast<void>(fetch(plan_, ids_, world));
    static_cast<void>(fetch(plan_, ids_, world));
    const std::vector<Part> parts(ids_.size(), (rank() + 1) % num_ranks());
    const Plan moves = plan(parts, num_ranks(), world);
    static_cast<void>(transfer(moves, ids_, world));
    if (num_ranks() == 1) return;
    test::expect_same_error([&] { static_cast<void>(fetch(plan_, ids_, world)); },
                            "the points were transferred since these ghosts were found");
}

TEST_F(KeptPlans, name_other_columns) {
    if (num_ranks() < 2) return;
    static_cast<void>(fetch(plan_, ids_, world));
    static_cast<void>(fetch(plan_, column(x_, 2), world));
    std::string text;
    for (int k = 0; k < 2 * num_ranks() && text.empty(); ++k) try {
            if (rank() == 0)
                static_cast<void>(fetch(plan_, ids_, world));
            else
                static_cast<void>(fetch(plan_, column(x_, 2), world));
        } catch (const Error& error) {
            text = error.what();
        }
    EXPECT_NE(text.find("column 0 (the first is 0) has "), std::string::npos) << text;
    EXPECT_EQ(fetch(plan_, ids_, world), fetch(plan_, ids_, world));
}

TEST_F(KeptPlans, name_columns_that_only_a_rank_has_not_used) {
    if (num_ranks() < 2) return;
    static_cast<void>(fetch(plan_, ids_, world));
    std::string text;
    for (int k = 0; k < 2 * num_ranks() && text.empty(); ++k) try {
            if (rank() == 0)
                static_cast<void>(fetch(plan_, column(x_, 2), world));
            else
                static_cast<void>(fetch(plan_, ids_, world));
        } catch (const Error& error) {
            text = error.what();
        }
    EXPECT_NE(text.find("fetch"), std::string::npos) << text;
    EXPECT_NE(text.find("fetch of known columns"), std::string::npos) << text;
    EXPECT_EQ(fetch(plan_, ids_, world), fetch(plan_, ids_, world));
}

}  // namespace
}  // namespace rrcb
