#pragma once

#include "../support/common.hpp"

#include <rrcb/paper.hpp>

#include <iosfwd>

namespace rrcb::test {

/// How the numbers of a point become coordinates.
enum class Space : std::int32_t {
    lattice,   ///< few values, so many ties
    unit,      ///< 0 ... 1
    far_off,   ///< 1e9 + 0 ... 1e-3
    tiny,      ///< subnormal
    huge,      ///< up to the largest double, of both signs
    decades,   ///< +-1e-90 ... 1e90
    clusters,  ///< two of them, 1e-6 wide and 1e6 apart
    flat       ///< one value
};

enum class Weights : std::int32_t {
    none,
    zero,
    few_values,
    decades,  ///< 1e-30 ... 1e30
    one_giant,
    passive,       ///< 1 or 1e-20
    many_decades,  ///< 1e-300 ... 1e300
    subnormal      ///< 0, subnormal numbers, or 1e-300
};

/// How numbers from 0 to 4 become sizes of parts; 0 stays 0.
enum class Sizes : std::int32_t {
    few_values,
    tiny,          ///< 1e-5 or 1
    decades,       ///< 1e-6 ... 1
    many_decades,  ///< 1e-300 ... 1e300
    subnormal      ///< subnormal numbers, or 1
};

enum class Owners : std::int32_t { scattered, blocks, one_rank };

/// Whole numbers that make up a point; shrinking takes them to 0.
struct Seed {
    std::array<std::int32_t, 3> position{};
    std::int32_t weight = 0;
    std::int32_t owner = 0;
};

/// A call of the balancer, with the points of all ranks; known to every rank.
struct Case {
    struct Shape {
        std::int32_t dimension = 1;
        std::int32_t copies = 1;  ///< of each point, displaced
        std::array<Space, 3> spaces{};
        Weights weights = Weights::none;
        Sizes sizes = Sizes::few_values;
        Owners owners = Owners::scattered;
        std::int32_t num_parts = 1;
        Refine refine = Refine::tolerance;
        std::int32_t support_mesh = 0;
        std::int32_t central_parts = 0;  ///< 0: as by default, so that rank 0 makes all parts
        double tolerance = 1.01;
        std::int32_t plain_cuts = 0;
        std::int32_t group_size = 1;
        std::int32_t larger_below = 0;
        std::int32_t choice = 0;  ///< free for a property: lists, ids, ...
    };
    Shape shape;
    std::vector<std::int32_t> part_sizes;  ///< empty: equal
    std::vector<Seed> seeds;

    Options options() const;
    PaperOptions paper_options() const;  ///< the free number chooses what `shape` has no field for
};

std::ostream& operator<<(std::ostream& out, const Case& input);

/// All points of a case, one after another, and the rank that holds each.
struct Cloud {
    int dimension = 1;
    std::vector<double> coordinates;
    std::vector<double> weights;  ///< empty: every point weighs 1
    std::vector<int> owners;

    LocalIndex size() const { return owners.size(); }
    Points points() const { return Points(coordinates, dimension, weights); }
    /// Indices of the points that `rank` holds, ascending.
    std::vector<LocalIndex> held_by(int rank) const;
    /// Those points alone.
    Cloud of_rank(int rank) const;
};

Cloud cloud_of(const Case& input, int num_ranks);

/// Makes `input` that of rank 0 everywhere. Collective.
void broadcast(Case& input, MPI_Comm comm);

}  // namespace rrcb::test
