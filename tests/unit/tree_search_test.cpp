// Cuts found by the ranks that own them, against all points in one place.
#include "search/tree_search.hpp"

#include "../support/all_collected.hpp"
#include "../support/clouds.hpp"
#include "../support/virtual_owners.hpp"
#include "cuts/cut_limits.hpp"
#include "cuts/owned_cuts.hpp"
#include "options/allowed_axes.hpp"
#include "passes/host_passes.hpp"

#include <rrcb/plan.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numeric>
#include <random>
#include <string>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double share_of_longest = 0.9;

enum class Spread { sorted, scattered, on_few_ranks };

struct Case {
    int num_ranks = 4;
    int num_parts = 4;
    int dimension = 2;
    Spread spread = Spread::sorted;
    std::string cloud = "uniform";
    std::string weights = "equal";
    std::vector<double> part_sizes{};
    bool is_exact = true;
    bool plain_cuts = false;
    bool crosses_longest = true;
    std::size_t num_points = 600;
};

std::ostream& operator<<(std::ostream& out, const Case& one) {
    return out << one.num_ranks << " ranks, " << one.num_parts << " parts, " << one.dimension
               << "-D, " << one.cloud << ", weights " << one.weights << ", spread "
               << static_cast<int>(one.spread) << (one.is_exact ? ", exact" : "");
}

/// All points, and what the ranks make of them.
class Global {
  public:
    explicit Global(const Case& one) : case_(one), d_(static_cast<std::size_t>(one.dimension)) {
        make_points();
        spread();
    }

    std::size_t size() const { return coordinates_.size() / d_; }
    double x(std::size_t i, std::size_t a) const { return coordinates_[i * d_ + a]; }
    double weight(std::size_t i) const { return weights_.empty() ? 1 : weights_[i]; }

    test::SearchCounts run(double tolerance = 1) {
        PartTree tree;
        tree.dimension = case_.dimension;
        tree.box = box();
        tree.num_parts = case_.num_parts;
        tree.num_owners = case_.num_ranks;
        tree.rule.part_sizes = case_.part_sizes;
        tree.axes = first_axes(static_cast<int>(d_));
        tree.weight = total();
        tree.rule.weight_per_size =
            tree.weight / tree.rule.size_of(root_of(tree.num_parts, tree.shape));
        tree.rule.tolerance = tolerance;
        tree.rule.is_exact = case_.is_exact;
        tree.rule.common_weight = case_.weights == "equal" ? 1 : 0;
        tree.plain_cuts = case_.plain_cuts;
        tree.crosses_longest = case_.crosses_longest;
        for (int rank = 0; rank < case_.num_ranks; ++rank) add_search(tree, rank);
        const auto counts = test::run_searches(searches_);
        collect();
        return counts;
    }

    /// Moves all points to where their parts are, and searches anew.
    test::SearchCounts run_where_parts_lie(double tolerance) {
        for (auto& members : members_) members.clear();
        for (std::size_t i = 0; i < size(); ++i)
            members_[static_cast<std::size_t>(
                         ranks_of_part(parts_[i], case_.num_parts, case_.num_ranks).first_rank)]
                .push_back(i);
        searches_.clear();
        opened_.clear();
        passes_.clear();
        cuts_.clear();
        return run(tolerance);
    }

    /// Every cut divides as well as any could, and every point is in the part where cuts put it.
    void expect_best_cuts() const {
        std::vector<std::size_t> all(size());
        std::iota(all.begin(), all.end(), 0U);
        descend({0, 0, case_.num_parts}, all);
    }

    const std::vector<Part>& parts() const { return parts_; }

    double counted_imbalance() const {
        std::vector<double> weights(static_cast<std::size_t>(case_.num_parts));
        for (std::size_t i = 0; i < size(); ++i)
            weights[static_cast<std::size_t>(parts_[i])] += weight(i);
        double worst = 0;
        for (std::size_t p = 0; p < weights.size(); ++p)
            if (weights[p] > 0)
                worst = std::max(worst, weights[p] / total() / (size_of(p) / all_sizes()));
        return worst;
    }

