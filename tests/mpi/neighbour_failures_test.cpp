// A call between neighbours that fails on a rank fails on all, each within as many calls as it is
// away; nobody hangs, no point is lost, and the next balance is right.
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/rrcb.hpp>

#include <cstdlib>

namespace rrcb {
namespace {

const MPI_Comm world = MPI_COMM_WORLD;

/// Ranks in a row: rank r has the points from r to r + 1.
class Row : public testing::Test {
  protected:
    /// Long rows exceed what MPI sends before the receiver asks for it.
    explicit Row(std::size_t words = 4000) : words_(words) {
        Options options{.num_parts = num_ranks()};
        std::vector<double> all;
        for (int i = 0; i < per_rank * num_ranks(); ++i) all.push_back((i + 0.5) / per_rank);
        cuts_ = balance(Points(all, 1), MPI_COMM_SELF, options).cuts;
        for (int i = 0; i < per_rank; ++i) {
            x_.push_back(rank() + (i + 0.5) / per_rank);
            ids_.push_back(rank() * per_rank + i);
        }
        load_.resize(per_rank * words_, 1.0);
        neighbours_.emplace(cuts_, world, NeighbourOptions{.cutoff = 0.3, .travel = 0.3});
    }

    void step() {
        neighbours_->migrate(column(x_), ids_, column(load_, words_));
        neighbours_->find_ghosts(column(x_));
        neighbours_->fetch(ghosts_of(ghosts_), column(load_, words_));
    }

    /// Makes steps until the Error; returns their number before, and the text.
    std::pair<int, std::string> steps_before_error(const std::function<void()>& make_step) {
        for (int k = 0; k < 3 * num_ranks() + 3; ++k) try {
                make_step();
            } catch (const Error& error) {
                return {k, error.what()};
            }
        return {-1, "no error"};
    }

    void expect_all_points() const {
        std::int64_t sums[2]{static_cast<std::int64_t>(ids_.size()),
                             std::accumulate(ids_.begin(), ids_.end(), std::int64_t{0})};
        MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_INT64_T, MPI_SUM, world);
        const std::int64_t n = per_rank * num_ranks();
        EXPECT_EQ(sums[0], n);
        EXPECT_EQ(sums[1], n * (n - 1) / 2);
        EXPECT_EQ(x_.size(), ids_.size());
        EXPECT_EQ(load_.size(), ids_.size() * words_);
    }

