// The search for one cut as ranks and root run it, in one process: each rank counts its share of a
// cloud, their histograms are joined, and the root decides.
#include "search/cut_search.hpp"

#include "../support/all_collected.hpp"
#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "arithmetic/quantum.hpp"
#include "passes/histogram.hpp"

#include <bit>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Cloud {
    std::string name;
    int dimension;
    std::function<Vector(std::size_t i, std::mt19937_64& engine)> position;
};

/// What one rank holds.
struct Rank {
    std::vector<double> coordinates;
    std::vector<double> weights;
    Collected points{};
    Entries entries{};  ///< first all, then the candidates
};

struct Result {
    CutSearch search;
    int rounds = 0;
    std::vector<int> counts{};  ///< along each axis
    std::size_t most_gathered = 0;
};

/// A search over several ranks, in the order of `order` where they are joined.
class Search {
  public:
    Search(const Cloud& cloud, std::size_t count, std::size_t num_ranks, bool weighted)
        : ranks_(num_ranks), dimension_(cloud.dimension) {
        std::mt19937_64 engine(5);
        for (std::size_t i = 0; i < count; ++i) {
            const Vector x = cloud.position(i, engine);
            Rank& rank = ranks_[i % num_ranks];
            rank.coordinates.insert(rank.coordinates.end(), x.begin(), x.begin() + dimension_);
            if (weighted) rank.weights.push_back(std::pow(1e3, test::uniform(engine)) / 7);
        }
        for (Rank& rank : ranks_) {
            const Points points(rank.coordinates, dimension_, rank.weights);
            rank.points = test::all_collected(points);
        }
    }

    double total_weight() const {
        double weight = 0;
        for (const Rank& rank : ranks_)
            for (LocalIndex i = 0; i < rank.points.count(); ++i) weight += rank.points.weight(i);
        return weight;
    }

    /// Weight below the cut found, by looking at each point.
    double weight_below(const Cut& cut) const {
        double weight = 0;
        for (const Rank& rank : ranks_)
            for (LocalIndex i = 0; i < rank.points.count(); ++i)
                if (!is_above(cut, rank.points.position(i), dimension_))
                    weight += rank.points.weight(i);
        return weight;
    }

    Result run(double share, double slack, const CutSearch& start, bool backwards = false,
               bool divides = false) {
        Result result{start};
        result.counts.resize(max_dimension);
        CutSearch& search = result.search;
        search.num_axes = std::min<std::int32_t>(search.num_axes, dimension_);
        search.quantum = quantum_for(total_weight());
        CutTarget target;
        target.target = share * total_weight();
        target.slack = slack;
        target.divides = divides;
        for (Rank& rank : ranks_) {
            rank.entries.resize(rank.points.count());
            std::iota(rank.entries.begin(), rank.entries.end(), LocalIndex{0});
        }
        while (search.stage != CutSearch::done && result.rounds < 100) {
            const CutSearch before = search;
            if (before.stage == CutSearch::gathering) {
                const auto records = gather();
                result.most_gathered =
                    std::max(result.most_gathered, records.size() / (dimension_ + std::size_t{1}));
                decide_among(search, target, records, dimension_);
            } else {
                decide_by_bins(search, target, layout_, join(before, backwards));
                if (search.stage != CutSearch::done) keep_chosen(before, search.chosen);
                ++result.counts[before.tied];
            }
            ++result.rounds;
        }
        return result;
    }

  private:
    std::vector<double> gather() const {
        std::vector<double> all;
        for (const Rank& rank : ranks_)
            for (const LocalIndex i : rank.entries) {
                const Vector x = rank.points.position(i);
                all.insert(all.end(), x.begin(), x.begin() + dimension_);
                all.push_back(rank.points.weight(i));
            }
        return all;
    }

    void keep_chosen(const CutSearch& before, int slot) {
        const Bins bins = bins_of(before, layout_);
        for (Rank& rank : ranks_)
            rank.entries = between(slot == 0 ? -infinity : bins.edge(slot - 1),
                                   slot > layout_.num_bins ? infinity : bins.edge(slot),
                                   current_axis(before), rank.entries, rank.points);
    }

