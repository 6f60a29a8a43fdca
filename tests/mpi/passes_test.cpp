// Balances of points that only passes read, against those of the same points in arrays.
#include "../support/brute_passes.hpp"
#include "../support/clouds.hpp"
#include "../support/ranks.hpp"

#include <rrcb/rrcb.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rrcb {
namespace {

using test::num_ranks;
using test::rank;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Cloud {
    Cloud(std::size_t count, int of_dimension, unsigned seed, bool is_lattice = false)
        : dimension(of_dimension),
          coordinates(
              test::uniform_cloud(count, of_dimension, 31 * seed + static_cast<unsigned>(rank()))) {
        if (is_lattice)
            for (double& x : coordinates) x = std::floor(12 * x);
    }

    Points points() const { return Points(coordinates, dimension, weights); }
    test::BrutePasses passes() const { return {coordinates, dimension, weights}; }

    int dimension;
    std::vector<double> coordinates;
    std::vector<double> weights{};
};

/// Both ways give the same, but for the rounding of sums of weights.
void expect_same(const Cloud& cloud, const Options& options, const Cuts& previous,
                 const std::string& what) {
    const Balance expected = balance(cloud.points(), MPI_COMM_WORLD, options, previous);
    test::BrutePasses passes = cloud.passes();
    const Balance made = balance(passes, MPI_COMM_WORLD, options, previous);
    EXPECT_TRUE(made.parts.empty());
    EXPECT_EQ(passes.parts(), expected.parts) << what;
    EXPECT_EQ(made.report.details.rounds, expected.report.details.rounds) << what;
    EXPECT_EQ(made.report.kept, expected.report.kept) << what;
    EXPECT_EQ(std::isnan(made.report.imbalance), std::isnan(expected.report.imbalance)) << what;
    if (!std::isnan(made.report.imbalance)) {
        EXPECT_NEAR(made.report.imbalance, expected.report.imbalance, 1e-12) << what;
    }
    ASSERT_EQ(made.cuts.tree.size(), expected.cuts.tree.size());
    for (std::size_t k = 0; k < made.cuts.tree.size(); ++k)
        EXPECT_EQ(made.cuts.tree[k].at, expected.cuts.tree[k].at) << what << " cut " << k;
}

std::vector<Options> kinds(int num_parts, int dimension = 2) {
    std::vector<Options> kinds(7);
    for (Options& one : kinds) one.num_parts = num_parts;
    kinds[1].refine = Refine::exact;
    kinds[2].refine = Refine::none;
    kinds[3].imbalance_tolerance = 1.0005;
    kinds[4].refine = Refine::exact;
    kinds[4].expert.coincident = Coincident::divide;
    kinds[5].expert.axes.min_width.assign(static_cast<std::size_t>(dimension), 0.02);
    kinds[5].expert.coincident = Coincident::divide;
    kinds[5].imbalance_tolerance = 1.0001;
    kinds[6].imbalance_tolerance = 1;
    kinds[6].expert.coincident = Coincident::divide;
    return kinds;
}

TEST(Passes, give_the_parts_and_the_bits_of_arrays) {
    for (const int dimension : {1, 2, 3})
        for (const bool is_lattice : {false, true})
            for (const int num_parts : {1, 5, 16}) {
                const Cloud cloud(700, dimension, 3, is_lattice);
                int number = 0;
                for (const Options& options : kinds(num_parts, dimension))
                    expect_same(cloud, options, {},
                                std::to_string(dimension) + "-D, kind " + std::to_string(number++) +
                                    ", parts " + std::to_string(num_parts));
            }
}

TEST(Passes, start_from_earlier_cuts_and_weigh) {
    Cloud cloud(900, 2, 5);
    const Balance first = balance(cloud.points(), MPI_COMM_WORLD);
    expect_same(cloud, {}, first.cuts, "kept");
    std::mt19937_64 engine(7);
    for (std::size_t i = 0; i < 900; ++i) cloud.weights.push_back(static_cast<double>(1 + i % 7));
    for (double& x : cloud.coordinates) x = x * x;
    int number = 0;
    for (Options options : kinds(num_ranks())) {
        expect_same(cloud, options, {}, "weighted, kind " + std::to_string(number));
        expect_same(cloud, options, first.cuts, "moved, kind " + std::to_string(number++));
    }
    for (double& weight : cloud.weights) weight = 0.3;
    expect_same(cloud, {}, {}, "equal weights");
}

TEST(Passes, may_have_no_points) {
    Cloud cloud(rank() == 0 ? 500 : 0, 2, 5);
    for (const Options& options : kinds(4)) expect_same(cloud, options, {}, "on one rank");
    const Cloud none(0, 2, 5);
    expect_same(none, {}, {}, "nowhere");
}

std::string error_of(test::BrutePasses& passes, const Options& options) {
    try {
        balance(passes, MPI_COMM_WORLD, options);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Passes, that_fail_on_one_rank_fail_on_all) {
    Cloud cloud(100, 2, 5);
    if (rank() == num_ranks() - 1) cloud.coordinates[7] = nan;
    test::BrutePasses passes = cloud.passes();
    EXPECT_NE(error_of(passes, {}).find("coordinate of point 3"), std::string::npos);
    EXPECT_NE(error_of(passes, {}).find("rank " + std::to_string(num_ranks() - 1)),
              std::string::npos);
}

/// Passes that answer with one entry too few, or too many, in one function on the last rank.
class ShortPasses : public test::BrutePasses {
  public:
    ShortPasses(const test::BrutePasses& right, std::string function, int surplus)
        : BrutePasses(right), function_(std::move(function)), surplus_(surplus) {}

    PointSummary summary(bool reads_positions) override {
        PointSummary summary = BrutePasses::summary(reads_positions);
        if (fails("summary")) summary.count += static_cast<LocalIndex>(surplus_);
        return summary;
    }
    PointSample sample(LocalIndex size) override {
        PointSample sample = BrutePasses::sample(size);
        change("sample", sample.positions);
        change("sample weights", sample.weights);
        return sample;
    }
    std::vector<CellMoments> moments(const SupportMesh& mesh) override {
        return changed("moments", BrutePasses::moments(mesh));
    }
    PartTotals assign(const Cuts& cuts, bool counts) override {
        PartTotals totals = BrutePasses::assign(cuts, counts);
        if (!counts) return totals;
        change("assign", totals.weights);
        change("assign counts", totals.counts);
        return totals;
    }
    void collect(const Cuts& cuts, std::span<const Bracket> intervals, bool has_parts,
                 Collected& collected) override {
        BrutePasses::collect(cuts, intervals, has_parts, collected);
        change("collect", collected.coordinates);
        change("collect weights", collected.weights);
        change("collect totals", collected.settled.weights);
        change("collect counts", collected.settled.counts);
        if (fails("collect dimension")) collected.dimension += surplus_;
    }
    std::vector<std::size_t> collect_more(std::span<const Wanted> wanted,
                                          Collected& collected) override {
        auto nodes = changed("collect_more", BrutePasses::collect_more(wanted, collected));
        if (fails("collect_more nodes"))
            for (std::size_t& node : nodes) node = wanted.size();
        change("collect_more totals", collected.settled.counts);
        return nodes;
    }
    std::vector<Box> boxes(int num_parts) override {
        return changed("boxes", BrutePasses::boxes(num_parts));
    }
    std::vector<Part> parts() const override { return changed("parts", BrutePasses::parts()); }

    /// Returns true if the answer was wrong on this rank.
    bool has_failed() const { return has_failed_; }

  private:
    bool fails(const std::string& function) const {
        const bool fails = function == function_ && rank() == num_ranks() - 1;
        has_failed_ = has_failed_ || fails;
        return fails;
    }
    template <class Values>
    void change(const std::string& function, Values& values) const {
        if (values.empty() || !fails(function)) return;
        values.resize(values.size() + static_cast<std::size_t>(surplus_));
    }
    template <class Values>
    Values changed(const std::string& function, Values values) const {
        change(function, values);
        return values;
    }

    std::string function_;
    int surplus_;
    mutable bool has_failed_ = false;
};

/// Counts the wrong answers of a function; each must be an error on all ranks that names it.
int num_refused(const std::string& function, int surplus, bool is_lattice) {
    int num_failed = 0;
    Cloud cloud(900, 2, 5, is_lattice);
    Cloud moved = cloud;
    for (double& x : moved.coordinates) x = x * x;
    for (std::size_t i = 0; i < 900; ++i) moved.weights.push_back(static_cast<double>(1 + i % 7));
    for (const Options& options : kinds(std::max(2, num_ranks()))) {
        const Cuts earlier = balance(cloud.points(), MPI_COMM_WORLD, options).cuts;
        for (const Cuts& previous : {Cuts{}, earlier}) {
            ShortPasses passes(moved.passes(), function, surplus);
            std::string text;
            try {
                balance(passes, MPI_COMM_WORLD, options, previous);
            } catch (const Error& error) {
                text = error.what();
            }
            const std::string name = function.substr(0, function.find(' ')) + "()";
            int has_failed = passes.has_failed() ? 1 : 0;
            MPI_Allreduce(MPI_IN_PLACE, &has_failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
            EXPECT_EQ(text.find("PointPasses::" + name) != std::string::npos, has_failed != 0)
                << function << ": " << text;
            num_failed += has_failed;
        }
    }
    return num_failed;
}

TEST(Passes, that_answer_with_other_lengths_are_refused_on_all_ranks) {
    for (const char* function :
         {"summary", "sample", "sample weights", "moments", "assign", "assign counts", "collect",
          "collect weights", "collect totals", "collect counts", "collect dimension",
          "collect_more", "collect_more nodes", "collect_more totals", "boxes", "parts"})
        for (const int surplus : {-1, 1}) {
            const int num =
                num_refused(function, surplus, false) + num_refused(function, surplus, true);
            // More points leave no gap that is open, for which boxes are needed.
            const int least = function == std::string("boxes") && num_ranks() > 2 ? 0 : 1;
            EXPECT_GE(num, least) << function;
        }
}

TEST(Passes, are_divided_by_many_ranks_too) {
    Cloud cloud(700, 2, 5);
    for (std::size_t i = 0; i < 700; ++i) cloud.weights.push_back(static_cast<double>(1 + i % 7));
    for (Options& options : kinds(9)) {
        options.expert.max_root_parts = 2;
        expect_same(cloud, options, {}, "many ranks");
    }
}

}  // namespace
}  // namespace rrcb
