// The exchanges between neighbours give the same points, ghosts and sums as the collective
// functions.
#include "../support/same_error.hpp"
#include "neighbours_cases.hpp"

#include <array>
#include <cstddef>
#include <cstdlib>

namespace rrcb {
namespace {

using test::NeighbourCase;
using test::NeighbourRun;

const MPI_Comm world = MPI_COMM_WORLD;

std::vector<NeighbourCase> cases() {
    std::vector<NeighbourCase> all;
    for (int dimension = 1; dimension <= 3; ++dimension)
        for (const Needs needs : {Needs::scatter, Needs::gather, Needs::symmetric})
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

TEST(Neighbours, find_the_same_by_the_boxes_of_the_parts) {
    for (NeighbourCase input : cases()) {
        input.has_boxes = true;
        ASSERT_EQ(NeighbourRun<double>(input).run(), "") << test::text_of(input);
    }
    for (const int num_parts : {1, num_ranks() / 2 + 1, 3 * num_ranks() + 1})
        for (const bool turns_parts : {false, true}) {
            const NeighbourCase input{.num_parts = num_parts,
                                      .is_periodic = num_parts > 1,
                                      .has_boxes = true,
                                      .turns_parts = turns_parts,
                                      .needs = Needs::symmetric};
            ASSERT_EQ(NeighbourRun<double>(input).run(), "") << test::text_of(input);
        }
}

TEST(Neighbours, take_floats) {
    NeighbourCase input{.dimension = 3, .is_periodic = true};
    EXPECT_EQ(NeighbourRun<float>(input).run(), "");
}

TEST(Neighbours, have_several_parts_or_share_one) {
    for (const int num_parts : {1, num_ranks() / 2 + 1, 3 * num_ranks() + 1})
        for (const bool turns_parts : {false, true})
            for (const Needs needs : {Needs::scatter, Needs::symmetric}) {
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

NeighbourCase random_case(unsigned seed) {
    std::mt19937_64 engine(seed);
    const auto one_of = [&](auto... values) {
        const std::array all{values...};
        return all[engine() % all.size()];
    };
    NeighbourCase input{.seed = seed};
    input.dimension = one_of(1, 2, 3);
    input.num_points =
        one_of(std::size_t{0}, std::size_t{1}, std::size_t{20}, std::size_t{300}, std::size_t{800});
    input.num_parts = one_of(0, 0, 1, num_ranks() + 2, 4 * num_ranks());
    input.radius = one_of(0.0, 1e-3, 0.05, 0.2, 1.5);
    input.travel = one_of(0.0, 0.01, 0.1, 2.0);
    input.has_radii = one_of(false, true);
    input.is_periodic = one_of(false, true);
    input.has_lattice = input.travel > 0.3 && one_of(false, false, true);
    input.has_boxes = !input.has_lattice && one_of(false, true);
    input.turns_parts = one_of(false, false, true);
    input.needs = one_of(Needs::scatter, Needs::scatter, Needs::gather, Needs::symmetric);
    input.num_steps = 3;
    return input;
}

// RRCB_TEST_CASES=1000 tries more.
TEST(Neighbours, agree_in_random_cases) {
    const char* const number = std::getenv("RRCB_TEST_CASES");
    const unsigned num_cases = number != nullptr ? static_cast<unsigned>(std::atoi(number)) : 15;
    for (unsigned seed = 1; seed <= num_cases; ++seed) {
        const NeighbourCase input = random_case(seed + 1000 * static_cast<unsigned>(num_ranks()));
        const std::string fault =
            seed % 3 == 0 ? NeighbourRun<float>(input).run() : NeighbourRun<double>(input).run();
        ASSERT_EQ(fault, "") << test::text_of(input);
    }
}

}  // namespace
}  // namespace rrcb