    std::vector<double> join(const CutSearch& search, bool backwards) const {
        std::vector<std::vector<double>> histograms;
        for (const Rank& rank : ranks_) {
            std::vector<double>& mine = histograms.emplace_back(layout_.length());
            clear_histogram(mine);
            count(rank.points, rank.entries, current_axis(search), bins_of(search, layout_),
                  layout_, mine);
            round_weights(search.quantum, layout_, sums_in(mine));
        }
        if (backwards) std::ranges::reverse(histograms);
        for (std::size_t r = 1; r < histograms.size(); ++r)
            join_histograms(histograms[r], histograms[0]);
        return histograms[0];
    }

    std::vector<Rank> ranks_;
    int dimension_;
    HistogramLayout layout_;
};

/// Over the whole of an axis, with or without ties broken along the others.
CutSearch across(int axis, double lower, double upper, int num_axes = 3) {
    CutSearch search;
    search.cut.axis = axis;
    search.cut.at.fill(-infinity);
    search.num_axes = num_axes;
    search.lower = lower;
    search.upper = upper;
    return search;
}

double signed_power(double base, double exponent, std::mt19937_64& engine) {
    const double sign = test::uniform(engine) < 0.5 ? -1 : 1;
    return sign * std::pow(base, exponent);
}

/// Decades in the order of doubles: half of the points of each bin, by width or by bits, lie in a
/// few of it.
const Cloud& uneven_in_all_bins() {
    static const Cloud cloud{
        "decades in the order of doubles", 2, [](std::size_t, std::mt19937_64& engine) {
            const double rank = std::exp2(62 * test::uniform(engine));
            return Vector{std::bit_cast<double>(static_cast<std::int64_t>(rank)),
                          test::uniform(engine)};
        }};
    return cloud;
}

/// Such as keep bins from dividing them, or are all ties.
const std::vector<Cloud>& hard_clouds() {
    using Engine = std::mt19937_64;
    static const std::vector<Cloud> clouds{
        {"uniform", 2,
         [](std::size_t, Engine& e) {
             return Vector{test::uniform(e), test::uniform(e)};
         }},
        {"300 decades", 1,
         [](std::size_t, Engine& e) { return Vector{std::pow(10, -300 * test::uniform(e))}; }},
        {"600 decades of both signs", 1,
         [](std::size_t, Engine& e) {
             return Vector{signed_power(10, test::uniform(e, -300, 300), e)};
         }},
        {"decades about one", 1,
         [](std::size_t, Engine& e) { return Vector{1 + std::pow(10, -15 * test::uniform(e))}; }},
        {"powers of powers", 1,
         [](std::size_t, Engine& e) {
             return Vector{std::exp2(-std::exp2(10 * test::uniform(e)))};
         }},
        {"layers", 3,
         [](std::size_t i, Engine& e) {
             return Vector{static_cast<double>(i % 3), test::uniform(e), test::uniform(e)};
         }},
        {"a plane of lines of decades", 3,
         [](std::size_t i, Engine& e) {
             return Vector{1.0, static_cast<double>(i % 5), std::pow(10, -300 * test::uniform(e))};
         }},
        {"few places", 2,
         [](std::size_t i, Engine&) {
             return Vector{static_cast<double>(i % 7), static_cast<double>(i % 3)};
         }},
        {"one place", 3,
         [](std::size_t, Engine&) {
             return Vector{0.1, 0.2, 0.3};
         }},
        {"whole range", 1,
         [](std::size_t, Engine& e) { return Vector{(2 * test::uniform(e) - 1) * 1.7e308}; }},
        {"subnormal", 2,
         [](std::size_t i, Engine&) {
             return Vector{5e-324 * static_cast<double>(i % 100), 5e-324 * static_cast<double>(i)};
         }},
        uneven_in_all_bins(),
    };
    return clouds;
}

