#include "method.hpp"

#include "failure.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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
                                       {"RRCB_SIGMA_MULTIPLIER", "2"},
                                       {"RRCB_SAMPLE_FRACTION", "0.25"},
                                       {"RRCB_SEED", "9"}};
    EXPECT_EQ(zoltan_parameters(methods[0], Lists::exports), expected);
    EXPECT_EQ(methods[1].label, "zoltan-rcb");
}

TEST(Method, sets_nothing_else_of_zoltan) {
    const std::pair<const char*, ZoltanParameters> cases[] = {
        {"rrcb[refine=tolerance,tol=1.001]",
         {{"DEBUG_LEVEL", "0"},
          {"LB_METHOD", "RRCB"},
          {"RETURN_LISTS", "ALL"},
          {"RRCB_REFINE", "TOLERANCE"},
          {"IMBALANCE_TOL", "1.001"}}},
        {"zoltan-hsfc", {{"DEBUG_LEVEL", "0"}, {"LB_METHOD", "HSFC"}, {"RETURN_LISTS", "ALL"}}},
        {"rrcb-arrays[mesh=3]",
         {{"function", "rrcb::balance"},
          {"RRCB_SUPPORT_MESH", "3"},
          {"RRCB_REFINE", "TOLERANCE"}}}};
    for (const auto& [name, expected] : cases)
        EXPECT_EQ(zoltan_parameters(read_method(name), Lists::all), expected) << name;
}

TEST(Method, compares_four_by_default) {
    std::vector<std::string> labels;
    for (const Method& method : default_methods()) labels.push_back(method.label);
    const std::vector<std::string> expected = {
        "zoltan-rcb", "rrcb-sampled[mesh=8,k=2,fraction=0.125]", "rrcb", "rrcb-exact"};
    EXPECT_EQ(labels, expected);
}

TEST(Method, compares_every_method_in_its_best_settings_if_asked_for_all) {
    std::vector<std::string> labels;
    for (const Method& method : all_methods()) {
        if (method.label != "zoltan2-mj") labels.push_back(method.label);
    }
    const std::vector<std::string> expected = {"zoltan-rcb",
                                               "zoltan-rcb[reuse]",
                                               "zoltan-rib",
                                               "zoltan-hsfc",
                                               "hilbert-counts",
                                               "root-rcb",
                                               "rrcb-sampled[mesh=2,k=1.5,fraction=0.25]",
                                               "rrcb-sampled[mesh=4,k=2,fraction=0.125]",
                                               "rrcb-sampled[mesh=6,k=2,fraction=0.125]",
                                               "rrcb-sampled[mesh=8,k=2,fraction=0.125]",
                                               "rrcb[tol=1.1]",
                                               "rrcb[tol=1.05]",
                                               "rrcb",
                                               "rrcb[tol=1.001]",
                                               "rrcb-exact",
                                               "rrcb-arrays"};
    EXPECT_EQ(labels, expected);
}

TEST(Method, varies_with_the_seed_unless_it_is_given) {
    const Method open = read_method("rrcb-sampled[mesh=2]");
    EXPECT_TRUE(varies_with_seed(open));
    EXPECT_EQ(with_next_seed(open, 3).seed(), open.seed() + 3);
    for (const char* name : {"rrcb-sampled[seed=1]", "root-rcb"}) {
        const Method fixed = read_method(name);
        EXPECT_FALSE(varies_with_seed(fixed)) << name;
        EXPECT_EQ(with_next_seed(fixed, 3).seed(), fixed.seed()) << name;
    }
    for (const char* name : {"rrcb", "rrcb-arrays"})
        EXPECT_FALSE(varies_with_seed(read_method(name))) << name;
    EXPECT_FALSE(varies_with_seed(read_method("zoltan-rcb")));
}

TEST(Method, starts_from_its_last_cuts_where_asked) {
    const ZoltanParameters reuses = zoltan_parameters(read_method("rrcb[tol=1.05,reuse]"), {});
    const std::pair<std::string, std::string> expected{"RCB_REUSE", "1"};
    EXPECT_EQ(std::ranges::count(reuses, expected), 1);
    EXPECT_EQ(std::ranges::count(zoltan_parameters(read_method("rrcb"), {}), expected), 0);
    EXPECT_EQ(error_of("rrcb[reuse=1]"), "--methods: rrcb[reuse=1]: reuse takes no value");
    const ZoltanParameters locks = zoltan_parameters(read_method("zoltan-rcb[reuse,lock]"), {});
    EXPECT_EQ(std::ranges::count(locks, expected), 1);
    const std::pair<std::string, std::string> locked("RCB_LOCK_DIRECTIONS", "1");
    EXPECT_EQ(std::ranges::count(locks, locked), 1);
    EXPECT_EQ(std::ranges::count(reuses, locked), 0);
}

TEST(Method, names_what_is_unknown) {
    EXPECT_EQ(error_of("zoltan-rcb,magic"),
              "--methods: unknown method 'magic'; choose from: " + method_names());
    EXPECT_EQ(error_of("rrcb[k=2]"),
              "--methods: rrcb has no parameter 'k'; it takes mesh, refine, tol, reuse, central, "
              "machines, axes");
    EXPECT_EQ(error_of("zoltan-rib[mesh=2]"),
              "--methods: zoltan-rib has no parameter 'mesh'; it takes none");
    EXPECT_EQ(error_of("rrcb[mesh=2"), "--methods: 'rrcb[mesh=2' lacks the closing bracket");
    EXPECT_EQ(error_of("rrcb,rrcb"), "--methods: 'rrcb' is named twice; name it once");
}

TEST(Method, names_values_out_of_range) {
    EXPECT_EQ(error_of("rrcb[mesh=-1]"),
              "--methods: rrcb[mesh=-1]: mesh must be a whole number from 1 to 4096, not '-1'");
    EXPECT_EQ(
        error_of("rrcb-sampled[fraction=1.5]"),
        "--methods: rrcb-sampled[fraction=1.5]: fraction must be a number above 0, at most 1, "
        "not '1.5'");
    EXPECT_EQ(error_of("rrcb-sampled[k=nan]"),
              "--methods: rrcb-sampled[k=nan]: k must be a number above 0, not 'nan'");
    EXPECT_EQ(error_of("rrcb-sampled[seed]"),
              "--methods: rrcb-sampled[seed]: seed must be a whole number, 0 or more, not ''");
    EXPECT_EQ(error_of("rrcb-sampled[mesh=auto]"),
              "--methods: rrcb-sampled[mesh=auto]: mesh must be a whole number from 1 to 4096, "
              "not 'auto'");
    EXPECT_EQ(error_of("root-rcb[cut=half]"),
              "--methods: root-rcb[cut=half]: cut must be WEIGHTED or MIDPOINT, not 'half'");
}

}  // namespace
}  // namespace comparisons
