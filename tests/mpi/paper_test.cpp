#include "paper_shares.hpp"

#include <rrcb/detail/paper_steps.hpp>
#include <rrcb/detail/support_mesh.hpp>
#include <rrcb/quality.hpp>

namespace rrcb {
namespace {

using test::crowded_share;
using test::lattice_share;
using test::MakeShare;
using test::Share;
using test::weighted_share;

constexpr std::array domains = {PaperDomain::sampled, PaperDomain::points};

/// The points of all ranks, by rank.
Share all_points(const MakeShare& make) {
    Share all = make(0);
    for (int of_rank = 1; of_rank < num_ranks(); ++of_rank) {
        const Share next = make(of_rank);
        all.coordinates.insert(all.coordinates.end(), next.coordinates.begin(),
                               next.coordinates.end());
        all.weights.insert(all.weights.end(), next.weights.begin(), next.weights.end());
    }
    return all;
}

/// Recursive coordinate bisection of different points by sorting.
struct SortedBisection {
    const Points& points;
    const std::vector<double>& sizes;
    std::vector<Part> parts;

    double weight_of(std::span<const std::size_t> members) const {
        double sum = 0;
        for (const std::size_t i : members) sum += points.weight(i);
        return sum;
    }

    /// First axis of the longest extent.
    int longest(std::span<const std::size_t> members) const {
        int axis = 0;
        double extent = -1;
        for (int a = 0; a < points.dimension; ++a) {
            const auto at = [&](std::size_t i) { return points.coordinate(i, a); };
            const auto [lower, upper] = std::ranges::minmax(members, {}, at);
            if (at(upper) - at(lower) <= extent) continue;
            axis = a;
            extent = at(upper) - at(lower);
        }
        return axis;
    }

    void divide(std::span<std::size_t> members, std::size_t first, std::size_t last) {
        if (last - first == 1) {
            for (const std::size_t i : members) parts[i] = static_cast<Part>(first);
            return;
        }
        const std::size_t middle = first + (last - first) / 2;
        const auto sum = [&](std::size_t from, std::size_t to) {
            return std::accumulate(sizes.begin() + std::ptrdiff_t(from),
                                   sizes.begin() + std::ptrdiff_t(to), 0.0);
        };
        const double all = sum(first, last);
        const double share = all > 0 ? sum(first, middle) / all : 0;
        const std::size_t split = share >= 1 ? members.size() : num_below(members, share);
        divide(members.first(split), first, middle);
        divide(members.subspan(split), middle, last);
    }

