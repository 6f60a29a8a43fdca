#pragma once

#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/quality.hpp>

namespace rrcb::test {

/// Points of which every rank knows all, and holds those that are its own.
struct HeldPoints {
    int dimension = 2;
    std::vector<double> coordinates;  ///< of all, interleaved
    std::vector<double> weights{};    ///< of all, or empty
    std::vector<Part> owners{};       ///< rank of each

    std::size_t count() const { return coordinates.size() / static_cast<std::size_t>(dimension); }

    /// Point i on rank i % num_ranks.
    void scatter() {
        owners.resize(count());
        for (std::size_t i = 0; i < owners.size(); ++i)
            owners[i] = static_cast<Part>(i % static_cast<std::size_t>(num_ranks()));
    }
};

/// What this rank holds.
struct Share {
    std::vector<double> coordinates;
    std::vector<double> weights;
    std::vector<std::size_t> indices;
    int dimension;

    explicit Share(const HeldPoints& all) : dimension(all.dimension) {
        const auto d = static_cast<std::size_t>(all.dimension);
        for (std::size_t i = 0; i < all.count(); ++i) {
            if (all.owners[i] != rank()) continue;
            indices.push_back(i);
            for (std::size_t a = 0; a < d; ++a) coordinates.push_back(all.coordinates[d * i + a]);
            if (!all.weights.empty()) weights.push_back(all.weights[i]);
        }
    }

    Points points() const { return Points(coordinates, dimension, weights); }
};

/// Divides the points by number, on each rank by itself, and gives them to the ranks of their
/// parts.
inline Balance divide_on_each_rank(HeldPoints& all, int num_parts) {
    Balance whole =
        balance(Points(all.coordinates, all.dimension), MPI_COMM_SELF, {.num_parts = num_parts});
    all.owners.clear();
    for (std::size_t i = 0; i < all.count(); ++i) {
        const RankRange ranks = ranks_of_part(whole.parts[i], num_parts, num_ranks());
        all.owners.push_back(ranks.first_rank + static_cast<Part>(i) % ranks.count);
    }
    return whole;
}

/// Of the ranks, by count where all weights are 0.
inline double imbalance_of(const HeldPoints& all, const Options& options) {
    const bool by_count = std::ranges::all_of(all.weights, [](double w) { return w == 0; });
    std::vector<double> weights(static_cast<std::size_t>(num_ranks()));
    for (std::size_t i = 0; i < all.count(); ++i)
        weights[static_cast<std::size_t>(all.owners[i])] += by_count ? 1 : all.weights[i];
    return imbalance(weights, options.part_sizes);
}

/// Gives each rank its part, of this rank's points told by `parts`; returns how many points of all
/// move. Collective.
inline std::size_t move_to(const std::vector<Part>& parts, HeldPoints& all) {
    const Share mine(all);
    std::vector<Part> owners(all.count(), -1);
    for (std::size_t i = 0; i < parts.size(); ++i) owners[mine.indices[i]] = parts[i];
    MPI_Allreduce(MPI_IN_PLACE, owners.data(), static_cast<int>(owners.size()), MPI_INT32_T,
                  MPI_MAX, MPI_COMM_WORLD);
    std::size_t num_moved = 0;
    for (std::size_t i = 0; i < owners.size(); ++i) num_moved += owners[i] == all.owners[i] ? 0 : 1;
    all.owners = std::move(owners);
    return num_moved;
}

/// What a call made of them.
struct Step {
    Balance balance;
    std::size_t num_moved = 0;  ///< over all ranks
    int num_strays = 0;         ///< of this rank's points: look-ups find another part
};

/// Balances the points and gives each rank its part. Collective.
inline Step balance_and_move(HeldPoints& all, const Options& options) {
    const Share mine(all);
    Step step{balance(mine.points(), MPI_COMM_WORLD, options)};
    for (std::size_t i = 0; i < mine.indices.size(); ++i) {
        const Vector x = mine.points().position(i);
        step.num_strays += part_of(step.balance.cuts, x) == step.balance.parts[i] ? 0 : 1;
    }
    step.num_moved = move_to(step.balance.parts, all);
    return step;
}

/// Inside the outline of a slope: a base of 110 x 15 below a crest of 30 x 20 with a face of 45
/// degrees.
inline bool is_in_slope(double x, double z) {
    return z <= 0 || z <= std::min(20.0, 50 - x);
}

/// Points of a slope on a lattice, row after row.
inline HeldPoints lattice_slope(double spacing) {
    HeldPoints all;
    for (double z = -15 + spacing / 2; z < 20; z += spacing)
        for (double x = spacing / 2; x < 110; x += spacing)
            if (is_in_slope(x, z)) all.coordinates.insert(all.coordinates.end(), {x, z});
    all.scatter();
    return all;
}

inline HeldPoints random_slope(std::size_t count) {
    HeldPoints all;
    std::mt19937_64 engine(5);
    while (all.count() < count) {
        const double x = uniform(engine, 0, 110);
        const double z = uniform(engine, -15, 20);
        if (is_in_slope(x, z)) all.coordinates.insert(all.coordinates.end(), {x, z});
    }
    all.scatter();
    return all;
}

}  // namespace rrcb::test