    double told_imbalance() const {
        double worst = 0;
        for (const auto& search : searches_) worst = std::max(worst, search->imbalance());
        return worst;
    }

    int num_coincident() const {
        int sum = 0;
        for (const auto& search : searches_) sum += search->num_coincident();
        return sum;
    }

  private:
    double total() const {
        double sum = 0;
        for (std::size_t i = 0; i < size(); ++i) sum += weight(i);
        return sum;
    }
    double size_of(std::size_t p) const {
        return case_.part_sizes.empty() ? 1 : case_.part_sizes[p];
    }
    double all_sizes() const {
        return case_.part_sizes.empty()
                   ? case_.num_parts
                   : std::accumulate(case_.part_sizes.begin(), case_.part_sizes.end(), 0.0);
    }
    double sizes(const Descent& at) const {
        double sum = 0;
        for (int k = 0; k < at.num_parts; ++k)
            sum += size_of(static_cast<std::size_t>(at.first_part + k));
        return sum;
    }

    void make_points() {
        coordinates_ = test::uniform_cloud(case_.num_points, case_.dimension, 3);
        std::mt19937_64 random(5);
        for (double& x : coordinates_) {
            if (case_.cloud == "corner") x = x * x * x * 1e3;
            if (case_.cloud == "lattice") x = std::floor(x * 7);
            if (case_.cloud == "one place") x = 2.5;
            if (case_.cloud == "decades") x = std::pow(10, 60 * x - 30);
            if (case_.cloud == "next to 1" && x > 0.2) x = 1 + std::floor(x * 2e4) * 0x1p-52;
        }
        if (case_.cloud == "layer")
            for (std::size_t i = 0; i < coordinates_.size(); ++i)
                if (i % d_ == 0 && i % 200 != 0) coordinates_[i] *= 0.03;
        if (case_.cloud == "line")
            for (std::size_t i = 0; i < coordinates_.size(); ++i)
                if (i % d_ == 0) coordinates_[i] = 1;
        if (case_.weights == "equal") return;
        for (std::size_t i = 0; i < size(); ++i) {
            const double u = test::uniform(random);
            weights_.push_back(case_.weights == "decades" ? std::pow(10, 12 * u - 6)
                               : case_.weights == "some"  ? (i % 3 == 0 ? u : 0)
                                                          : 0.5 + u);
        }
    }

    Box box() const {
        Box box;
        for (std::size_t a = 0; a < d_; ++a)
            for (std::size_t i = 0; i < size(); ++i) {
                box.lower[a] = std::min(box.lower[a], x(i, a));
                box.upper[a] = std::max(box.upper[a], x(i, a));
            }
        return box;
    }

    /// By the definition of a cut, in words of its own.
    bool is_on_upper_side(std::size_t i, const Cut& cut) const {
        const auto axis = static_cast<std::size_t>(cut.axis);
        if (x(i, axis) < cut.at[axis]) return false;
        if (x(i, axis) > cut.at[axis]) return true;
        for (std::size_t a = 0; a < d_; ++a) {
            if (a == axis) continue;
            if (x(i, a) < cut.at[a]) return false;
            if (x(i, a) > cut.at[a]) return true;
        }
        return true;
    }

    std::pair<std::vector<std::size_t>, std::vector<std::size_t>> divided(
        const std::vector<std::size_t>& members, const Cut& cut) const {
        std::pair<std::vector<std::size_t>, std::vector<std::size_t>> halves;
        for (const std::size_t i : members)
            (is_on_upper_side(i, cut) ? halves.second : halves.first).push_back(i);
        return halves;
    }

    void spread() {
        std::vector<std::size_t> order(size());
        std::iota(order.begin(), order.end(), 0U);
        std::ranges::stable_sort(order, {}, [&](std::size_t i) { return x(i, 0); });
        const auto num = static_cast<std::size_t>(case_.num_ranks);
        members_.resize(num);
        for (std::size_t k = 0; k < size(); ++k) {
            const std::size_t rank = case_.spread == Spread::sorted      ? k * num / size()
                                     : case_.spread == Spread::scattered ? k % num
                                                                         : (k % 2) * (num - 1);
            members_[rank].push_back(order[k]);
        }
    }

