// How good the cuts are that the statistics alone give, before any is moved: points of many ranks
// in one process, whose contributions merge up the tree that so many ranks have.
#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "collective/merge_tree.hpp"
#include "estimate/contribution.hpp"
#include "options/validation.hpp"
#include "passes/host_passes.hpp"

#include <rrcb/detail/bisection.hpp>
#include <rrcb/quality.hpp>

#include <numbers>

namespace rrcb {
namespace {

using Engine = std::mt19937_64;

struct Cloud {
    const char* name;
    Vector (*point)(Engine&);
};

Vector square(Engine& engine) {
    const double x = test::uniform(engine);
    return {x, test::uniform(engine), 0};
}

Vector polar(double radius, Engine& engine) {
    const double angle = 2 * std::numbers::pi * test::uniform(engine);
    return {radius * std::cos(angle), radius * std::sin(angle), 0};
}

constexpr Cloud disk{
    "disk", [](Engine& engine) { return polar(std::sqrt(test::uniform(engine)), engine); }};
constexpr Cloud ring{"ring",
                     [](Engine& engine) { return polar(1 + 0.2 * test::uniform(engine), engine); }};
constexpr Cloud normal{"normal", [](Engine& engine) {
                           return polar(std::sqrt(-2 * std::log(1 - test::uniform(engine))),
                                        engine);
                       }};
constexpr Cloud triangle{"triangle", [](Engine& engine) {
                             const Vector x = square(engine);
                             return x[0] + x[1] < 1 ? x : Vector{1 - x[0], 1 - x[1], 0};
                         }};
constexpr Cloud slope{"slope", [](Engine& engine) {
                          Vector x = square(engine);
                          while (x[1] > 0.4 && x[1] > 1.2 - 1.5 * x[0]) x = square(engine);
                          return x;
                      }};
constexpr Cloud cubed{"cubed", [](Engine& engine) {
                          const Vector x = square(engine);
                          return Vector{std::pow(x[0], 3), std::pow(x[1], 3), 0};
                      }};
constexpr Cloud exponential{"exponential", [](Engine& engine) {
                                const Vector x = square(engine);
                                return Vector{-std::log(1 - x[0]), -std::log(1 - x[1]), 0};
                            }};
constexpr Cloud uniform{"uniform", square};

struct Ranks {
    int num_ranks = 1;
    Options options{};
    std::vector<double> coordinates{};

    Ranks(const Cloud& cloud, std::size_t num_points, int ranks, int num_parts) : num_ranks(ranks) {
        options.num_parts = num_parts;
        options.part_sizes.assign(static_cast<std::size_t>(num_parts), 1.0);
        Engine engine(3);
        for (std::size_t i = 0; i < num_points; ++i) {
            const Vector x = cloud.point(engine);
            coordinates.insert(coordinates.end(), {x[0], x[1]});
        }
    }

    /// Gives each rank a slab across the first axis.
    void sort() {
        std::vector<std::pair<double, double>> points;
        for (std::size_t i = 0; i < coordinates.size(); i += 2)
            points.emplace_back(coordinates[i], coordinates[i + 1]);
        std::sort(points.begin(), points.end());
        coordinates.clear();
        for (const auto& [x, y] : points) coordinates.insert(coordinates.end(), {x, y});
    }

    Points points_of(int rank) const {
        const auto first_of = [&](int r) {
            return coordinates.size() / 2 * static_cast<std::size_t>(r) /
                   static_cast<std::size_t>(num_ranks) * 2;
        };
        return Points(
            std::span(coordinates).subspan(first_of(rank), first_of(rank + 1) - first_of(rank)), 2);
    }

    /// What a rank hands to its parent.
    Contribution contribution_of(int rank) const {
        HostPasses mine(points_of(rank));
        const PointSummary summary = mine.summary(true);
        Contribution all{summarize(summary, false, 0), {}};
        add_records(mine, summary.box, num_ranks, options, all);
        MergeTree{num_ranks}.for_each_child(rank, [&](int child) {
            const Contribution theirs = contribution_of(child);
            absorb(all, theirs.summary, theirs.records, 2, most_cells(options));
        });
        return all;
    }

    /// Imbalance of the points under the cuts of the domain.
    double imbalance_of_estimate() const {
        const Bisection bisection =
            bisect(build_domain(contribution_of(0), 2), options.num_parts, {});
        const Points points(coordinates, 2);
        std::vector<Part> parts(points.count);
        assign(bisection.cuts, points, parts);
        std::vector<double> weights(options.part_sizes.size());
        for (const Part part : parts) weights[static_cast<std::size_t>(part)] += 1;
        return imbalance(weights);
    }
};

struct Case {
    Cloud cloud;
    int num_ranks;
};

/// 20,000 points, scattered over the ranks, in eight parts.
double imbalance_of_scattered(const Case& of) {
    return Ranks(of.cloud, 20'000, of.num_ranks, 8).imbalance_of_estimate();
}

TEST(Estimate, is_within_a_percent_where_points_hardly_crowd) {
    const Case cases[] = {{disk, 1},     {disk, 2},    {disk, 4}, {disk, 8},   {triangle, 4},
                          {triangle, 8}, {uniform, 8}, {ring, 8}, {normal, 4}, {normal, 8}};
    for (const Case& of : cases)
        EXPECT_LE(imbalance_of_scattered(of), 1.01) << of.cloud.name << " on " << of.num_ranks;
}

TEST(Estimate, knows_on_which_side_of_a_cell_the_points_crowd) {
    for (const Case& of : {Case{cubed, 1}, {cubed, 4}, {cubed, 8}, {exponential, 4}})
        EXPECT_LE(imbalance_of_scattered(of), 1.08) << of.cloud.name << " on " << of.num_ranks;
}

TEST(Estimate, goes_through_merged_cells_of_thin_slabs) {
    constexpr int num_ranks = 256;
    for (const Cloud& cloud : {uniform, disk, triangle, slope}) {
        Ranks ranks(cloud, 600 * num_ranks, num_ranks, num_ranks);
        ranks.sort();
        EXPECT_LE(ranks.imbalance_of_estimate(), 1.15) << cloud.name;
    }
}

}  // namespace
}  // namespace rrcb
