// The paper's methods by RRCB_DOMAIN.
#include "program.hpp"

#include <rrcb/paper.hpp>

namespace rrcb::zoltan_test {
namespace {

using Settings = std::map<std::string, std::string>;

/// A program with points that crowd near the origin, the parts of which keep their numbers.
struct Crowded : Program {
    explicit Crowded(const Settings& settings) {
        scatter_points(*this, 600);
        for (double& x : coordinates) x *= x;
        for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = static_cast<float>(i % 4);
        set({{"LB_METHOD", "RRCB"}, {"OBJ_WEIGHT_DIM", "1"}, {"RETURN_LISTS", "PARTS"}});
        set({{"REMAP", "0"}, {"DEBUG_LEVEL", "1"}});
        for (const auto& [name, value] : settings) set(name.c_str(), value);
    }

    Points points(const std::vector<double>& as_doubles) const {
        return Points(coordinates, dimension, as_doubles);
    }
};

/// Parts by the plug-in, which must warn of nothing.
std::vector<int> parts_by(Crowded& program) {
    testing::internal::CaptureStderr();
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    return parts_by_object(outcome);
}

TEST(PaperDomains, give_the_parts_of_balance_as_in_paper) {
    const auto expect_same = [](Settings settings, std::function<void(PaperOptions&)> change) {
        for (const PaperDomain domain : {PaperDomain::sampled, PaperDomain::points}) {
            PaperOptions options;
            options.domain = domain;
            change(options);
            settings["RRCB_DOMAIN"] = domain == PaperDomain::sampled ? "SAMPLED" : "POINTS";
            Crowded program(settings);
            const std::vector<double> weights(program.weights.begin(), program.weights.end());
            const Balance expected =
                balance_as_in_paper(program.points(weights), MPI_COMM_WORLD, options);
            EXPECT_EQ(parts_by(program), expected.parts);
        }
    };
    expect_same({}, [](PaperOptions&) {});
    expect_same({{"RRCB_REFINE", "NONE"}}, [](PaperOptions&) {});
    expect_same({{"NUM_GLOBAL_PARTS", "11"}, {"RRCB_SUPPORT_MESH", "3"}}, [](PaperOptions& o) {
        o.num_parts = 11;
        o.cells_per_axis = 3;
    });
    expect_same({{"RRCB_CUT_RULE", "MIDPOINT"}, {"NUM_GLOBAL_PARTS", "6"}}, [](PaperOptions& o) {
        o.cut_rule = CutRule::midpoint;
        o.num_parts = 6;
    });
    expect_same({{"RRCB_SIGMA_MULTIPLIER", "2"},
                 {"RRCB_SAMPLE_FRACTION", "0.25"},
                 {"RRCB_SEED", "12345678901"},
                 {"RCB_RECTILINEAR_BLOCKS", "1"},
                 {"NUM_GLOBAL_PARTS", "6"}},
                [](PaperOptions& o) {
                    o.sigma_multiplier = 2;
                    o.sample_fraction = 0.25;
                    o.seed = 12345678901;
                    o.plain_cuts = true;
                    o.num_parts = 6;
                });
}

TEST(PaperDomains, keep_the_sizes_of_parts) {
    Crowded program({{"RRCB_DOMAIN", "POINTS"}, {"NUM_GLOBAL_PARTS", "3"}});
    int numbers[] = {0, 1, 2};
    float sizes[] = {2, 0, 1};
    Zoltan_LB_Set_Part_Sizes(program.zz, 1, program.rank == 0 ? 3 : 0, numbers, nullptr, sizes);
    PaperOptions options;
    options.domain = PaperDomain::points;
    options.num_parts = 3;
    options.part_sizes = {2, 0, 1};
    const std::vector<double> weights(program.weights.begin(), program.weights.end());
    EXPECT_EQ(parts_by(program),
              balance_as_in_paper(program.points(weights), MPI_COMM_WORLD, options).parts);
}

TEST(PaperDomains, take_more_parts_than_one_rank_makes_otherwise) {
    Crowded program({{"RRCB_DOMAIN", "POINTS"},
                     {"NUM_GLOBAL_PARTS", "9"},
                     {"RRCB_CENTRAL_PARTS", "2"},
                     {"KEEP_CUTS", "1"}});
    const std::vector<int> parts = parts_by(program);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Place place = program.place_of(&program.coordinates[2 * i]);
        EXPECT_EQ(place.code, ZOLTAN_OK);
        EXPECT_EQ(place.part, parts[i]);
    }
}

/// Runs calls on points that move in between; returns the parts of the last.
std::vector<int> parts_of_third_call(const Settings& settings) {
    Crowded program(settings);
    program.partition();
    program.partition();
    for (std::size_t i = 0; i < program.coordinates.size(); i += 2)
        program.coordinates[i] *= 3 * program.coordinates[i];
    return parts_by_object(program.partition());
}

TEST(PaperDomains, ignore_settings_of_rcb_and_of_refinement_with_a_warning) {
    for (const char* domain : {"SAMPLED", "POINTS"}) {
        const auto expected = parts_of_third_call(Settings{{"RRCB_DOMAIN", domain}});
        for (const auto& [name, value] : Settings{{"RCB_REUSE", "1"},
                                                  {"RCB_LOCK_DIRECTIONS", "1"},
                                                  {"RCB_SET_DIRECTIONS", "2"},
                                                  {"RRCB_REFINE", "EXACT"}}) {
            testing::internal::CaptureStderr();
            EXPECT_EQ(parts_of_third_call({{"RRCB_DOMAIN", domain}, {name, value}}), expected);
            const std::string said = testing::internal::GetCapturedStderr();
            const bool warned = said.find(name + " has no effect") != said.npos;
            EXPECT_EQ(warned, Program().rank == 0) << said;
        }
    }
}

TEST(CutRuleParameter, is_ignored_by_rrcbs_own_method_with_a_warning) {
    Crowded plain(Settings{});
    const std::vector<int> expected = parts_by(plain);
    Crowded program(Settings{{"RRCB_CUT_RULE", "MIDPOINT"}});
    testing::internal::CaptureStderr();
    EXPECT_EQ(parts_by_object(program.partition()), expected);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(said.find("RRCB_CUT_RULE has no effect") != said.npos, program.rank == 0) << said;
}

TEST(PaperDomains, refuse_limits_of_cuts_and_name_the_way_out) {
    for (const auto& [name, value] :
         Settings{{"RRCB_MIN_WIDTH", "0.1 0.1"}, {"RRCB_GRID", "0 0.1, 0 0.1"}}) {
        Crowded program({{"RRCB_DOMAIN", "SAMPLED"}, {name, value}});
        testing::internal::CaptureStderr();
        EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
        const std::string said = testing::internal::GetCapturedStderr();
        EXPECT_EQ(said.find("need RRCB_DOMAIN=ANALYTIC") != said.npos, program.rank == 0) << said;
        program.set("RRCB_DOMAIN", "ANALYTIC");
        EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    }
}

}  // namespace
}  // namespace rrcb::zoltan_test