    void add_search(const PartTree& tree, int rank) {
        const auto& mine = members_[static_cast<std::size_t>(rank)];
        std::vector<double> coordinates;
        std::vector<double> weights;
        for (const std::size_t i : mine) {
            for (std::size_t a = 0; a < d_; ++a) coordinates.push_back(x(i, a));
            if (!weights_.empty()) weights.push_back(weights_[i]);
        }
        const Points points(coordinates, case_.dimension, weights);
        HostPasses& passes = passes_.emplace_back(points, std::vector<Part>(mine.size(), -1));
        opened_.push_back(test::all_open(passes, tree.num_parts));
        searches_.push_back(std::make_unique<TreeSearch>(tree, rank, *opened_.back()));
    }

    /// Takes the cuts that a rank owns; it has zeros in place of the others.
    void collect_cuts(int rank) {
        const Cuts own = searches_[static_cast<std::size_t>(rank)]->own_cuts();
        for (std::size_t node = 0; node < own.tree.size(); ++node) {
            const Cut& cut = own.tree[node];
            if (owner_of(node_at(own, node), case_.num_parts, case_.num_ranks) == rank)
                cuts_[node] = cut;
            else
                EXPECT_TRUE(cut.axis == 0 && cut.divides == 0 && cut.at == Vector{}) << case_;
        }
    }

    void collect() {
        parts_.assign(size(), -1);
        for (std::size_t rank = 0; rank < members_.size(); ++rank) {
            opened_[rank]->settle();
            const std::span<const Part> parts = passes_[rank].parts_here();
            for (std::size_t k = 0; k < members_[rank].size(); ++k)
                parts_[members_[rank][k]] = parts[k];
            collect_cuts(static_cast<int>(rank));
        }
    }

    void descend(const Descent& at, const std::vector<std::size_t>& members) const {
        if (members.empty()) return;
        if (at.is_part()) {
            for (const std::size_t i : members) ASSERT_EQ(parts_[i], at.first_part) << case_;
            return;
        }
        ASSERT_TRUE(cuts_.contains(at.node)) << case_;
        const Cut& cut = cuts_.at(at.node);
        const auto [lower, upper] = divided(members, cut);
        expect_best(at, members, lower, cut);
        descend(at.lower(), lower);
        descend(at.upper(), upper);
    }

    void expect_best(const Descent& at, const std::vector<std::size_t>& members,
                     const std::vector<std::size_t>& lower, const Cut& cut) const {
        const auto sum = [&](const auto& some) {
            double result = 0;
            for (const std::size_t i : some) result += weight(i);
            return result;
        };
        const double all = sum(members);
        const double target = sizes(at) > 0 ? all * sizes(at.lower()) / sizes(at) : 0;
        if (!(target > 0) || !(target < all)) {
            EXPECT_TRUE(!(all > 0) || sum(lower) == target) << case_;
            return;
        }
        EXPECT_EQ(cut.axis, axis_of(members)) << case_;
        const double share = target / all;
        const Loss loss{num_empty(at, lower.size(), members.size()),
                        excess(sum(lower) / all, share)};
        const auto [least_empty, least_excess] = least_loss(at, members, share, cut.axis);
        EXPECT_EQ(loss.first, least_empty) << case_;
        EXPECT_LE(loss.second, least_excess * (1 + 1e-12)) << case_;
    }

    /// Parts of a node that a cut leaves empty although there are points for all, if they have one
    /// size, and then its excess.
    using Loss = std::pair<std::size_t, double>;

    std::size_t num_empty(const Descent& at, std::size_t below, std::size_t all) const {
        for (Part part = at.first_part; part < at.first_part + at.num_parts; ++part)
            if (size_of(static_cast<std::size_t>(part)) != sizes(at) / at.num_parts) return 0;
        const auto lacking = [](const Descent& side, std::size_t count) {
            const auto parts = static_cast<std::size_t>(side.num_parts);
            return parts > count ? parts - count : 0;
        };
        if (lacking(at, all) > 0) return 0;
        return lacking(at.lower(), below) + lacking(at.upper(), all - below);
    }

