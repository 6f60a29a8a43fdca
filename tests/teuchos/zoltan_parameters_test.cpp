#include "../support/ranks.hpp"
#include "../zoltan/program.hpp"

#include <rrcb/error.hpp>
#include <rrcb/teuchos/zoltan_parameters.hpp>
#include <rrcb/zoltan/rrcb_zoltan.h>

#include <gtest/gtest.h>

#include <set>

namespace rrcb::teuchos {
namespace {

using zoltan_test::Program;

std::set<std::string> names_in_valid_list() {
    std::set<std::string> names;
    const auto valid = valid_parameters();
    for (auto entry = valid->begin(); entry != valid->end(); ++entry)
        names.insert(valid->name(entry));
    return names;
}

TEST(ZoltanParameters, of_the_valid_list_are_those_of_the_plug_in_and_two_of_zoltan) {
    std::set<std::string> expected = {"IMBALANCE_TOL", "NUM_GLOBAL_PARTS"};
    for (const char* const* name = RRCB_Parameter_Names(); *name != nullptr; ++name)
        expected.insert(*name);
    EXPECT_EQ(names_in_valid_list(), expected);
}

TEST(ZoltanParameters, are_all_accepted_with_their_defaults) {
    Program program;
    EXPECT_EQ(set_parameters(program.zz, *valid_parameters()), ZOLTAN_OK);
}

TEST(ZoltanParameters, reach_the_plug_in) {
    Program program;
    scatter_points(program, 500);
    program.set("LB_METHOD", "RRCB");
    program.set("RETURN_LISTS", "PARTS");
    const auto defaults = program.partition().exports.parts;
    Teuchos::ParameterList list;
    list.set("NUM_GLOBAL_PARTS", 5);
    list.set("RRCB_DOMAIN", "SAMPLED");
    list.set("RRCB_SEED", 3);
    EXPECT_EQ(set_parameters(program.zz, list), ZOLTAN_OK);
    const auto from_list = program.partition().exports.parts;
    EXPECT_NE(from_list, defaults);

    Program other;
    scatter_points(other, 500);
    other.set("LB_METHOD", "RRCB");
    other.set("RETURN_LISTS", "PARTS");
    other.set("NUM_GLOBAL_PARTS", "5");
    other.set("RRCB_DOMAIN", "SAMPLED");
    other.set("RRCB_SEED", "3");
    EXPECT_EQ(from_list, other.partition().exports.parts);
}

TEST(ZoltanParameters, that_are_wrong_set_nothing) {
    Program program;
    scatter_points(program, 500);
    program.set("LB_METHOD", "RRCB");
    program.set("RETURN_LISTS", "PARTS");
    const auto defaults = program.partition().exports.parts;
    Teuchos::ParameterList list;
    list.set("NUM_GLOBAL_PARTS", 5);
    list.set("RRCB_SAMPLE_FRACTION", 3);
    EXPECT_THROW(set_parameters(program.zz, list), Error);
    EXPECT_EQ(program.partition().exports.parts, defaults);
}

}  // namespace
}  // namespace rrcb::teuchos
