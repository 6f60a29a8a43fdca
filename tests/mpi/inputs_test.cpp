#include "../support/clouds.hpp"
#include "../support/ranks.hpp"
#include "../support/same_error.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/ghosts.hpp>
#include <rrcb/points.hpp>

#include <bit>

namespace rrcb {
namespace {

template <class T>
struct Particle {
    T x;
    T others[2];
    T y;
    T z;
};

/// Points of this rank in several arrangements.
template <class T>
struct Cloud {
    Cloud(std::size_t count, int dimension_of_points) : dimension(dimension_of_points) {
        for (const double x : test::uniform_cloud(count * static_cast<std::size_t>(dimension), 1,
                                                  static_cast<unsigned>(5 + rank())))
            values.push_back(static_cast<T>(x));
        doubles.assign(values.begin(), values.end());
        const auto d = static_cast<std::size_t>(dimension);
        axes.resize(d);
        for (std::size_t i = 0; i < count; ++i) {
            particles.push_back(
                {values[i * d], {7, 7}, values[i * d + d / 2], values[i * d + d - 1]});
            for (std::size_t a = 0; a < d; ++a) axes[a].push_back(values[i * d + a]);
        }
    }

    std::vector<Points> arrangements() const {
        using P = Particle<T>;
        const std::vector<std::span<const T>> columns(axes.begin(), axes.end());
        const Points structs = dimension == 1   ? Points(particles, &P::x)
                               : dimension == 2 ? Points(particles, &P::x, &P::y)
                                                : Points(particles, &P::x, &P::y, &P::z);
        return {Points(values, dimension), Points(columns), structs};
    }

    int dimension;
    std::vector<T> values{};
    std::vector<double> doubles{};
    std::vector<std::vector<T>> axes{};
    std::vector<Particle<T>> particles{};
};

std::vector<std::uint64_t> bits(const Cuts& cuts) {
    std::vector<std::uint64_t> all;
    for (const Cut& cut : cuts.tree)
        for (const double at : cut.at) all.push_back(std::bit_cast<std::uint64_t>(at));
    return all;
}

template <class T>
void expect_same_bits(std::size_t count) {
    for (int dimension = 1; dimension <= 3; ++dimension) {
        const Cloud<T> cloud(count, dimension);
        const std::vector<double> weights(count, 0.3);
        Points reference(cloud.doubles, dimension, weights);
        for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact}) {
            const Options options{.num_parts = 11, .refine = refine};
            Balance expected = balance(reference, MPI_COMM_WORLD, options);
            expected.cuts = unstamped(expected.cuts);  // the points stay where they are
            const GhostPlan near =
                ghost_plan(expected.cuts, reference, MPI_COMM_WORLD, {.cutoff = 0.05});
            for (Points points : cloud.arrangements()) {
                points.weights = weights;
                Balance found = balance(points, MPI_COMM_WORLD, options);
                found.cuts = unstamped(found.cuts);
                EXPECT_EQ(found.parts, expected.parts);
                EXPECT_EQ(bits(found.cuts), bits(expected.cuts));
                EXPECT_EQ(bounding_box(points).lower, bounding_box(reference).lower);
                EXPECT_EQ(assign(found.cuts, points, MPI_COMM_WORLD), expected.parts);
                EXPECT_EQ(balance(points, MPI_COMM_WORLD, options, found.cuts).parts,
                          balance(reference, MPI_COMM_WORLD, options, found.cuts).parts);
                EXPECT_EQ(
                    ghost_plan(found.cuts, points, MPI_COMM_WORLD, {.cutoff = 0.05}).send_indices,
                    near.send_indices);
            }
        }
    }
}

TEST(Inputs, of_any_arrangement_give_the_same_bits) {
    const bool is_empty = num_ranks() > 2 && rank() == 1;
    expect_same_bits<double>(is_empty ? 0 : 1500);
    expect_same_bits<float>(is_empty ? 0 : 1500);
}

void expect_refusal(const Points& points, const std::string& text) {
    test::expect_same_error([&] { balance(points, MPI_COMM_WORLD); },
                            "rank " + std::to_string(num_ranks() - 1) + ": " + text);
}

TEST(Inputs, that_are_unusable_on_one_rank_are_refused_on_all) {
    const bool last = is_last_rank();
    std::vector<float> x{0, 1, 2, 3};
    Points points(x, 2);
    if (last) points.stride = sizeof(float) + 1;
    expect_refusal(points, "the stride of the points must be in bytes");
    points = Points(x, 2);
    if (last) points.count = std::numeric_limits<std::size_t>::max() / 4;
    expect_refusal(points, "count and stride exceed the memory");
    points = Points(x, 2);
    if (last) points.axes[1] = nullptr;
    expect_refusal(points, "coordinates must be there on each axis");
    points = Points(x, 2);
    if (last) points.type = static_cast<ScalarType>(7);
    expect_refusal(points, "the type of the points must be ScalarType::float64 or float32");
    if (last) x[3] = std::numeric_limits<float>::quiet_NaN();
    expect_refusal(Points(x, 2), "coordinate of point 1 on axis 1 is NaN or infinite");
    const std::vector<float> five(5);
    expect_refusal(Points(std::span(five).first(last ? 5 : 4), 2),
                   "the length of the coordinate array must be a multiple of the dimension");
}

}  // namespace
}  // namespace rrcb