    int axis_of(const std::vector<std::size_t>& members) const {
        std::vector<double> extents;
        for (std::size_t a = 0; a < d_; ++a) {
            const auto [least, most] =
                std::ranges::minmax(members, {}, [&](std::size_t i) { return x(i, a); });
            extents.push_back(x(most, a) - x(least, a));
        }
        const double longest = *std::ranges::max_element(extents);
        int axis = 0;
        while (extents[static_cast<std::size_t>(axis)] < share_of_longest * longest) ++axis;
        return axis;
    }

    /// Weight of the side that has more of its own share, over that share.
    static double excess(double below, double share) {
        return std::max(below / share, (1 - below) / (1 - share));
    }

    /// The least that a cut across this axis may leave.
    Loss least_loss(const Descent& at, std::vector<std::size_t> members, double share,
                    int axis) const {
        const auto key = [&](std::size_t i) {
            std::vector<double> numbers{x(i, static_cast<std::size_t>(axis))};
            for (std::size_t a = 0; a < d_ && !case_.plain_cuts; ++a) numbers.push_back(x(i, a));
            return numbers;
        };
        std::ranges::sort(members, {}, key);
        double all = 0;
        for (const std::size_t i : members) all += weight(i);
        Loss least{num_empty(at, 0, members.size()), excess(0, share)};
        double below = 0;
        for (std::size_t k = 0; k < members.size(); ++k) {
            below += weight(members[k]);
            if (k + 1 < members.size() && key(members[k]) == key(members[k + 1])) continue;
            least = std::min(
                least, Loss{num_empty(at, k + 1, members.size()), excess(below / all, share)});
        }
        return least;
    }

    Case case_;
    std::size_t d_;
    std::vector<double> coordinates_;
    std::vector<double> weights_;
    std::vector<std::vector<std::size_t>> members_;  ///< points of each rank
    std::deque<HostPasses> passes_;
    std::vector<std::unique_ptr<OpenPoints>> opened_;
    std::vector<std::unique_ptr<TreeSearch>> searches_;
    std::vector<Part> parts_;
    std::map<std::size_t, Cut> cuts_;  ///< of all ranks
};

void expect_exact(const Case& one) {
    Global all(one);
    all.run();
    all.expect_best_cuts();
    EXPECT_NEAR(all.told_imbalance(), all.counted_imbalance(), 1e-12 * all.told_imbalance()) << one;
}

TEST(TreeSearch, cuts_exactly_on_any_number_of_ranks) {
    for (const int ranks : {2, 3, 4, 5, 6, 7, 9, 10, 12, 16})
        for (const Spread spread : {Spread::sorted, Spread::scattered, Spread::on_few_ranks})
            expect_exact({.num_ranks = ranks,
                          .num_parts = ranks,
                          .spread = spread,
                          .weights = ranks % 2 == 0 ? "equal" : "any"});
}

TEST(TreeSearch, makes_more_parts_than_ranks_and_fewer) {
    for (const int parts : {3, 5, 8, 13, 40, 64})
        for (const int ranks : {3, 4, 7, 10})
            for (const Spread spread : {Spread::sorted, Spread::scattered})
                expect_exact(
                    {.num_ranks = ranks, .num_parts = parts, .spread = spread, .weights = "any"});
}

TEST(TreeSearch, cuts_clouds_of_any_kind) {
    for (const int dimension : {1, 2, 3})
        for (const char* cloud : {"uniform", "corner", "lattice", "one place", "decades", "line"})
            for (const char* weights : {"equal", "any", "decades", "some"})
                for (const bool plain : {false, true})
                    expect_exact({.num_ranks = 7,
                                  .num_parts = 11,
                                  .dimension = dimension,
                                  .spread = Spread::scattered,
                                  .cloud = cloud,
                                  .weights = weights,
                                  .plain_cuts = plain});
}