    static constexpr int per_rank = 10;
    std::size_t words_;
    Cuts cuts_;
    std::vector<double> x_;
    std::vector<std::int64_t> ids_;
    std::vector<double> load_;
    std::vector<double> ghosts_;
    std::optional<Neighbours> neighbours_;
};

TEST_F(Row, a_far_jump_reaches_all_ranks_one_after_the_other) {
    if (num_ranks() < 4) return;
    step();
    if (rank() == 0) x_[0] = num_ranks() - 0.5;
    const auto [number, text] = steps_before_error([&] { step(); });
    EXPECT_NE(text.find("rank 0: point 0 (the first is 0) at ("), std::string::npos) << text;
    EXPECT_NE(text.find("now belongs to rank " + std::to_string(num_ranks() - 1)),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("more travel"), std::string::npos) << text;
    // Rank r is r ranks away; a step has two calls with messages.
    EXPECT_EQ(number, rank() <= 1 ? 0 : (rank() - 1) / 2);
    expect_all_points();
    EXPECT_THROW(neighbours_->migrate(column(x_), ids_, column(load_, words_)), Error);

    const Balance next = balance(Points(x_, 1), world, {}, cuts_);
    const Plan moves = plan(next, world);
    std::tie(x_, ids_, load_) =
        transfer(moves, columns(column(x_), ids_, column(load_, words_)), world);
    neighbours_.emplace(next.cuts, world, NeighbourOptions{.cutoff = 0.3, .travel = 0.3});
    for (int k = 0; k < 3; ++k) step();
    expect_all_points();
}

TEST_F(Row, the_same_cuts_serve_again) {
    if (num_ranks() < 3) return;
    for (int repeat = 0; repeat < 3; ++repeat) {
        const double home = x_[0];
        const double away = num_ranks() - 0.5;
        if (rank() == 0) x_[0] = away;
        EXPECT_NE(steps_before_error([&] { step(); }).first, -1);
        if (rank() == 0) {
            EXPECT_EQ(x_[0], away);
            x_[0] = home;
        }
        neighbours_.emplace(cuts_, world, NeighbourOptions{.cutoff = 0.3, .travel = 0.3});
        step();
        expect_all_points();
    }
}

TEST_F(Row, other_columns_are_named) {
    if (num_ranks() < 2) return;
    const auto [number, text] = steps_before_error([&] {
        std::vector<float> single(x_.begin(), x_.end());
        std::vector<float> of_ghosts;
        neighbours_->find_ghosts(column(x_));
        if (rank() == 0)
            neighbours_->fetch(ghosts_of(of_ghosts), single);
        else
            neighbours_->fetch(ghosts_of(ghosts_), x_);
    });
    EXPECT_NE(number, -1);
    EXPECT_NE(text.find("column 0 (the first is 0) has 1 per point, floating-point numbers of "),
              std::string::npos)
        << text;
}

TEST_F(Row, an_array_given_twice_is_named) {
    const std::vector<double> before = x_;
    const auto expect_named = [&](const std::function<void()>& call) {
        const std::string text = steps_before_error(call).second;
        EXPECT_NE(text.find("columns 0 and 1 (the first is 0) are the same array"),
                  std::string::npos)
            << text;
        neighbours_.emplace(cuts_, world, NeighbourOptions{.cutoff = 0.3, .travel = 0.3});
    };
    expect_named([&] { neighbours_->migrate(column(x_), x_); });
    EXPECT_EQ(x_, before);
    expect_named([&] {
        neighbours_->find_ghosts(x_);
        neighbours_->fetch(ghosts_of(ghosts_, ghosts_), x_, x_);
    });
    expect_named([&] { neighbours_->sum(SharedEntries{}, x_, x_); });
}

TEST_F(Row, other_calls_are_named) {
    if (num_ranks() < 2) return;
    step();
    std::vector<double> sums(x_.size());
    std::vector<double> of_ghosts(ghosts_.size() / words_);
    const auto [number, text] = steps_before_error([&] {
        if (rank() == 0)
            neighbours_->fetch(ghosts_of(ghosts_), x_);
        else
            neighbours_->accumulate(of_ghosts, sums);
    });
    EXPECT_NE(number, -1);
    EXPECT_NE(text.find("Neighbours::fetch"), std::string::npos) << text;
    EXPECT_NE(text.find("Neighbours::accumulate"), std::string::npos) << text;
}

TEST_F(Row, a_balance_among_neighbour_calls_is_named) {
    if (num_ranks() < 2) return;
    step();
    const auto [number, text] = steps_before_error([&] {
        if (rank() == 0)
            balance(Points(x_, 1), world, {}, cuts_);
        else
            step();
    });
    EXPECT_NE(number, -1);
    EXPECT_NE(text.find("rank 0 calls balance, rank 1 calls Neighbours::migrate"),
              std::string::npos)
        << text;
    neighbours_.emplace(cuts_, world, NeighbourOptions{.cutoff = 0.3, .travel = 0.3});
    step();
    expect_all_points();
}

TEST_F(Row, a_rank_in_a_collective_call_hears_of_a_failure) {
    if (num_ranks() < 4) return;
    step();
    if (rank() == 0) x_[0] = num_ranks() - 0.5;
    std::string text;
    try {
        neighbours_->migrate(column(x_), ids_, column(load_, words_));
        balance(Points(x_, 1), world, {}, cuts_);
    } catch (const Error& error) {
        text = error.what();
    }
    EXPECT_NE(text.find("rank 0: point 0 (the first is 0) at ("), std::string::npos) << text;
    const Balance next = balance(Points(x_, 1), world, {}, cuts_);
    EXPECT_EQ(next.parts.size(), x_.size());
}

TEST_F(Row, entries_in_common_are_summed_in_one_order) {
    // Each rank has a node at either end of its part, and one of its own.
    SharedEntries shared;
    for (int other = std::max(0, rank() - 1); other < std::min(num_ranks(), rank() + 2); ++other) {
        if (other == rank()) continue;
        shared.ranks.push_back({other, 1});
        shared.indices.push_back(other < rank() ? 0 : 1);
    }
    std::vector<double> values{0.1 + rank(), 1e16, 3 + 0.7 * rank()};
    std::vector<int> counts{1, 1, 1};
    neighbours_->sum(shared, values, counts);
    EXPECT_EQ(values[0], rank() > 0 ? 1e16 + (0.1 + rank()) : 0.1);
    EXPECT_EQ(values[1], rank() + 1 < num_ranks() ? 1e16 + (1.1 + rank()) : 1e16);
    EXPECT_EQ(values[2], 3 + 0.7 * rank());
    EXPECT_EQ(counts, (std::vector<int>{rank() > 0 ? 2 : 1, rank() + 1 < num_ranks() ? 2 : 1, 1}));
}

}  // namespace
}  // namespace rrcb
