#include "arguments.hpp"

#include "failure.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace comparisons {
namespace {

Arguments read(std::vector<std::string> texts) {
    texts.insert(texts.begin(), "rrcb_compare");
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    return read_arguments(static_cast<int>(pointers.size()), pointers.data());
}

/// Expects an error whose message begins with `start`.
void expect_error(std::vector<std::string> texts, const std::string& start) {
    try {
        read(std::move(texts));
        ADD_FAILURE() << "no error instead of: " << start;
    } catch (const Failure& failure) {
        EXPECT_EQ(std::string(failure.what()).substr(0, start.size()), start);
    }
}

TEST(Arguments, reads_a_comparison) {
    const Arguments arguments =
        read({"--cloud=lattice", "--points=900", "--dim=3", "--layout=scattered", "--lists=ALL",
              "--methods=rrcb,zoltan-rcb", "--repeats=3", "--seed=7", "--out=there", "--ranks=4"});
    EXPECT_EQ(arguments.cloud, "lattice");
    EXPECT_EQ(arguments.points, 900);
    EXPECT_EQ(arguments.dimension, 3);
    EXPECT_EQ(arguments.layout, Layout::scattered);
    EXPECT_EQ(arguments.lists, Lists::all);
    EXPECT_EQ(arguments.methods.size(), 2U);
    EXPECT_EQ(arguments.repeats, 3);
    EXPECT_EQ(arguments.seed, 7U);
    EXPECT_EQ(arguments.out, "there");
    EXPECT_EQ(arguments.ranks, 4);
}

TEST(Arguments, take_a_scene_by_its_name_or_file) {
    EXPECT_EQ(read({}).scene, "slope");
    EXPECT_EQ(read({"--scene=torpedo_anchor"}).scene, "torpedo_anchor");
    EXPECT_EQ(read({"--scene=my/own.yaml"}).scene, "my/own.yaml");
}

TEST(Arguments, compare_settings_unless_methods_are_named) {
    EXPECT_EQ(read({"--cloud=slope"}).methods.size(), default_methods().size());
    EXPECT_EQ(read({"--quick"}).methods.size(), default_methods().size());
    EXPECT_EQ(read({"--methods=all"}).methods.size(), all_methods().size());
    EXPECT_EQ(read({"--methods=rrcb-arrays[tol=1.1]"}).methods.size(), 1U);
}

TEST(Arguments, choose_what_of_a_scene_is_run) {
    EXPECT_EQ(read({}).only, Only::all);
    EXPECT_EQ(read({"--only=calls"}).only, Only::calls);
    const Arguments serial = read({"--only=simulations", "--methods=none", "--no-data"});
    EXPECT_EQ(serial.only, Only::simulations);
    EXPECT_TRUE(serial.methods.empty());
    EXPECT_FALSE(serial.data);
}

TEST(Arguments, name_what_is_unknown) {
    expect_error({"--clod=slope"}, "Error, the 1st option '--clod=slope' was not recognized");
    expect_error({"--cloud=fog"}, "--cloud: unknown cloud 'fog'; choose from: uniform");
    expect_error({"--scene=cliff"},
                 "--scene: unknown value 'cliff'; choose from: slope, submarine");
    expect_error({"--scene=cliff.txt"}, "--scene: unknown value 'cliff.txt'; choose from: slope");
    expect_error({"--methods=rrcb,magic"},
                 "--methods: unknown method 'magic'; choose from: zoltan-rcb");
    expect_error({"--cloud=slope", "--layout=tidy"},
                 "--layout: unknown value 'tidy'; choose from: sorted, scattered");
    expect_error({"--lists=NONE"},
                 "--lists: unknown value 'NONE'; choose from: PARTS, EXPORT, ALL");
    expect_error({"--only=some"}, "--only: unknown value 'some'; choose from: calls, simulations");
}

TEST(Arguments, name_options_without_a_value) {
    expect_error({"--cloud", "--quick"}, "--cloud needs a value: --cloud=...; generated points");
    expect_error({"--file="}, "--file needs a value: --file=...; CSV file of points");
}

TEST(Arguments, name_values_out_of_range) {
    expect_error({"--cloud=slope", "--points=1e6"},
                 "--points must be an integer from 1 to 2000000000, not '1e6'");
    expect_error({"--cloud=slope", "--dim=4"}, "--dim must be an integer from 2 to 3, not '4'");
    expect_error({"--radius=0"}, "--radius must be a number above 0, not '0'");
    expect_error({"--radius=inf"}, "--radius must be a number above 0, not 'inf'");
    expect_error({"--ranks-per-node=0"}, "--ranks-per-node must be an integer from 1 to");
    expect_error({"--repeats=0"}, "--repeats must be an integer from 1 to 1000, not '0'");
}

TEST(Arguments, name_options_that_do_not_go_together) {
    expect_error({"--points=10"}, "--points goes with --cloud only; remove it");
    expect_error({"--cloud=slope", "--scene=slope"},
                 "give one of --scene, --cloud, --file and --replay only");
    expect_error({"--replay=dump", "--layout=sorted"}, "--layout goes with --cloud or --file only");
    expect_error({"--replay=dump", "--steps=3"}, "--steps goes with --scene only; remove it");
    expect_error({"--cloud=slope", "--only=calls"}, "--only goes with --scene only; remove it");
}

}  // namespace
}  // namespace comparisons