TEST(TreeSearch, leaves_parts_of_no_size_empty) {
    for (const auto& sizes : std::vector<std::vector<double>>{{0, 1, 0, 0, 2, 3, 0.5, 0, 1},
                                                              {1, 0, 0, 0, 0, 0, 0, 0, 0},
                                                              {0, 0, 0, 0, 0, 0, 0, 0, 2},
                                                              {1, 2, 3, 4, 5, 6, 7, 8, 9}})
        for (const int ranks : {3, 9, 14})
            expect_exact({.num_ranks = ranks,
                          .num_parts = 9,
                          .spread = Spread::scattered,
                          .part_sizes = sizes});
}

TEST(TreeSearch, gathers_no_more_than_it_may_whatever_shares_a_coordinate) {
    // More points in one bin, and in one place, than are gathered: bins by bits, and ties.
    for (const char* cloud : {"decades", "lattice", "one place", "corner", "next to 1"})
        expect_exact({.num_ranks = 5,
                      .num_parts = 7,
                      .spread = Spread::scattered,
                      .cloud = cloud,
                      .weights = "any",
                      .num_points = 30000});
}

void expect_same_parts(Case one) {
    std::vector<std::vector<Part>> parts;
    for (const Spread spread : {Spread::sorted, Spread::scattered, Spread::on_few_ranks})
        for (const int ranks : {5, 8, 16}) {
            one.spread = spread;
            one.num_ranks = ranks;
            Global all(one);
            all.run();
            parts.push_back(all.parts());
        }
    for (const auto& other : parts) EXPECT_EQ(other, parts[0]) << one;
}

TEST(TreeSearch, gives_the_same_parts_wherever_points_lie) {
    for (const int dimension : {1, 2, 3}) {
        expect_same_parts({.num_parts = 12, .dimension = dimension, .weights = "any"});
        // Counts are whole numbers, so the axes that they choose do not depend on the ranks either.
        expect_same_parts({.num_parts = 12,
                           .dimension = dimension,
                           .cloud = "layer",
                           .crosses_longest = false,
                           .num_points = 6000});
    }
}

TEST(TreeSearch, counts_the_cuts_among_points_in_one_place) {
    Global all({.num_ranks = 4, .num_parts = 8, .cloud = "one place"});
    all.run();
    // All points are on one side of all cuts; each cut on the way to their part counts.
    EXPECT_EQ(all.num_coincident(), 3);
}

TEST(TreeSearch, keeps_to_a_tolerance_in_two_rounds_a_level) {
    for (const int ranks : {16, 64})
        for (const Spread spread : {Spread::sorted, Spread::scattered}) {
            Global all({.num_ranks = ranks,
                        .num_parts = ranks,
                        .spread = spread,
                        .is_exact = false,
                        .num_points = 64000});
            const auto counts = all.run(1.02);
            EXPECT_LE(all.counted_imbalance(), 1.02);
            EXPECT_EQ(all.told_imbalance(), all.counted_imbalance());
            const int levels = ranks == 16 ? 4 : 6;
            EXPECT_LE(counts.rounds, 3 * levels);
            RecordProperty("rounds_" + std::to_string(ranks), counts.rounds);
        }
}

TEST(TreeSearch, takes_few_points_in_one_round_a_level) {
    for (const int ranks : {2, 5, 16}) {
        const Case few{.num_ranks = ranks,
                       .num_parts = 16,
                       .dimension = 3,
                       .spread = Spread::scattered,
                       .num_points = 16};
        expect_exact(few);
        EXPECT_EQ(Global(few).run().rounds, 4);
    }
}

TEST(TreeSearch, sends_little_where_points_lie_in_their_parts) {
    for (const bool is_exact : {false, true}) {
        Global all({.num_ranks = 1000,
                    .num_parts = 1000,
                    .dimension = 3,
                    .spread = Spread::sorted,
                    .is_exact = is_exact,
                    .num_points = 16000});
        all.run(1.1);
        const auto counts = all.run_where_parts_lie(1.1);
        EXPECT_LE(counts.most_bytes_in, 18432U);
        EXPECT_LE(counts.rounds, is_exact ? 40 : 20) << "10 levels";
        RecordProperty("bytes", static_cast<int>(counts.most_bytes_in));
    }
}

}  // namespace
}  // namespace rrcb