TEST(CutSearch, counts_at_most_13_times_along_an_axis_and_gathers_few_whatever_the_cloud) {
    constexpr double largest = std::numeric_limits<double>::max();
    for (const Cloud& cloud : hard_clouds()) {
        Search search(cloud, 60000, 3, false);
        for (const double share : {0.5, 0.01, 0.73}) {
            const Result result = search.run(share, 0.5, across(0, -largest, infinity));
            ASSERT_EQ(result.search.stage, CutSearch::done) << cloud.name;
            EXPECT_LE(std::ranges::max(result.counts), 13) << cloud.name;
            EXPECT_LE(result.most_gathered, static_cast<std::size_t>(most_gathered)) << cloud.name;
            const double below = search.weight_below(result.search.cut);
            EXPECT_EQ(below, result.search.found_below) << cloud.name;
            // One place apart, only points that no cut tells apart may hold the target.
            if (result.search.coincident == 0) {
                EXPECT_NEAR(below, share * 60000, 0.5) << cloud.name;
            }
        }
    }
}

TEST(CutSearch, finds_a_cut_that_divides_its_lot_by_the_weight_missing) {
    const Cloud& few_places = hard_clouds()[7];
    Search search(few_places, 21000, 4, false);
    const Result result = search.run(0.5, 0.5, across(0, 0, 7), false, true);
    EXPECT_EQ(result.search.coincident, 1);
    EXPECT_EQ(result.search.found_below, search.weight_below(result.search.cut));
    EXPECT_GT(result.search.lot_below, 0);
    EXPECT_EQ(result.search.found_below + result.search.lot_below, 10500);
}

TEST(CutSearch, of_plain_cuts_keeps_a_plane_together_on_the_nearer_side) {
    const Cloud& layers = hard_clouds()[5];
    Search search(layers, 30000, 3, false);
    for (const auto& [share, below] : {std::pair{0.4, 10000.0}, std::pair{0.6, 20000.0}}) {
        const Result result = search.run(share, 0.5, across(0, 0, 3, 1));
        EXPECT_EQ(search.weight_below(result.search.cut), below);
        EXPECT_EQ(result.search.coincident, 1);
    }
}

TEST(CutSearch, of_weighted_points_ends_within_the_slack_or_the_heaviest_point) {
    for (const Cloud& cloud : hard_clouds()) {
        Search search(cloud, 20000, 5, true);
        const double total = search.total_weight();
        for (const double slack : {0.0, 0.01 * total}) {
            const Result result = search.run(0.3, slack, across(0, -1e307, infinity));
            const double below = search.weight_below(result.search.cut);
            EXPECT_NEAR(below, result.search.found_below, 1e-12 * total) << cloud.name;
            if (result.search.coincident != 0) continue;
            const double heaviest = 1e3 / 7;
            EXPECT_NEAR(below, 0.3 * total, std::max(slack, heaviest)) << cloud.name;
        }
    }
}

TEST(CutSearch, does_not_depend_on_the_order_in_which_ranks_are_joined) {
    for (const Cloud& cloud : hard_clouds()) {
        Search search(cloud, 20000, 7, true);
        const CutSearch start = across(0, -1e307, infinity);
        const Result forwards = search.run(0.37, 0, start);
        const Result backwards = search.run(0.37, 0, start, true);
        EXPECT_EQ(forwards.search.cut.at, backwards.search.cut.at) << cloud.name;
        EXPECT_EQ(forwards.search.found_below, backwards.search.found_below) << cloud.name;
        EXPECT_EQ(forwards.rounds, backwards.rounds) << cloud.name;
    }
}

TEST(Quantum, keeps_sums_of_rounded_weights_exact_in_any_order) {
    std::mt19937_64 engine(3);
    std::vector<double> weights(1000);
    for (double& weight : weights) weight = std::pow(10, test::uniform(engine, -8, 8));
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : weights) weight = rounded_to(quantum_for(total), weight);
    const double forwards = std::accumulate(weights.begin(), weights.end(), 0.0);
    const double backwards = std::accumulate(weights.rbegin(), weights.rend(), 0.0);
    EXPECT_EQ(forwards, backwards);
    EXPECT_NEAR(forwards, total, 1e-12 * total);
    for (const double weight : {1e-300, 1.0 / 3, 1e300})
        EXPECT_NEAR(rounded_to(quantum_for(weight), weight), weight, 0x1p-50 * weight);
    for (const double weight : {5e-324, 1e-310, 3.0, 0x1p49 + 1})
        EXPECT_EQ(rounded_to(quantum_for(weight), weight), weight);
}

}  // namespace
}  // namespace rrcb
