// What holds for columns that move along any plan, and for the ghosts of any partition.
#include "../support/distance.hpp"
#include "../support/ranks.hpp"
#include "check_mpi.hpp"
#include "expectations.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/ghosts.hpp>

namespace rrcb::test {
namespace {

constexpr int num_cases = 100;

/// Points of a case on this rank, with what names them.
struct Held {
    std::vector<double> coordinates;
    std::vector<int> owners;          ///< that they had first
    std::vector<LocalIndex> indices;  ///< there
};

Held held_at_first(const Case& input) {
    const Cloud mine = cloud_of(input, num_ranks()).of_rank(rank());
    Held held{mine.coordinates, mine.owners, std::vector<LocalIndex>(mine.size())};
    std::iota(held.indices.begin(), held.indices.end(), LocalIndex{0});
    return held;
}

/// Some bytes, or plenty.
TransferOptions options_of(const Case& input) {
    return {input.shape.choice % 2 == 0 ? std::size_t{1} << 20 : std::size_t{100}};
}

Held moved(const Held& held, const Plan& plan, const Case& input) {
    const auto dimension = static_cast<std::size_t>(input.shape.dimension);
    TransferReport report;
    TransferOptions options = options_of(input);
    options.report = &report;
    Held after;
    std::tie(after.coordinates, after.owners, after.indices) =
        transfer(plan, columns(column(held.coordinates, dimension), held.owners, held.indices),
                 MPI_COMM_WORLD, options);
    EXPECT_LE(report.peak_bytes, options.max_bytes);
    return after;
}

bool same_bits(std::span<const double> a, std::span<const double> b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

/// In the order that they had first.
Held sorted(const Held& held, std::size_t dimension) {
    std::vector<std::size_t> order(held.indices.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return held.indices[i]; });
    Held result;
    for (const std::size_t i : order) {
        for (std::size_t a = 0; a < dimension; ++a)
            result.coordinates.push_back(held.coordinates[i * dimension + a]);
        result.owners.push_back(held.owners[i]);
        result.indices.push_back(held.indices[i]);
    }
    return result;
}

TEST(Transfer, there_and_back_is_the_identity) {
    expect_for_all_cases(
        [](const Case& input) -> std::string {
            const auto dimension = static_cast<std::size_t>(input.shape.dimension);
            const Held first = held_at_first(input);
            const Balance there = balance(Points(first.coordinates, input.shape.dimension),
                                          MPI_COMM_WORLD, input.options());
            const Held away = moved(first, plan(there, MPI_COMM_WORLD), input);
            const Held back = sorted(
                moved(away, plan(away.owners, num_ranks(), MPI_COMM_WORLD), input), dimension);
            if (back.owners != first.owners) return "points are lost, or on other ranks";
            if (back.indices != first.indices) return "other points";
            return same_bits(back.coordinates, first.coordinates) ? "" : "other coordinates";
        },
        num_cases);
}

/// Whether a position is as near as that to a region of this rank.
bool is_near(const Vector& x, long double radius, const Cuts& cuts) {
    for (Part part = 0; part < cuts.num_parts; ++part) {
        const RankRange ranks = ranks_of_part(part, cuts.num_parts, num_ranks());
        if (rank() >= ranks.first_rank && rank() < ranks.first_rank + ranks.count &&
            distance(x, box_of(cuts, part), cuts.dimension) <= radius)
            return true;
    }
    return false;
}

/// From nothing to beyond all points, by their own scale.
double radius_of(const Case& input, const Cloud& cloud) {
    double extent = 0;
    for (const double x : cloud.coordinates)
        extent = std::max(extent, std::abs(x / 2 - cloud.coordinates[0] / 2));
    const double share =
        std::vector{0.0, 1e-3, 0.1, 1.0, 2.0}[static_cast<std::size_t>(input.shape.choice % 5)];
    const bool may_grow = extent < std::numeric_limits<double>::max() / 2;
    return extent * (may_grow ? share : std::min(share, 1.0));
}

TEST(Ghosts, are_all_points_near_the_regions_of_a_rank_and_no_others) {
    expect_for_all_cases(
        [](const Case& input) -> std::string {
            const Cloud cloud = cloud_of(input, num_ranks());
            const Held held = held_at_first(input);
            const Points points(held.coordinates, input.shape.dimension);
            Cuts cuts = balance(points, MPI_COMM_WORLD, input.options()).cuts;
            cuts = unstamped(cuts);  // the points stay where they are
            const double radius = radius_of(input, cloud);
            const GhostPlan lists = ghost_plan(cuts, points, MPI_COMM_WORLD, {.cutoff = radius});
            const auto [owners, indices] =
                fetch(lists, columns(held.owners, held.indices), MPI_COMM_WORLD, options_of(input));
            std::size_t next = 0;
            for (int source = 0; source < num_ranks(); ++source) {
                const std::vector<LocalIndex> there = cloud.held_by(source);
                for (LocalIndex k = 0; k < there.size() && source != rank(); ++k) {
                    const Vector x = cloud.points().position(there[k]);
                    const bool is_next =
                        next < owners.size() && owners[next] == source && indices[next] == k;
                    const std::string who =
                        "point " + std::to_string(k) + " of rank " + std::to_string(source);
                    if (!is_next && is_near(x, radius, cuts)) return who + " is missing";
                    if (is_next && !is_near(x, radius * (1 + 4e-15L), cuts))
                        return who + " is not near";
                    next += is_next ? 1 : 0;
                }
            }
            return next == owners.size() ? "" : "others come, or in another order";
        },
        num_cases);
}

}  // namespace
}  // namespace rrcb::test
