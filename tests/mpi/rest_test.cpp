// Points at rest, balanced again and again without earlier cuts: after two calls nothing moves.
#include "held_points.hpp"

namespace rrcb {
namespace {

using test::HeldPoints;

/// Several points at each site of a lattice.
struct Lattice {
    std::array<int, 3> sites;
    int dimension;
    int points_a_site;
};

HeldPoints points_of(const Lattice& lattice) {
    HeldPoints all{lattice.dimension, {}};
    const auto& [first, second, third] = lattice.sites;
    for (int k = 0; k < third; ++k)
        for (int j = 0; j < second; ++j)
            for (int i = 0; i < first; ++i) {
                const Vector site{1.0 * i, 1.0 * j, 1.0 * k};
                for (int point = 0; point < lattice.points_a_site; ++point)
                    all.coordinates.insert(all.coordinates.end(), site.begin(),
                                           site.begin() + lattice.dimension);
            }
    all.scatter();
    return all;
}

/// Weights of points, by a number at random from 0 to below 1.
struct Weights {
    std::string name;
    std::function<double(double)> of;  ///< empty: none
};

const std::vector<Weights>& kinds_of_weights() {
    static const std::vector<Weights> kinds{
        {"none", {}},
        {"0 or 1", [](double u) { return u < 0.5 ? 0.0 : 1.0; }},
        {"mostly 0", [](double u) { return u < 0.9 ? 0.0 : 1.0; }},
        {"1 to 4", [](double u) { return 1 + std::floor(4 * u); }},
        {"even", [](double u) { return u; }},
        {"0.1", [](double) { return 0.1; }},
        {"1 or 1e-20", [](double u) { return u < 0.5 ? 1 : 1e-20; }},
        {"60 decades", [](double u) { return std::pow(10.0, 60 * u - 30); }}};
    return kinds;
}

void weigh(const Weights& kind, HeldPoints& all) {
    all.weights.clear();
    std::mt19937_64 engine(11);
    for (std::size_t i = 0; kind.of && i < all.count(); ++i)
        all.weights.push_back(kind.of(test::uniform(engine, 0, 1)));
}

/// Nothing moves in the third of ten calls, nor in a later one.
void expect_rest(HeldPoints all, const Options& options) {
    for (int call = 1; call <= 10; ++call) {
        const test::Step step = test::balance_and_move(all, options);
        if (options.expert.coincident == Coincident::together) {
            EXPECT_EQ(step.num_strays, 0);
        }
        if (call > 2) {
            EXPECT_EQ(step.num_moved, 0u) << "in call " << call;
        }
        if (call > 2 && step.num_moved > 0) return;
    }
}

void expect_rest_on(const Lattice& lattice) {
    HeldPoints all = points_of(lattice);
    for (const Weights& kind : kinds_of_weights()) {
        weigh(kind, all);
        for (const Refine refine : {Refine::exact, Refine::tolerance})
            for (const Coincident coincident : {Coincident::together, Coincident::divide}) {
                SCOPED_TRACE("weights " + kind.name + ", refine " +
                             std::to_string(static_cast<int>(refine)) + ", coincident " +
                             std::to_string(static_cast<int>(coincident)));
                Options options{.refine = refine, .expert = {.coincident = coincident}};
                expect_rest(all, options);
            }
    }
}

TEST(CallsFromScratch, move_no_point_at_rest_on_a_square_lattice) {
    expect_rest_on({{20, 20, 1}, 2, 5});
    expect_rest_on({{16, 16, 1}, 2, 1});
    expect_rest_on({{17, 17, 1}, 2, 7});
}

TEST(CallsFromScratch, move_no_point_at_rest_on_a_rectangular_lattice) {
    expect_rest_on({{9, 20, 1}, 2, 5});
    expect_rest_on({{33, 32, 1}, 2, 2});
}

TEST(CallsFromScratch, move_no_point_at_rest_on_a_cubic_lattice) {
    expect_rest_on({{11, 11, 10}, 3, 1});
    expect_rest_on({{6, 6, 6}, 3, 5});
    expect_rest_on({{4, 4, 3}, 3, 7});
}

TEST(CallsFromScratch, move_no_point_at_rest_on_a_line) {
    expect_rest_on({{1000, 1, 1}, 1, 1});
    expect_rest_on({{90, 1, 1}, 1, 7});
}

}  // namespace
}  // namespace rrcb
