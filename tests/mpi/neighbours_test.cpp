// The exchanges between neighbours give the same points, ghosts and sums as the collective
// functions.
#include "../support/same_error.hpp"
#include "neighbours_cases.hpp"

#include <cstddef>

namespace rrcb {
namespace {

using test::NeighbourCase;
using test::NeighbourRun;
using test::num_ranks;
using test::rank;

const MPI_Comm world = MPI_COMM_WORLD;

std::vector<NeighbourCase> cases() {
    std::vector<NeighbourCase> all;
    for (int dimension = 1; dimension <= 3; ++dimension)
        for (const Needs needs : {Needs::sender, Needs::receiver, Needs::either})
            for (const bool is_periodic : {false, true})
                for (const bool has_radii : {false, true})
                    all.push_back({.seed = static_cast<unsigned>(all.size() + 1),
                                   .dimension = dimension,
                                   .radius = dimension == 1 ? 0.05 : 0.12,
                                   .has_radii = has_radii,
                                   .is_periodic = is_periodic,
                                   .needs = needs});
    return all;
}

TEST(Neighbours, find_the_points_and_ghosts_of_the_collective_functions) {
    for (const NeighbourCase& input : cases())
        ASSERT_EQ(NeighbourRun<double>(input).run(), "") << test::text_of(input);
}

TEST(Neighbours, take_floats) {
    NeighbourCase input{.dimension = 3, .is_periodic = true};
    EXPECT_EQ(NeighbourRun<float>(input).run(), "");
}

TEST(Neighbours, have_several_parts_or_share_one) {
    for (const int num_parts : {1, num_ranks() / 2 + 1, 3 * num_ranks() + 1})
        for (const bool turns_parts : {false, true})
            for (const Needs needs : {Needs::sender, Needs::either}) {
                const NeighbourCase input{.dimension = 2,
                                          .num_parts = num_parts,
                                          .is_periodic = num_parts > 1,
                                          .turns_parts = turns_parts,
                                          .needs = needs};
                ASSERT_EQ(NeighbourRun<double>(input).run(), "") << test::text_of(input);
            }
}

TEST(Neighbours, keep_divided_coincident_points) {
    EXPECT_EQ(NeighbourRun<double>({.travel = 0.3, .has_lattice = true, .num_steps = 2}).run(), "");
}

TEST(Neighbours, may_lack_points) {
    EXPECT_EQ(NeighbourRun<double>({.num_points = 3}).run(), "");
    EXPECT_EQ(NeighbourRun<double>({.num_points = 0}).run(), "");
}

}  // namespace
}  // namespace rrcb
