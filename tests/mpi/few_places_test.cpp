// Look-ups of coincident points that cuts divide.
#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/balance.hpp>

namespace rrcb {
namespace {

/// Some points in few places, the same on every rank.
struct FewPlaces {
    int dimension = 1;
    std::vector<Vector> positions;
    std::vector<double> weights;

    explicit FewPlaces(std::mt19937_64& engine) : dimension(1 + static_cast<int>(engine() % 3)) {
        std::vector<Vector> places(1 + engine() % 6);
        for (Vector& place : places)
            for (int a = 0; a < dimension; ++a)
                place[static_cast<std::size_t>(a)] = static_cast<double>(engine() % 4);
        const auto kind = engine() % 4;
        for (auto count = 1 + engine() % 40; count > 0; --count) {
            positions.push_back(places[engine() % places.size()]);
            const double u = test::uniform(engine, 1e-3);
            const double heavy = u < 0.1 ? 20 : 1;
            weights.push_back(kind == 0   ? 1
                              : kind == 1 ? std::pow(u, -0.7)
                              : kind == 2 ? std::floor(3 * u)
                                          : heavy);
        }
    }
};

/// Points of a rank, with their indices in FewPlaces.
struct Held {
    std::vector<std::size_t> indices;
    std::vector<double> coordinates, weights;
    int dimension;

    Held(const FewPlaces& few, const std::vector<int>& homes) : dimension(few.dimension) {
        weights.reserve(1);
        for (std::size_t i = 0; i < homes.size(); ++i) {
            if (homes[i] != rank()) continue;
            const Vector& x = few.positions[i];
            indices.push_back(i);
            coordinates.insert(coordinates.end(), x.begin(), x.begin() + dimension);
            weights.push_back(few.weights[i]);
        }
    }

    Points points() const { return Points(coordinates, dimension, weights); }

    /// Returns the parts of the points of all ranks. Collective.
    std::vector<Part> all(const std::vector<Part>& parts, std::size_t count) const {
        std::vector<Part> result(count, 0);
        for (std::size_t k = 0; k < indices.size(); ++k) result[indices[k]] = parts[k];
        MPI_Allreduce(MPI_IN_PLACE, result.data(), static_cast<int>(count), MPI_INT, MPI_SUM,
                      MPI_COMM_WORLD);
        return result;
    }
};

Options options_from(std::mt19937_64& engine) {
    Options options;
    options.num_parts = engine() % 4 == 0 ? num_ranks() : 2 + static_cast<int>(engine() % 10);
    options.expert.coincident = Coincident::divide;
    options.refine = engine() % 2 == 0 ? Refine::exact : Refine::tolerance;
    options.expert.max_root_parts = engine() % 2 == 0 ? 2 : 4096;
    if (engine() % 3 == 0)
        for (int k = 0; k < options.num_parts; ++k)
            options.part_sizes.push_back(test::uniform(engine, 0.05));
    if (engine() % 3 == 0)
        options.expert.tree = {1 + static_cast<int>(engine() % 3), engine() % 2 == 0};
    return options;
}

/// Expects look-ups to find one of the parts of each place, and boxes all of them. Collective.
void expect_found(const FewPlaces& few, const Held& held, const Balance& result) {
    const std::vector<Part> parts = held.all(result.parts, few.positions.size());
    std::map<Vector, std::set<Part>> of_places;
    for (std::size_t i = 0; i < parts.size(); ++i) of_places[few.positions[i]].insert(parts[i]);
    const std::vector<Part> found = assign(result.cuts, held.points(), MPI_COMM_WORLD);
    const Cuts& cuts = result.cuts;
    std::vector<Part> assigned(held.indices.size());
    assign(cuts, held.points(), assigned);
    EXPECT_EQ(found, assigned);
    for (std::size_t k = 0; k < found.size(); ++k) {
        const Vector& x = few.positions[held.indices[k]];
        EXPECT_TRUE(of_places[x].contains(found[k]));
        EXPECT_EQ(part_of(cuts, x), found[k]);
        const std::vector<Part> touched = parts_touching(cuts, {x, x});
        EXPECT_TRUE(std::ranges::includes(touched, of_places[x]));
        EXPECT_TRUE(of_places[x].size() > 1 || touched.size() == 1);
    }
}

TEST(FewPlaces, are_looked_up_in_a_part_that_has_points_there) {
    std::mt19937_64 engine(1);
    for (int round = 0; round < 1500 / num_ranks(); ++round) {
        const FewPlaces few(engine);
        std::vector<int> homes;
        for (std::size_t i = 0; i < few.positions.size(); ++i)
            homes.push_back(static_cast<int>(engine() % static_cast<unsigned>(num_ranks())));
        const Options options = options_from(engine);
        const Held held(few, homes);
        const Balance first = balance(held.points(), MPI_COMM_WORLD, options);
        expect_found(few, held, first);
        expect_found(few, held, balance(held.points(), MPI_COMM_WORLD, options, first.cuts));
        if (options.num_parts == num_ranks()) {
            const Held moved(few, held.all(first.parts, few.positions.size()));
            expect_found(few, moved, balance(moved.points(), MPI_COMM_WORLD, options));
        }
        ASSERT_FALSE(HasFailure()) << "round " << round;
    }
}

}  // namespace
}  // namespace rrcb
