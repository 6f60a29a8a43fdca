#include "../support/ranks.hpp"
#include "../zoltan/program.hpp"
#include "methods.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

namespace rrcb::hard_test {
namespace {

using test::is_last_rank;
using test::num_ranks;
using zoltan_test::Outcome;
using zoltan_test::Program;

constexpr const char* callbacks[] = {"NUM_OBJ", "OBJ_LIST", "NUM_GEOM", "GEOM_MULTI"};

void set_parameters(Program& program, const Method& method) {
    program.set("LB_METHOD", "RRCB");
    program.set("OBJ_WEIGHT_DIM", "1");
    program.set("RRCB_DOMAIN", method.domain_name);
    program.set("RRCB_REFINE", method.refine_name);
}

/// Every method gives every rank `code` and no lists, and then works again.
void expect_code(int code, const std::function<void(Program&)>& break_it) {
    for (const Method& method : methods) {
        SCOPED_TRACE(std::string(method.domain_name) + " " + method.refine_name);
        Program program;
        scatter_points(program, 50);
        const std::vector<double> coordinates = program.coordinates;
        const std::vector<float> weights = program.weights;
        set_parameters(program, method);
        if (is_last_rank()) break_it(program);
        const Outcome failed = program.partition();
        EXPECT_EQ(failed.code, code);
        EXPECT_FALSE(failed.imports.has_global_ids || failed.exports.has_global_ids);

        program.fault = nullptr;
        program.count_offset = 0;
        program.coordinates = coordinates;
        program.weights = weights;
        EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    }
}

TEST(CallbackErrors, coordinates_that_are_not_finite) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        expect_code(ZOLTAN_FATAL, [&](Program& program) { program.coordinates[31] = bad; });
}

TEST(CallbackErrors, weights_that_are_negative_or_not_finite) {
    for (const float bad :
         {-1e-30F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
        expect_code(ZOLTAN_FATAL, [&](Program& program) { program.weights[7] = bad; });
}

TEST(CallbackErrors, codes_of_callbacks) {
    for (const std::string faulty : callbacks)
        for (const int code : {ZOLTAN_FATAL, ZOLTAN_MEMERR})
            expect_code(code, [&](Program& program) {
                program.fault = [=](const std::string& name, int& result) {
                    if (name == faulty) result = code;
                };
            });
}

TEST(CallbackErrors, callbacks_that_throw) {
    for (const std::string faulty : callbacks)
        expect_code(ZOLTAN_FATAL, [&](Program& program) {
            program.fault = [=](const std::string& name, int&) {
                if (name == faulty) throw std::runtime_error("thrown by the test");
            };
        });
}

TEST(CallbackErrors, a_negative_number_of_objects) {
    expect_code(ZOLTAN_FATAL, [](Program& program) { program.count_offset = -1000; });
}

/// All ranks fail; rank 0 names the parameter.
void expect_difference(const std::string& name, const char* value) {
    SCOPED_TRACE(name);
    Program program;
    scatter_points(program, 50);
    set_parameters(program, methods[4]);
    if (is_last_rank()) program.set(name.c_str(), value);
    testing::internal::CaptureStderr();
    const int code = program.partition().code;
    const std::string printed = testing::internal::GetCapturedStderr();
    EXPECT_EQ(code, ZOLTAN_FATAL);
    const bool names_it = printed.find(name + " differs between ranks") != printed.npos;
    EXPECT_EQ(names_it, program.rank == 0) << printed;
}

TEST(CallbackErrors, parameters_that_differ_between_ranks) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    constexpr std::pair<const char*, const char*> others[] = {{"NUM_GID_ENTRIES", "2"},
                                                              {"NUM_LID_ENTRIES", "2"},
                                                              {"OBJ_WEIGHT_DIM", "0"},
                                                              {"AUTO_MIGRATE", "1"},
                                                              {"REMAP", "0"},
                                                              {"RCB_REUSE", "1"},
                                                              {"RCB_LOCK_DIRECTIONS", "1"},
                                                              {"RCB_SET_DIRECTIONS", "3"},
                                                              {"RCB_RECTILINEAR_BLOCKS", "1"},
                                                              {"IMBALANCE_TOL", "1.3"},
                                                              {"RRCB_DOMAIN", "ANALYTIC"},
                                                              {"RRCB_REFINE", "EXACT"},
                                                              {"RRCB_CUT_RULE", "MIDPOINT"},
                                                              {"RRCB_SUPPORT_MESH", "9"},
                                                              {"RRCB_SIGMA_MULTIPLIER", "2"},
                                                              {"RRCB_SAMPLE_FRACTION", "0.5"},
                                                              {"RRCB_SEED", "5"}};
    for (const auto& [name, value] : others) expect_difference(name, value);
}

}  // namespace
}  // namespace rrcb::hard_test
