// A call between neighbours that fails on a rank fails on all, each within as many calls as it is
// away; nobody hangs, no point is lost, and the next balance is right.
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/rrcb.hpp>

#include <cstdlib>

namespace rrcb {
namespace {

const MPI_Comm world = MPI_COMM_WORLD;
constexpr auto not_here = static_cast<LocalIndex>(-1);

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

// Ranks r and r + 1 list the entries 10 r to 10 r + 9. Each holds and fills some of them.
TEST_F(Row, entries_that_are_zero_or_missing_are_not_sent) {
    const auto holds = [](int of_rank, int entry) { return (entry + of_rank + 1) % 4 != 0; };
    const auto value = [&](int of_rank, int entry) {
        return holds(of_rank, entry) && (entry + of_rank + 1) % 3 == 0 ? 11.0 + entry : 0.0;
    };
    std::vector<int> entries;
    for (int k = 10 * (rank() - 1); k < 10 * (rank() + 1); ++k)
        if (holds(rank(), k)) entries.push_back(k);
    SharedEntries shared;
    for (const int other : {rank() - 1, rank() + 1}) {
        if (other < 0 || other >= num_ranks()) continue;
        shared.ranks.push_back({other, 10});
        const int begin = 10 * std::min(rank(), other);
        for (int k = begin; k < begin + 10; ++k) {
            const auto found = std::ranges::find(entries, k);
            shared.indices.push_back(found == entries.end()
                                         ? not_here
                                         : static_cast<LocalIndex>(found - entries.begin()));
        }
    }
    std::vector<double> values;
    std::vector<std::vector<float>> fields(2);
    for (const int k : entries) {
        values.insert(values.end(), {value(rank(), k), 2 * value(rank(), k)});
        for (std::vector<float>& field : fields) field.push_back(k % 5 == 0 ? 1 : 0);
    }
    neighbours_->sum(shared, column(values, 2), fields);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const int other = entries[i] >= 10 * rank() ? rank() + 1 : rank() - 1;
        const bool is_shared = other >= 0 && other < num_ranks();
        const double sum = value(rank(), entries[i]) + (is_shared ? value(other, entries[i]) : 0.0);
        EXPECT_EQ(values[2 * i], sum);
        EXPECT_EQ(values[2 * i + 1], 2 * sum);
        const int times = is_shared && holds(other, entries[i]) ? 2 : 1;
        for (const std::vector<float>& field : fields)
            EXPECT_EQ(field[i], entries[i] % 5 == 0 ? static_cast<float>(times) : 0.0F);
    }
}

TEST_F(Row, lists_of_other_lengths_are_named) {
    if (num_ranks() < 2) return;
    SharedEntries shared;
    if (rank() < 2) shared = {{{1 - rank(), rank() == 0 ? 2U : 1U}}, {0}};
    if (rank() == 0) shared.indices.push_back(not_here);
    std::vector<double> values{1};
    const std::string text = steps_before_error([&] { neighbours_->sum(shared, values); }).second;
    EXPECT_TRUE(text.find("rank 1 shares 1 entries with rank 0, which lists 2") != text.npos ||
                text.find("rank 0 shares 2 entries with rank 1, which lists 1") != text.npos)
        << text;
}

TEST_F(Row, a_failure_of_the_caller_reaches_all_ranks) {
    step();
    const auto [number, text] = steps_before_error([&] {
        if (rank() == num_ranks() - 1) neighbours_->fail("the lid is open");
        step();
    });
    EXPECT_NE(number, -1);
    EXPECT_EQ(text, "rank " + std::to_string(num_ranks() - 1) + ": the lid is open");
    neighbours_.emplace(cuts_, world, NeighbourOptions{.cutoff = 0.3, .travel = 0.3});
    step();
    expect_all_points();
}

TEST_F(Row, columns_may_be_a_vector_of_vectors) {
    for (double& x : x_) x = std::min(x + 0.25, num_ranks() - 0.01);
    const std::vector<double> numbers(ids_.begin(), ids_.end());
    std::vector<std::vector<double>> columns{numbers, x_, numbers};
    const Points points(columns[1], 1);
    neighbours_->migrate(points, columns, ids_);
    ASSERT_EQ(columns[0].size(), ids_.size());
    for (std::size_t i = 0; i < ids_.size(); ++i) {
        EXPECT_EQ(columns[0][i], static_cast<double>(ids_[i]));
        EXPECT_EQ(columns[2][i], columns[0][i]);
    }
    x_ = columns[1];
    load_.resize(x_.size() * words_);
    expect_all_points();
    const int last = num_ranks() - 1;
    transfer_in_place(plan(std::vector<Part>(x_.size(), last), num_ranks(), world), world, columns);
    EXPECT_EQ(columns[2].size(),
              rank() == last ? static_cast<std::size_t>(per_rank * num_ranks()) : 0U);
}

}  // namespace
}  // namespace rrcb
