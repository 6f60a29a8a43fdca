#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "bisection/cell_density.hpp"
#include "bisection/patches.hpp"
#include "bisection/profile.hpp"

namespace rrcb {
namespace {

using Number = long double;

struct Density {
    double slope;
    double bow;
};

/// A density on [-1, 1] of any slope and bow with which it is nowhere negative.
Density random_density(std::mt19937_64& engine) {
    while (true) {
        const Density one{6 * test::uniform(engine) - 3, 4 * test::uniform(engine) - 2};
        bool is_density = true;
        for (int k = 0; k <= 200; ++k) {
            const double u = k / 100.0 - 1;
            is_density &= 1 + one.slope * u + one.bow * (3 * u * u - 1) / 2 >= 0;
        }
        if (is_density) return one;
    }
}

/// Integral of the density from -1 to `u`, by its antiderivative.
Number integral(const Density& one, Number u) {
    const auto antiderivative = [&](Number x) {
        return x + one.slope * x * x / 2 + one.bow * (x * x * x - x) / 2;
    };
    return (antiderivative(u) - antiderivative(-1)) / 2;
}

double weight_below(const std::vector<Patch>& patches, double value) {
    const StatisticalDomain domain{1, patches};
    return Profile(domain).weight_below(0, value);
}

TEST(Profile, has_the_integral_of_a_density_below_a_value) {
    std::mt19937_64 engine(1);
    for (int round = 0; round < 300; ++round) {
        const Density density = random_density(engine);
        const std::vector<Patch> patch{{{-1}, {1}, 1, {density.slope}, {density.bow}}};
        EXPECT_EQ(weight_below(patch, -1), 0);
        EXPECT_EQ(weight_below(patch, 1), 1);
        double last = 0;
        for (int k = 0; k <= 400; ++k) {
            const double u = k / 200.0 - 1;
            const double below = weight_below(patch, u);
            EXPECT_NEAR(below, static_cast<double>(integral(density, u)), 1e-14);
            EXPECT_GE(below, last - 1e-15);
            last = below;
        }
    }
}

TEST(Profile, of_the_largest_extent_does_not_overflow) {
    constexpr double largest = std::numeric_limits<double>::max();
    const std::vector<Patch> patch{{{-largest}, {largest}, 1, {0.5}, {0}}};
    EXPECT_NEAR(weight_below(patch, 0), 0.375, 1e-14);
    EXPECT_DOUBLE_EQ(weight_below(patch, largest), 1);
}

/// Divides a patch across axis 0.
Halves divided(const Patch& patch, double value) {
    return split_domain({3, {patch}}, plane(0, value));
}

TEST(SplitDomain, leaves_the_weight_of_a_patch_where_it_was) {
    std::mt19937_64 engine(2);
    for (int round = 0; round < 300; ++round) {
        const Density density = random_density(engine);
        const Patch patch{{-1, 0, 0}, {1, 1, 0}, 8, {density.slope, 1, 0}, {density.bow, 0, 0}};
        const double cut = 2 * test::uniform(engine) - 1;
        const Halves halves = divided(patch, cut);
        const Patch& below = halves.lower.patches.at(0);
        const Patch& above = halves.upper.patches.at(0);
        EXPECT_EQ(below.weight + above.weight, 8);
        EXPECT_EQ(below.upper[0], cut);
        EXPECT_EQ(above.lower[0], cut);
        EXPECT_EQ(below.slope[1], 1) << "along the other axis nothing changes";
        for (int k = 0; k <= 20; ++k) {
            const double u = k / 10.0 - 1;
            EXPECT_NEAR(weight_below({below, above}, u),
                        8 * static_cast<double>(integral(density, u)), 1e-12);
        }
    }
}

TEST(SplitDomain, divides_a_patch_without_weight_on_one_side) {
    // (1 + u)^2 is 0 at -1: nothing but rounding lies next to it.
    const Patch patch{{-1, 0, 0}, {1, 0, 0}, 1, {1.5, 0, 0}, {0.5, 0, 0}};
    const Halves halves = divided(patch, std::nextafter(-1.0, 0));
    const Patch& below = halves.lower.patches.at(0);
    const Patch& above = halves.upper.patches.at(0);
    EXPECT_GE(below.weight, 0);
    EXPECT_LE(below.weight, 1e-15);
    EXPECT_TRUE(std::isfinite(below.slope[0]) && std::isfinite(below.bow[0]));
    EXPECT_NEAR(above.slope[0], 1.5, 1e-12);
}

double weight_below(std::span<const DensityPiece> pieces, double value) {
    std::vector<Patch> patches;
    for (const DensityPiece& piece : pieces)
        patches.push_back({{piece.lower}, {piece.upper}, piece.share, {piece.slope}, {piece.bow}});
    return weight_below(patches, value);
}

struct Spread {
    double mean;
    double deviation;
};

/// By the moments of the Legendre polynomials, about a place near the mean.
Spread spread_of(std::span<const DensityPiece> pieces, double origin) {
    Number share = 0;
    Number first = 0;
    Number second = 0;
    for (const DensityPiece& piece : pieces) {
        const Number half = Number{piece.upper} / 2 - Number{piece.lower} / 2;
        const Number slope = piece.slope;
        const Number middle = Number{piece.upper} / 2 + Number{piece.lower} / 2 - origin;
        const Number mean = middle + half * slope / 3;
        const Number variance = 1 / Number{3} + Number{piece.bow} * 2 / 15 - slope * slope / 9;
        share += piece.share;
        first += piece.share * mean;
        second += piece.share * (mean * mean + half * half * variance);
    }
    EXPECT_NEAR(static_cast<double>(share), 1, 1e-14);
    const Number off = first / share;
    return {static_cast<double>(origin + off),
            static_cast<double>(std::sqrt(second / share - off * off))};
}

TEST(EntropyDensity, keeps_mean_and_deviation) {
    for (double mean = -0.95; mean < 1; mean += 0.05) {
        for (const double deviation : {1e-6, 1e-3, 0.01, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9}) {
            if (deviation * deviation + mean * mean > 1) continue;
            const auto pieces = entropy_density_of(mean, deviation, -1, 1);
            const Spread spread = spread_of(pieces, mean);
            EXPECT_NEAR(spread.mean, mean, 1e-12) << deviation;
            EXPECT_NEAR(spread.deviation, deviation, 1e-12) << mean;
            for (const DensityPiece& piece : pieces) {
                EXPECT_GE(piece.lower, -1);
                EXPECT_LE(piece.lower, piece.upper);
                EXPECT_LE(piece.upper, 1);
                EXPECT_GE(piece.share, 0);
            }
        }
    }
}

TEST(EntropyDensity, of_the_moments_of_an_exponential_is_that_one) {
    // exp(rate u) on [-1, 1] has the mean coth rate - 1 / rate and the variance 1 / rate^2 -
    // 1 / sinh^2 rate.
    for (const double rate : {-12.0, -4.0, 2.5, 4.0, 8.0, 20.0}) {
        const double mean = 1 / std::tanh(rate) - 1 / rate;
        const double sinh = std::sinh(rate);
        const double deviation = std::sqrt(1 / (rate * rate) - 1 / (sinh * sinh));
        const auto pieces = entropy_density_of(mean, deviation, -1, 1);
        for (double u = -1; u <= 1; u += 0.01)
            EXPECT_NEAR(weight_below(pieces, u), std::expm1(rate * (u + 1)) / std::expm1(2 * rate),
                        0.02)
                << rate << ' ' << u;
    }
}

TEST(EntropyDensity, inside_a_cell_is_normal) {
    for (const double deviation : {1e-5, 0.01, 0.1, 0.2}) {
        const auto pieces = entropy_density_of(0.1, deviation, -1, 1);
        for (double x = -3.5; x <= 3.5; x += 0.05)
            EXPECT_NEAR(weight_below(pieces, 0.1 + x * deviation),
                        0.5 * std::erfc(-x / std::sqrt(2.0)), 0.005)
                << deviation << ' ' << x;
    }
}

TEST(EntropyDensity, of_any_moments_ends) {
    constexpr double largest = std::numeric_limits<double>::max();
    for (const double size : {5e-324, 1e-310, 1e-300, 1.0, 1e300, largest}) {
        for (const double mean : {-size, -0.999 * size, 0.0, 0.5 * size, size}) {
            for (const double deviation : {0.0, 1e-12 * size, 0.3 * size, 0.999 * size, size}) {
                for (const DensityPiece& piece : entropy_density_of(mean, deviation, -size, size)) {
                    EXPECT_GE(piece.lower, -size);
                    EXPECT_LE(piece.lower, piece.upper);
                    EXPECT_LE(piece.upper, size);
                    EXPECT_TRUE(std::isfinite(piece.slope) && std::isfinite(piece.bow));
                    EXPECT_TRUE(piece.share >= 0 && piece.share <= 1 + 1e-12);
                }
            }
        }
    }
}

}  // namespace
}  // namespace rrcb
