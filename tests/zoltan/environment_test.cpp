#include "program.hpp"

#include <cstdlib>

namespace rrcb::zoltan_test {
namespace {

using Settings = std::map<std::string, std::string>;

/// Variables that are gone at the end of the scope.
class Environment {
  public:
    explicit Environment(Settings settings) : settings_(std::move(settings)) {
        for (const auto& [name, value] : settings_) setenv(name.c_str(), value.c_str(), 1);
    }
    ~Environment() {
        for (const auto& [name, value] : settings_) unsetenv(name.c_str());
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

  private:
    Settings settings_;
};

struct Cloud : Program {
    Cloud() {
        scatter_points(*this, 3000);
        for (double& x : coordinates) x *= x;
        set({{"LB_METHOD", "RRCB"}, {"NUM_GLOBAL_PARTS", "6"}, {"RETURN_LISTS", "PARTS"}});
    }
};

std::vector<int> parts_with(const Settings& set_by_program) {
    Cloud program;
    for (const auto& [name, value] : set_by_program)
        EXPECT_EQ(program.set(name.c_str(), value), ZOLTAN_OK);
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    return parts_by_object(outcome);
}

/// Each has an effect.
const std::vector<Settings> samples = {
    {{"RRCB_REFINE", "none"}},
    {{"RRCB_REFINE", "NONE"}, {"RRCB_SUPPORT_MESH", "2"}},
    {{"RRCB_DOMAIN", "POINTS"}, {"RRCB_CUT_RULE", "MIDPOINT"}},
    {{"RRCB_DOMAIN", "POINTS"}},
    {{"RRCB_DOMAIN", "SAMPLED"}},
    {{"RRCB_DOMAIN", "SAMPLED"}, {"RRCB_SEED", "7"}},
    {{"RRCB_DOMAIN", "SAMPLED"}, {"RRCB_SAMPLE_FRACTION", "0.25"}},
    {{"RRCB_DOMAIN", "SAMPLED"}, {"RRCB_SIGMA_MULTIPLIER", "0.5"}},
};

TEST(Environment, gives_what_the_program_could_have_set) {
    // So that the first estimate is not good enough.
    const Settings strict = {{"IMBALANCE_TOL", "1.0001"}};
    const std::vector<int> defaults = parts_with(strict);
    for (const Settings& settings : samples) {
        SCOPED_TRACE(settings.begin()->second);
        Settings all = settings;
        all.insert(strict.begin(), strict.end());
        const std::vector<int> expected = parts_with(all);
        EXPECT_TRUE(differ_somewhere(expected, defaults));
        const Environment environment(settings);
        EXPECT_EQ(parts_with(strict), expected);
    }
    EXPECT_EQ(parts_with(strict), defaults);
}

TEST(Environment, gives_the_tolerance) {
    const std::vector<int> expected = parts_with({{"IMBALANCE_TOL", "1.0001"}});
    EXPECT_TRUE(differ_somewhere(expected, parts_with({})));
    const Environment environment(Settings{{"RRCB_IMBALANCE_TOL", "1.0001 "}});
    EXPECT_EQ(parts_with({}), expected);
}

TEST(Environment, gives_way_to_the_program) {
    const std::vector<int> defaults = parts_with({});
    const Environment environment(
        Settings{{"RRCB_DOMAIN", "POINTS"}, {"RRCB_IMBALANCE_TOL", "1.5"}});
    EXPECT_EQ(parts_with({{"RRCB_DOMAIN", "DEFAULT"}, {"IMBALANCE_TOL", "1.01"}}), defaults);
}

TEST(Environment, counts_for_handles_made_after_it) {
    Cloud before;
    const std::vector<int> expected = parts_with({});
    const Environment environment(Settings{{"RRCB_DOMAIN", "POINTS"}});
    EXPECT_EQ(parts_by_object(before.partition()), expected);
}

TEST(Environment, of_illegal_values_is_warned_of_once_and_leaves_the_default) {
    const std::vector<int> defaults = parts_with({});
    const int rank = Cloud().rank;
    for (const auto& [name, value] : Settings{{"RRCB_REFINE", "PERHAPS"},
                                              {"RRCB_IMBALANCE_TOL", "0.9"},
                                              {"RRCB_SUPPORT_MESH", "-1"},
                                              {"RRCB_SEED", "-1"}}) {
        const Environment environment(Settings{{name, value}});
        testing::internal::CaptureStderr();
        EXPECT_EQ(parts_with({}), defaults);
        EXPECT_EQ(parts_with({}), defaults);
        const std::string said = testing::internal::GetCapturedStderr();
        const auto found = said.find(name);
        EXPECT_EQ(found != said.npos, rank == 0) << said;
        if (rank == 0) {
            EXPECT_EQ(said.find(name, found + 1), said.npos) << said;
        }
    }
}

TEST(Environment, that_is_empty_sets_nothing) {
    const std::vector<int> defaults = parts_with({});
    const Environment environment(Settings{{"RRCB_REFINE", ""}, {"RRCB_IMBALANCE_TOL", ""}});
    EXPECT_EQ(parts_with({}), defaults);
}

}  // namespace
}  // namespace rrcb::zoltan_test
