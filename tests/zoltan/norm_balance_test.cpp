// Several weights per object under the plug-in's norms, without Zoltan around.
#include "../support/ranks.hpp"
#include "zoltan/norm/norm_balance_mpi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace rrcb::zoltan {
namespace {

using test::num_ranks;
using test::rank;

constexpr int num_objects = 900;
constexpr std::size_t num_weights = 2;

/// All objects, the same on every rank.
struct Cloud {
    std::vector<double> coordinates;
    std::vector<float> weights;
};

Cloud cloud_of(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    Cloud cloud;
    for (int i = 0; i < num_objects; ++i) {
        const double x = uniform(random);
        cloud.coordinates.insert(cloud.coordinates.end(), {x, uniform(random)});
        cloud.weights.insert(cloud.weights.end(), {float(x * x), float((1 - x) * uniform(random))});
    }
    return cloud;
}

/// This rank's objects, each dealt to the rank that `owner` names.
template <class Owner>
Cloud mine(const Cloud& all, Owner owner) {
    Cloud part;
    for (std::size_t i = 0; i < all.coordinates.size() / 2; ++i) {
        if (owner(int(i)) != rank()) continue;
        for (std::size_t k = 0; k < 2; ++k) {
            part.coordinates.push_back(all.coordinates[2 * i + k]);
            part.weights.push_back(all.weights[num_weights * i + k]);
        }
    }
    return part;
}

Balance run(const Cloud& part, int norm, Options options) {
    const Points points = interleaved_points(part.coordinates, 2);
    options.refine = Refine::none;
    Balance result = balance(points, options, MPI_COMM_WORLD);
    Participant self{MPI_COMM_WORLD};
    balance_norm(points, {norm, part.weights, num_weights}, options, result, self);
    return result;
}

Options into(int num_parts) {
    Options options;
    options.num_parts = num_parts;
    return options;
}

/// Heaviest part over mean part of each weight.
std::array<double, num_weights> imbalances(const Cloud& part, std::span<const Part> parts,
                                           int num_parts) {
    std::vector<double> sums(num_weights * std::size_t(num_parts));
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t k = 0; k < num_weights; ++k)
            sums[k * std::size_t(num_parts) + std::size_t(parts[i])] +=
                double(part.weights[num_weights * i + k]);
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), int(sums.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    std::array<double, num_weights> result{};
    for (std::size_t k = 0; k < num_weights; ++k) {
        const std::span of_weight =
            std::span(sums).subspan(k * std::size_t(num_parts), std::size_t(num_parts));
        double total = 0;
        for (const double sum : of_weight) total += sum;
        result[k] = std::ranges::max(of_weight) * num_parts / total;
    }
    return result;
}

bool are_equal(const Cuts& a, const Cuts& b) {
    return std::ranges::equal(a.tree, b.tree, [](const Cut& x, const Cut& y) {
        return x.axis == y.axis && x.at == y.at;
    });
}

TEST(NormBalance, does_not_depend_on_who_holds_what) {
    for (const int norm : {2, 3}) {
        const Cloud all = cloud_of(5);
        const auto cuts_if = [&](auto owner) { return run(mine(all, owner), norm, into(7)).cuts; };
        const Cuts alone = cuts_if([](int) { return 0; });
        EXPECT_TRUE(are_equal(alone, cuts_if([](int i) { return i % num_ranks(); })));
        EXPECT_TRUE(are_equal(
            alone, cuts_if([](int i) { return num_ranks() - 1 - i * num_ranks() / num_objects; })));
    }
}

TEST(NormBalance, tells_the_parts_of_the_cuts_and_the_worst_imbalance) {
    for (const int num_parts : {1, 2, 5, 16}) {
        const Cloud part = mine(cloud_of(6), [](int i) { return i % num_ranks(); });
        const Balance result = run(part, 3, into(num_parts));
        const Points points = interleaved_points(part.coordinates, 2);
        for (LocalIndex i = 0; i < points.count; ++i)
            EXPECT_EQ(result.parts[i], part_of(result.cuts, points.position(i)));
        const double worst = std::ranges::max(imbalances(part, result.parts, num_parts));
        EXPECT_NEAR(result.report.measured_imbalance, std::max(1.0, worst), 1e-6);
        EXPECT_EQ(result.report.coincident_cuts, 0);
    }
}

TEST(NormBalance, divides_objects_in_one_place_where_it_may) {
    Cloud all;
    for (int i = 0; i < num_objects; ++i) {
        all.coordinates.insert(all.coordinates.end(), {0.25, 0.5});
        all.weights.insert(all.weights.end(), {float(1 + i % 3), float(1 + i % 5)});
    }
    const Cloud part = mine(all, [](int i) { return i * num_ranks() / num_objects; });
    Options options = into(6);
    EXPECT_EQ(std::ranges::max(imbalances(part, run(part, 3, options).parts, 6)), 6);
    options.coincident = Coincident::divide;
    const Balance divided = run(part, 3, options);
    EXPECT_LT(std::ranges::max(imbalances(part, divided.parts, 6)), 1.05);
    EXPECT_GT(divided.report.coincident_cuts, 0);
    // Lower ranks' objects lie lower.
    std::vector<Part> sorted = divided.parts;
    EXPECT_TRUE(std::ranges::is_sorted(sorted));
}

TEST(NormBalance, leaves_parts_of_size_zero_empty) {
    const Cloud part = mine(cloud_of(7), [](int i) { return i % num_ranks(); });
    Options options = into(5);
    options.part_sizes = {0, 1, 0, 2, 0};
    const Points points = interleaved_points(part.coordinates, 2);
    Options estimate = options;
    estimate.refine = Refine::none;
    Balance result = balance(points, estimate, MPI_COMM_WORLD);
    Participant self{MPI_COMM_WORLD};
    std::array<std::vector<double>, 3> further{options.part_sizes};
    balance_norm(points, {2, part.weights, num_weights, false, further}, options, result, self);
    for (const Part p : result.parts) EXPECT_EQ(p % 2, 1);
    EXPECT_LT(result.report.measured_imbalance, 1.5);
}

TEST(NormBalance, knows_light_objects_beside_one_of_much_weight) {
    Cloud all = cloud_of(8);
    all.weights[0] = all.weights[1] = 1e30F;
    const Cloud part = mine(all, [](int i) { return i % num_ranks(); });
    const Balance result = run(part, 2, into(3));
    EXPECT_NEAR(result.report.measured_imbalance, 3, 1e-6);
    EXPECT_NEAR(result.report.least_imbalance, 3, 1e-6);
}

TEST(NormBalance, throws_together_what_one_rank_failed_of) {
    const Cloud part = mine(cloud_of(9), [](int i) { return i % num_ranks(); });
    const Points points = interleaved_points(part.coordinates, 2);
    Options options = into(4);
    Balance result = balance(points, options, MPI_COMM_WORLD);
    Participant self{MPI_COMM_WORLD};
    self.attempt([] {
        if (rank() == num_ranks() - 1) throw std::bad_alloc();
    });
    EXPECT_THROW(balance_norm(points, {2, part.weights, num_weights}, options, result, self),
                 Error);
}

}  // namespace
}  // namespace rrcb::zoltan
