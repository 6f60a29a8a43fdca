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

/// The first part of the error.
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
    EXPECT_EQ(read({"--scene=my/own.xml"}).scene, "my/own.xml");
}

TEST(Arguments, compare_settings_unless_methods_are_named) {
    EXPECT_EQ(read({"--cloud=slope"}).methods.size(), default_methods().size());
    EXPECT_EQ(read({"--quick"}).methods.size(), default_methods().size());
    EXPECT_EQ(read({"--methods=all"}).methods.size(), all_methods().size());
    EXPECT_EQ(read({"--sweep", "--quick"}).methods.size(), read_methods(method_names()).size());
    EXPECT_EQ(read({"--methods=rrcb-arrays[tol=1.1]"}).methods.size(), 1U);
}

TEST(Arguments, narrow_a_sweep) {
    const Arguments arguments =
        read({"--sweep", "--only=clouds, cycle", "--cloud=slope", "--dim=2", "--layout=sorted"});
    EXPECT_EQ(arguments.only, (std::vector<std::string>{"clouds", "cycle"}));
    EXPECT_EQ(arguments.swept.names, std::vector<std::string>{"slope"});
    EXPECT_EQ(arguments.swept.dimensions, std::vector<int>{2});
    EXPECT_EQ(arguments.swept.layouts, std::vector<Layout>{Layout::sorted});
    EXPECT_EQ(arguments.points, 200'000);
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
    expect_error({"--sweep", "--only=clouds,some"},
                 "--only: unknown part 'some'; choose from: clouds, snapshots");
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
    expect_error({"--points=10"}, "--points goes with --cloud or --sweep only; remove it");
    expect_error({"--cloud=slope", "--scene=slope"},
                 "give one of --scene, --cloud, --file and --replay only");
    expect_error({"--replay=dump", "--layout=sorted"}, "--layout goes with --cloud, --file or");
    expect_error({"--sweep", "--every=auto"},
                 "--every=auto goes with --scene only; give --sweep a number of steps");
    expect_error({"--replay=dump", "--steps=3"}, "--steps goes with --scene only; remove it");
    expect_error({"--sweep", "--file=points.csv"}, "--sweep has points of its own; remove");
    expect_error({"--only=clouds"}, "--only goes with --sweep only; remove it");
}

}  // namespace
}  // namespace comparisons
