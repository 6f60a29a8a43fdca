#include "sweep_settings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace comparisons {
namespace {

std::set<std::string> labels(const std::vector<Method>& settings) {
    std::set<std::string> names;
    for (const Method& method : settings) names.insert(method.label);
    return names;
}

TEST(SweepSettings, cover_every_method) {
    const std::set<std::string> names = labels(cost_settings());
    EXPECT_EQ(names.size(), cost_settings().size());
    for (const Method& method : read_methods(method_names())) {
        EXPECT_TRUE(std::ranges::any_of(names, [&](const std::string& name) {
            return name == method.label || name.starts_with(method.label + '[');
        })) << method.label;
    }
}

TEST(SweepSettings, try_every_mesh_with_every_tolerance) {
    const std::set<std::string> names = labels(cost_settings());
    for (const char* name :
         {"rrcb", "rrcb[refine=none]", "rrcb[tol=1.1]", "rrcb[mesh=8]", "rrcb[mesh=32,tol=1.001]",
          "rrcb[mesh=2,refine=none]", "rrcb-exact", "rrcb-exact[mesh=16]"}) {
        EXPECT_TRUE(names.contains(name)) << name;
    }
    EXPECT_EQ(std::ranges::count_if(names,
                                    [](const std::string& n) {
                                        return n.starts_with("rrcb[") ||
                                               n.starts_with("rrcb-exact[") || n == "rrcb" ||
                                               n == "rrcb-exact";
                                    }),
              6 * 6);
}

TEST(SweepSettings, name_the_standard_ones_as_the_paper_s_grid_does) {
    const std::set<std::string> all = labels(study_settings(false));
    for (const std::string& name : labels(standard_settings())) {
        EXPECT_TRUE(all.contains(name)) << name;
    }
    EXPECT_EQ(all.size(), 80U + 4U);
}

TEST(SweepSettings, are_the_eighty_of_the_paper) {
    const std::set<std::string> names = labels(paper_settings(false));
    EXPECT_EQ(names.size(), 5U * 4U * 4U);
    EXPECT_TRUE(names.contains("rrcb-sampled[mesh=2,k=1,fraction=1]"));
    EXPECT_TRUE(names.contains("rrcb-sampled[mesh=10,k=2.5,fraction=0.125]"));
}

TEST(SweepSettings, quick_ones_are_among_the_paper_s) {
    const std::set<std::string> names = labels(paper_settings(false));
    for (const std::string& name : labels(paper_settings(true))) {
        EXPECT_TRUE(names.contains(name)) << name;
    }
}

TEST(SweepSettings, winning_ones_are_the_paper_s_four) {
    const std::set<std::string> names = labels(winning_settings());
    EXPECT_EQ(names, (std::set<std::string>{"rrcb-sampled[mesh=2,k=1.5,fraction=0.25]",
                                            "rrcb-sampled[mesh=4,k=2,fraction=0.125]",
                                            "rrcb-sampled[mesh=6,k=2,fraction=0.125]",
                                            "rrcb-sampled[mesh=8,k=2,fraction=0.125]"}));
    const std::set<std::string> all = labels(study_settings(false));
    for (const std::string& name : labels(repeated_settings(false))) {
        EXPECT_TRUE(all.contains(name)) << name;
    }
}

TEST(SweepSettings, call_each_setting_of_the_cycle_once) {
    EXPECT_EQ(labels(cycle_settings(false)).size(), cycle_settings(false).size());
    EXPECT_EQ(cycle_settings(false).size(), 5U * 2U + 3U + 4U);
}

}  // namespace
}  // namespace comparisons
