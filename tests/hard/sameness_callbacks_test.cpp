#include "callbacks_mpi.hpp"
#include "floating_point.hpp"
#include "hard_clouds.hpp"

namespace rrcb::hard_test {
namespace {

using zoltan_test::Outcome;
using zoltan_test::Program;

Outcome outcome_of(const Cloud& cloud, const Method& method) {
    Program program(cloud.dimension);
    program.set("LB_METHOD", "RRCB");
    program.set("RRCB_DOMAIN", method.domain_name);
    program.set("RRCB_REFINE", method.refine_name);
    program.set("OBJ_WEIGHT_DIM", "1");
    program.set("RETURN_LISTS", "ALL");
    fill(program, scattered_share(cloud));
    return program.partition();
}

TEST(CallbackSameness, of_two_handles_with_the_same_objects) {
    for (const char* name : {"lattice", "cantor_dust", "weights_of_60_decades"}) {
        for (const Method& method : methods) {
            SCOPED_TRACE(std::string(name) + " " + method.domain_name + " " + method.refine_name);
            const Outcome one = outcome_of(find_cloud(name), method);
            const Outcome other = outcome_of(find_cloud(name), method);
            EXPECT_EQ(one.exports.global_ids, other.exports.global_ids);
            EXPECT_EQ(one.exports.parts, other.exports.parts);
            EXPECT_EQ(one.imports.global_ids, other.imports.global_ids);
        }
    }
}

TEST(CallbackSameness, of_the_arithmetic_is_asked_for) {
    if (test::num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    for (const Method& method : methods) {
        SCOPED_TRACE(std::string(method.domain_name) + " " + method.refine_name);
        {
            FloatingPoint here;
            if (test::is_last_rank()) here.round(FE_UPWARD);
            EXPECT_EQ(outcome_of(find_cloud("lattice"), method).code, ZOLTAN_FATAL);
        }
        EXPECT_EQ(outcome_of(find_cloud("lattice"), method).code, ZOLTAN_OK);
    }
}

}  // namespace
}  // namespace rrcb::hard_test
