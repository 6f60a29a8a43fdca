#include "callbacks_mpi.hpp"
#include "checks_mpi.hpp"
#include "hard_clouds.hpp"

#include <cmath>

namespace rrcb::hard_test {
namespace {

using test::num_ranks;
using zoltan_test::Outcome;
using zoltan_test::Program;

/// Imbalance of the parts that a call gives 600 objects of weight 1.
double imbalance_after_a_call(Program& program, const Share& share) {
    const int num_parts = parts_for(num_ranks());
    program.set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
    program.set("RETURN_LISTS", "PARTS");
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    const auto all = join_parts(share, parts_of(program, outcome), 600, num_parts);
    return imbalance_of(find_cloud("coincident"), all, num_parts);
}

TEST(CallbackPositions, that_moments_cannot_tell_are_refined) {
    // As in Positions: two clumps in the one cell of each rank's mesh.
    Cloud cloud = find_cloud("coincident");
    cloud.position = [](int i) {
        const double where = uniform(i, 0);
        const double clump = where < 0.7 ? 0.28 : 0.88;
        return Vector{where < 0.9 ? clump + 0.04 * uniform(i, 1) : uniform(i, 1),
                      0.01 * uniform(i, 2)};
    };
    const Share share = scattered_share(cloud);
    Program program;
    program.set("LB_METHOD", "RRCB");
    program.set("RRCB_SUPPORT_MESH", "1");
    program.set("IMBALANCE_TOL", std::to_string(asked_tolerance));
    fill(program, share);
    program.set("RRCB_REFINE", "NONE");
    EXPECT_GT(imbalance_after_a_call(program, share), 1.1);
    program.set("RRCB_REFINE", "TOLERANCE");
    EXPECT_LE(imbalance_after_a_call(program, share), asked_tolerance);
}

TEST(CallbackPositions, outside_every_earlier_box_are_divided_from_earlier_cuts) {
    const Share earlier = scattered_share(find_cloud("spiral"));
    for (const double distance : {-1e7, 3e3, 1e150}) {
        Program program;
        program.set("LB_METHOD", "RRCB");
        program.set("KEEP_CUTS", "1");
        program.set("RCB_REUSE", "1");
        program.set("IMBALANCE_TOL", "1.01");
        fill(program, earlier);
        imbalance_after_a_call(program, earlier);
        Share later = earlier;
        for (double& x : later.coordinates) x = distance + std::abs(distance) * 1e-3 * x;
        fill(program, later);
        EXPECT_LE(imbalance_after_a_call(program, later), 1.01 + parts_for(num_ranks()) / 600.0);
    }
}

}  // namespace
}  // namespace rrcb::hard_test
