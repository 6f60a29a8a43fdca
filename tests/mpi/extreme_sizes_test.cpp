// Sizes of parts and weights over many decades: the part of a point is that of its position.
#include "held_points.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/quality.hpp>

namespace rrcb {
namespace {

using test::HeldPoints;
using test::Share;

constexpr double least = std::numeric_limits<double>::denorm_min();

/// Numbers at random; the same on every rank.
class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}

    int below(int end) { return static_cast<int>(engine_() % static_cast<unsigned>(end)); }
    double share() { return test::uniform(engine_, 0, 1); }
    double decades(double first, double last) {
        return std::pow(10.0, test::uniform(engine_, first, last));
    }

  private:
    std::mt19937_64 engine_;
};

/// Points of all ranks, in few places or many.
HeldPoints any_cloud(std::size_t count, Random& random) {
    HeldPoints all{1 + random.below(3), {}};
    const int places = random.below(2) == 0 ? 3 : 1 << 20;
    for (std::size_t i = 0; i < count * static_cast<std::size_t>(all.dimension); ++i)
        all.coordinates.push_back(random.below(places));
    all.scatter();
    return all;
}

double any_size(int kind, Random& random) {
    switch (kind) {
        case 0:
            return random.below(2) == 0 ? 1 : 1e-5;
        case 1:
            return random.decades(-6, 0);
        case 2:
            return random.decades(-20, 0);
        case 3:
            return random.decades(-300, 300);
        default:
            return random.below(2) == 0 ? 1 : least * random.below(100);
    }
}

double any_weight(int kind, Random& random) {
    switch (kind) {
        case 0:
            return 1;
        case 1:
            return random.below(2) == 0 ? 1 : 1e-20;
        case 2:
            return random.decades(-30, 30);
        case 3:
            return random.decades(-300, 300);
        default:
            return random.below(3) == 0 ? 0 : least * random.below(1000);
    }
}

Options any_options(Random& random) {
    Options options{.num_parts = 2 + random.below(12),
                    .refine = random.below(2) == 0 ? Refine::tolerance : Refine::exact,
                    .expert = {.axes = {.plain = random.below(5) == 0},
                               .max_root_parts = random.below(4) == 0 ? 2 : 4096}};
    const int kind = random.below(6);
    for (int part = 0; part < options.num_parts && kind < 5; ++part)
        options.part_sizes.push_back(any_size(kind, random));
    if (kind < 5) options.part_sizes[0] = 1;
    return options;
}

/// Looks up every point; the reported imbalance is that of the parts.
void expect_consistent(const Share& mine, const Options& options, const Balance& result) {
    const Points points = mine.points();
    for (LocalIndex i = 0; i < points.count; ++i)
        ASSERT_EQ(part_of(result.cuts, points.position(i)), result.parts[i]) << "point " << i;
    const double counted = imbalance(
        part_weights(points, result.parts, options.num_parts, MPI_COMM_WORLD), options.part_sizes);
    if (result.report.details.all_weights_zero) return;
    EXPECT_NEAR(result.report.imbalance / counted, 1, 1e-9);
    EXPECT_EQ(result.report.within_tolerance,
              result.report.imbalance <= options.imbalance_tolerance);
}

TEST(ExtremeSizes, and_weights_give_the_parts_that_look_ups_find) {
    for (unsigned seed = 0; seed < 3000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const int most = seed % 50 == 0 ? 1500 : 60;
        HeldPoints all = any_cloud(static_cast<std::size_t>(1 + random.below(most)), random);
        const int kind = random.below(6);
        for (std::size_t i = 0; i < all.count() && kind < 5; ++i)
            all.weights.push_back(any_weight(kind, random));
        const Options options = any_options(random);
        const Share mine(all);
        expect_consistent(mine, options, balance(mine.points(), MPI_COMM_WORLD, options));
        if (HasFailure()) return;
    }
}

TEST(ExtremeSizes, leave_nothing_to_a_part_too_small_for_half_a_point) {
    HeldPoints all{1, {}};
    for (int i = 0; i < 19; ++i) all.coordinates.push_back(i % 3);
    all.scatter();
    const Share mine(all);
    for (const double tiny : {1e-4, 1e-5, 1e-12, 1e-20}) {
        Options options{.num_parts = 3, .part_sizes = {tiny, tiny, 1}};
        const Balance result = balance(mine.points(), MPI_COMM_WORLD, options);
        expect_consistent(mine, options, result);
        EXPECT_EQ(result.report.part_weights, (std::vector<double>{0, 0, 19})) << tiny;
        EXPECT_NEAR(result.report.imbalance, 1 + 2 * tiny, 1e-12);
    }
}

}  // namespace
}  // namespace rrcb
