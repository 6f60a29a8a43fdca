#include "method.hpp"

#include "failure.hpp"

#include <gtest/gtest.h>

namespace comparisons {
namespace {

std::string error_of(const std::string& text) {
    try {
        read_methods(text);
    } catch (const Failure& failure) {
        return failure.what();
    }
    return "no error";
}

TEST(Method, reads_parameters_in_brackets) {
    const std::vector<Method> methods =
        read_methods("rrcb-sampled[mesh=6,k=2,fraction=0.25,seed=9,cut=midpoint],zoltan-rcb");
    ASSERT_EQ(methods.size(), 2U);
    const ZoltanParameters expected = {{"DEBUG_LEVEL", "0"},
                                       {"LB_METHOD", "RRCB"},
                                       {"RETURN_LISTS", "EXPORT"},
                                       {"RRCB_DOMAIN", "SAMPLED"},
                                       {"RRCB_SUPPORT_MESH", "6"},
                                       {"RRCB_CUT_RULE", "MIDPOINT"},
                                       {"RRCB_REFINE", "NONE"},
                                       {"RRCB_SIGMA_MULTIPLIER", "2"},
                                       {"RRCB_SAMPLE_FRACTION", "0.25"},
                                       {"RRCB_SEED", "9"}};
    EXPECT_EQ(zoltan_parameters(methods[0], Lists::exports), expected);
    EXPECT_EQ(methods[1].label, "zoltan-rcb");
}

TEST(Method, reads_how_far_to_refine) {
    const ZoltanParameters expected = {{"DEBUG_LEVEL", "0"},          {"LB_METHOD", "RRCB"},
                                       {"RETURN_LISTS", "PARTS"},     {"RRCB_DOMAIN", "ANALYTIC"},
                                       {"RRCB_CUT_RULE", "WEIGHTED"}, {"RRCB_REFINE", "TOLERANCE"},
                                       {"IMBALANCE_TOL", "1.001"}};
    EXPECT_EQ(zoltan_parameters(read_method("rrcb[refine=tolerance,tol=1.001]"), Lists::parts),
              expected);
}

TEST(Method, leaves_zoltan_at_its_defaults) {
    const ZoltanParameters expected = {
        {"DEBUG_LEVEL", "0"}, {"LB_METHOD", "HSFC"}, {"RETURN_LISTS", "ALL"}};
    EXPECT_EQ(zoltan_parameters(read_method("zoltan-hsfc"), Lists::all), expected);
}

TEST(Method, names_what_is_unknown) {
    EXPECT_EQ(error_of("zoltan-rcb,magic"),
              "--methods: unknown method 'magic'; choose from: " + method_names());
    EXPECT_EQ(error_of("rrcb[k=2]"),
              "--methods: rrcb has no parameter 'k'; it takes mesh, cut, refine, tol");
    EXPECT_EQ(error_of("zoltan-rcb[mesh=2]"),
              "--methods: zoltan-rcb has no parameter 'mesh'; it takes none");
}

TEST(Method, names_values_out_of_range) {
    EXPECT_EQ(error_of("rrcb[mesh=0]"),
              "--methods: rrcb[mesh=0]: mesh must be an integer, 1 ... 1024, not '0'");
    EXPECT_EQ(
        error_of("rrcb-sampled[fraction=1.5]"),
        "--methods: rrcb-sampled[fraction=1.5]: fraction must be a number above 0, at most 1, "
        "not '1.5'");
    EXPECT_EQ(error_of("rrcb-sampled[k=nan]"),
              "--methods: rrcb-sampled[k=nan]: k must be a number above 0, not 'nan'");
    EXPECT_EQ(error_of("rrcb-sampled[seed]"),
              "--methods: rrcb-sampled[seed]: seed must be an integer, 0 or more, not ''");
    EXPECT_EQ(error_of("rrcb[cut=half]"),
              "--methods: rrcb[cut=half]: cut must be weighted or midpoint, not 'half'");
}

TEST(Method, names_malformed_lists) {
    EXPECT_EQ(error_of("rrcb[mesh=2"), "--methods: 'rrcb[mesh=2' lacks the closing bracket");
    EXPECT_EQ(error_of("rrcb,rrcb"), "--methods: 'rrcb' is named twice; name it once");
}

}  // namespace
}  // namespace comparisons