    /// Sorts, and returns how many points come nearest to a share of the weight.
    std::size_t num_below(std::span<std::size_t> members, double share) const {
        const double target = share * weight_of(members);
        if (target <= 0) return 0;
        const int axis = longest(members);
        std::ranges::sort(members, [&](std::size_t i, std::size_t j) {
            for (const int a : {axis, 0, 1, 2}) {
                if (a >= points.dimension) continue;
                const double x = points.coordinate(i, a);
                const double y = points.coordinate(j, a);
                if (x != y) return x < y;
            }
            return false;
        });
        double below = 0;
        std::size_t count = 0;
        for (const std::size_t i : members) {
            const double weight = points.weight(i);
            if (below + weight >= target) return count + (target - below >= weight / 2 ? 1 : 0);
            below += weight;
            ++count;
        }
        return count;
    }
};

/// Part of each point of this rank by SortedBisection of the points of all ranks.
std::vector<Part> sorted_parts(const MakeShare& make, std::vector<double> sizes) {
    const Share all = all_points(make);
    const Points points = all.points();
    SortedBisection bisection{points, sizes, std::vector<Part>(points.count)};
    std::vector<std::size_t> members(points.count);
    std::iota(members.begin(), members.end(), std::size_t{0});
    bisection.divide(members, 0, sizes.size());
    LocalIndex begin = 0;
    for (int before = 0; before < rank(); ++before) begin += make(before).points().count;
    const auto first = bisection.parts.begin() + static_cast<std::ptrdiff_t>(begin);
    return {first, first + static_cast<std::ptrdiff_t>(make(rank()).points().count)};
}

TEST(PaperRcb, gives_the_parts_of_a_bisection_by_sorting) {
    for (const MakeShare make : {crowded_share, weighted_share, lattice_share}) {
        const Share mine = make(rank());
        for (const std::vector<double>& sizes :
             {std::vector<double>(4, 1.0), std::vector<double>(6, 1.0), std::vector<double>(13, 2),
              std::vector<double>{1, 0, 3, 0.5}, std::vector<double>{0, 2, 0}}) {
            PaperOptions options{.num_parts = static_cast<int>(sizes.size()),
                                 .part_sizes = sizes,
                                 .domain = PaperDomain::points};
            const Balance result = balance_as_in_paper(mine.points(), MPI_COMM_WORLD, options);
            EXPECT_EQ(result.parts, sorted_parts(make, sizes));
        }
    }
}

bool same_bits(const Cuts& a, const Cuts& b) {
    return std::ranges::equal(a.tree, b.tree, [](const Cut& one, const Cut& other) {
        return one.axis == other.axis && std::memcmp(&one.at, &other.at, sizeof one.at) == 0;
    });
}

/// Cells of the support meshes of all ranks, by rank.
std::vector<CellMoments> all_cells(const MakeShare& make, int cells_per_axis) {
    std::vector<CellMoments> all;
    for (int of_rank = 0; of_rank < num_ranks(); ++of_rank) {
        const Share share = make(of_rank);
        const Points points = share.points();
        if (points.count == 0) continue;
        const auto cells = cell_moments(
            points, make_support_mesh(bounding_box(points), share.dimension, cells_per_axis));
        all.insert(all.end(), cells.begin(), cells.end());
    }
    return all;
}

TEST(PaperRrcb, bisects_the_sampled_points_of_the_cells_of_all_ranks) {
    for (const MakeShare make : {crowded_share, weighted_share, lattice_share}) {
        const Share mine = make(rank());
        for (const int mesh : {1, 4, 7}) {
            for (const CutRule rule : {CutRule::weighted_fraction, CutRule::midpoint}) {
                PaperOptions options{.num_parts = 6,
                                     .cells_per_axis = mesh,
                                     .sample_fraction = mesh == 4 ? 0.25 : 1,
                                     .seed = static_cast<std::uint64_t>(mesh)};
                if (mesh == 7) options.part_sizes = {0, 3, 0, 0, 1, 2};
                options.cut_rule = rule;
                const Balance result = balance_as_in_paper(mine.points(), MPI_COMM_WORLD, options);
                const auto cells = all_cells(make, mesh);
                const Bisection expected =
                    bisect_points(sample_points(cells, mine.dimension, options), mine.dimension, 6,
                                  options.part_sizes, rule);
                EXPECT_TRUE(same_bits(result.cuts, expected.cuts));
                std::vector<Part> parts(result.parts.size());
                assign(expected.cuts, mine.points(), parts);
                EXPECT_EQ(result.parts, parts);
                EXPECT_EQ(result.report.details.num_cells, std::ssize(cells));
                EXPECT_EQ(result.report.details.estimated_imbalance,
                          imbalance(expected.part_weights, options.part_sizes));
            }
        }
    }
}

TEST(PaperRrcb, comes_nearer_to_the_points_with_a_finer_mesh) {
    // A dense corner, which a single cell per rank cannot show.
    std::vector<double> cloud = test::uniform_cloud(20000, 2, 100 + static_cast<unsigned>(rank()));
    for (double& x : cloud) x = x * x * x;
    const Points points(cloud, 2);
    const auto imbalance_with = [&](int mesh) {
        PaperOptions options{.num_parts = 4, .cells_per_axis = mesh};
        const Balance result = balance_as_in_paper(points, MPI_COMM_WORLD, options);
        return imbalance(part_weights(points, result.parts, 4, MPI_COMM_WORLD));
    };
    EXPECT_GT(imbalance_with(1), 1.2);
    EXPECT_LT(imbalance_with(16), 1.05);
}

TEST(Paper, reports_what_it_bisected_and_measures_nothing) {
    const Share mine = weighted_share(rank());
    const Share all = all_points(weighted_share);
    const Points points = all.points();
    const double total = std::accumulate(all.weights.begin(), all.weights.end(), 0.0);
    for (const PaperDomain domain : domains) {
        PaperOptions options{.num_parts = 3, .domain = domain};
        const Balance result = balance_as_in_paper(mine.points(), MPI_COMM_WORLD, options);
        const Report& report = result.report;
        EXPECT_EQ(report.details.num_points, static_cast<GlobalCount>(points.count));
        EXPECT_EQ(report.details.total_weight, total);
        EXPECT_TRUE(std::isnan(report.imbalance));
        EXPECT_FALSE(report.within_tolerance || report.kept || report.details.all_weights_zero);
        EXPECT_TRUE(report.part_weights.empty());
        EXPECT_EQ(report.details.least_imbalance, 1);
        EXPECT_EQ(
            report.details.rounds + report.details.num_empty_parts + report.details.coincident_cuts,
            0);
        if (domain == PaperDomain::sampled) continue;
        EXPECT_EQ(report.details.num_cells, report.details.num_points);
        const auto weights = part_weights(mine.points(), result.parts, 3, MPI_COMM_WORLD);
        EXPECT_EQ(report.details.estimated_imbalance, imbalance(weights));
    }
}

TEST(Paper, reports_the_least_imbalance_of_points_of_one_weight) {
    const std::vector<double> x(rank() == 0 ? 4 : 0, 0.5);
    PaperOptions options{.num_parts = 3};
    for (const PaperDomain domain : domains) {
        options.domain = domain;
        const Balance result = balance_as_in_paper(Points(x, 1), MPI_COMM_WORLD, options);
        EXPECT_EQ(result.report.details.least_imbalance, 1.5);
    }
}

TEST(Paper, balances_by_number_if_all_weights_are_zero) {
    Share mine = crowded_share(rank());
    mine.weights.assign(300, 0.0);
    for (const PaperDomain domain : domains) {
        PaperOptions options{.num_parts = 4, .domain = domain};
        const Balance result = balance_as_in_paper(mine.points(), MPI_COMM_WORLD, options);
        EXPECT_TRUE(result.report.details.all_weights_zero);
        mine.weights.clear();
        EXPECT_EQ(balance_as_in_paper(mine.points(), MPI_COMM_WORLD, options).parts, result.parts);
        mine.weights.assign(300, 0.0);
    }
}

TEST(Paper, makes_one_part_per_rank_unless_asked_for_others) {
    const Share mine = crowded_share(rank());
    const Balance result = balance_as_in_paper(mine.points(), MPI_COMM_WORLD);
    EXPECT_EQ(result.cuts.num_parts, num_ranks());
}

}  // namespace
}  // namespace rrcb
