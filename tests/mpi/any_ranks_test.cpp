// Exact cuts across given axes are bit-identical on any number of ranks, however these hold the
// points.
#include "../support/common.hpp"
#include "clouds.hpp"
#include "ranks.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/points.hpp>

#include <bit>

namespace rrcb {
namespace {

struct Cloud {
    int dimension = 1;
    std::vector<double> coordinates{};
    std::vector<double> weights{};

    std::size_t size() const { return coordinates.size() / static_cast<std::size_t>(dimension); }
    void append(const Cloud& from, std::size_t point) {
        const auto axes = static_cast<std::size_t>(dimension);
        for (std::size_t axis = 0; axis < axes; ++axis)
            coordinates.push_back(from.coordinates[point * axes + axis]);
        if (!from.weights.empty()) weights.push_back(from.weights[point]);
    }
};

/// A coordinate, by the point and a random number.
using Coordinate = std::function<double(int i, double u)>;
/// A weight whose sums are exact; 0: there are none.
using Weight = std::function<double(double u)>;

Cloud cloud_of(int dimension, const Coordinate& coordinate, const Weight& weight, unsigned seed,
               int count) {
    std::mt19937_64 random(seed);
    Cloud cloud{dimension};
    for (int i = 0; i < count; ++i) {
        for (int axis = 0; axis < dimension; ++axis)
            cloud.coordinates.push_back(coordinate(i, test::uniform(random)));
        if (const double w = weight(test::uniform(random)); w > 0) cloud.weights.push_back(w);
    }
    return cloud;
}

struct Division {
    std::vector<Part> parts{};          ///< of all points
    std::vector<std::uint64_t> cuts{};  ///< their bits
};

/// Division of all points by the first ranks, to which points are dealt at random; nothing on other
/// ranks. Collective.
Division division_by(int ranks, const Cloud& cloud, const Options& options, unsigned deal) {
    MPI_Comm comm = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, rank() < ranks ? 0 : 1, 0, &comm);
    Division division;
    if (rank() < ranks) {
        std::vector<std::size_t> order(cloud.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::mt19937_64 random(deal);
        std::ranges::shuffle(order, random);
        Cloud mine{cloud.dimension};
        for (const std::size_t i : order)
            // Some ranks have no points in every other deal.
            if (static_cast<int>(random() % static_cast<unsigned>(ranks) / (deal % 2 + 1)) ==
                rank())
                mine.append(cloud, i);
        const Balance made =
            balance(Points(mine.coordinates, mine.dimension, mine.weights), comm, options);
        division.parts.resize(cloud.size());
        assign(made.cuts, Points(cloud.coordinates, cloud.dimension), division.parts);
        for (const Cut& cut : made.cuts.tree)
            for (const double at : cut.at)
                division.cuts.push_back(std::bit_cast<std::uint64_t>(at));
    }
    MPI_Comm_free(&comm);
    return division;
}

void expect_same_division(const Cloud& cloud, const Options& options) {
    const Division expected = division_by(1, cloud, options, 0);
    for (const int ranks : {2, 5, 8, 13, 64}) {
        if (ranks > num_ranks()) break;
        for (unsigned deal = 0; deal < 2; ++deal) {
            SCOPED_TRACE(testing::Message() << ranks << " ranks, deal " << deal);
            const Division division = division_by(ranks, cloud, options, deal);
            if (rank() == 0) {
                EXPECT_TRUE(division.parts == expected.parts);
                EXPECT_TRUE(division.cuts == expected.cuts);
            }
        }
    }
}

/// Options whose axes do not depend on estimates.
std::vector<Options> options_for(int dimension, int num_parts) {
    Options options{.num_parts = num_parts, .refine = Refine::exact};
    std::vector<int> axes;
    for (int k = 0; k + 1 < num_parts; ++k) axes.push_back(k % dimension);
    if (dimension > 1) options.expert.axes.order = AxisOrder::given(axes);
    Options by_many = options;
    by_many.expert.max_root_parts = 2;
    if (dimension == 2) by_many.expert.axes.order = AxisOrder::among({1});
    return {options, by_many};
}

/// Even, on lattice lines, in clusters, and with a third of the points in one place.
const Coordinate places[] = {
    [](int, double u) { return u * u; }, [](int, double u) { return std::floor(12 * u); },
    [](int, double u) { return std::floor(3 * u) + 0.01 * (3 * u - std::floor(3 * u)); },
    [](int i, double u) { return i % 3 == 0 ? 0.25 : u; }};
const Weight weights[] = {[](double) { return 0; }, [](double u) { return 1 + std::floor(9 * u); },
                          [](double u) { return std::ldexp(1 + std::floor(64 * u), -3); }};

TEST(AnyRanks, make_the_same_cuts) {
    unsigned seed = 0;
    for (const Coordinate& place : places)
        for (const Weight& weight : weights)
            for (int dimension = 1; dimension <= 3; ++dimension) {
                const int num_parts = 5 + static_cast<int>(++seed % 4) * 3;
                SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << dimension << "-D");
                const Cloud cloud = cloud_of(dimension, place, weight, seed, 600);
                for (const Options& options : options_for(dimension, num_parts)) {
                    SCOPED_TRACE(options.expert.max_root_parts);
                    expect_same_division(cloud, options);
                }
            }
}

// More candidates than are gathered at once: cuts end between bins or among ties.
TEST(AnyRanks, make_the_same_cuts_of_many_points) {
    for (const Coordinate& place : places)
        for (const Weight& weight : {weights[0], weights[1]}) {
            const Cloud cloud = cloud_of(2, place, weight, 5, 20000);
            for (const Options& options : options_for(2, 6)) expect_same_division(cloud, options);
        }
}

}  // namespace
}  // namespace rrcb
