#include "points_files.hpp"

#include "failure.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

namespace comparisons {
namespace {

const std::string good_call =
    "rrcb-dump 1\nversion 0.1.0\nfunction Zoltan_LB_Partition\ncode -1\nranks 2\n"
    "parameter LB_METHOD RRCB\nparameter RRCB_DUMP a b\nend\n";
const std::string empty_rank = "rrcb-dump-rank 1\nrank 0\nobjects 0\nend\n";
const std::string good_rank =
    "rrcb-dump-rank 1\nrank 1\nmessage it failed\npart_size global 0 0x1p-1\ndimension 2\n"
    "weights 2\nparts 1\nobjects 2\n0x1.8p+0 nan 0x1p-1 0x1p+0 4\n-inf -0x1p-1074 0x0p+0 0x1p+0 "
    "0\nend\n";

/// Returns the dump of two ranks whose files contain these texts.
Dump read(const std::string& call, const std::string& rank = good_rank,
          const std::string& first_rank = empty_rank) {
    const std::string folder = testing::TempDir() + "rrcb_dump_" + std::to_string(getpid());
    std::filesystem::create_directory(folder);
    const auto write = [&](const char* name, const std::string& text) {
        std::ofstream(folder + '/' + name) << text;
    };
    write("call.txt", call);
    write("rank-0.txt", first_rank);
    write("rank-1.txt", rank);
    return read_dump(folder);
}

std::string with(std::string text, const std::string& old, const std::string& replacement) {
    return text.replace(text.find(old), old.size(), replacement);
}

void expect_failure(const std::function<void()>& action, const std::string& message) {
    try {
        action();
        ADD_FAILURE() << "no failure: " << message;
    } catch (const Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find(message), std::string::npos) << failure.what();
    }
}

void expect_bad_call(const std::string& text, const std::string& message) {
    expect_failure([&] { read(text); }, message);
}

void expect_bad_rank(const std::string& text, const std::string& message) {
    expect_failure([&] { read(good_call, text); }, message);
}

TEST(Dump, is_read_to_the_bit_and_noted) {
    const Dump dump = read(good_call);
    EXPECT_EQ(dump.counts, (std::vector<rrcb::GlobalCount>{0, 2}));
    EXPECT_EQ(dump.workload.dimension, 2);
    const std::vector<double>& x = dump.workload.coordinates;
    ASSERT_EQ(x.size(), 4U);
    EXPECT_EQ(x[0], 1.5);
    EXPECT_TRUE(std::isnan(x[1]));
    EXPECT_EQ(x[2], -std::numeric_limits<double>::infinity());
    EXPECT_EQ(x[3], -std::numeric_limits<double>::denorm_min());
    EXPECT_EQ(dump.workload.weights, (std::vector<double>{0.5, 0}));
    EXPECT_EQ(dump.note,
              "dump: Zoltan_LB_Partition on 2 ranks, code -1, parameters: LB_METHOD=RRCB "
              "RRCB_DUMP=a b\ndump: rank 1: it failed\ndump: only the first weight is balanced\n"
              "dump: 2 coordinates or weights are not finite; Zoltan's own methods may never "
              "return\n");
}

TEST(Dump, names_what_is_wrong_with_the_call) {
    expect_failure([] { read_dump("nowhere"); },
                   "nowhere/call.txt: cannot be opened: No such file");
    expect_bad_call("", "call.txt:1: the file is truncated");
    expect_bad_call(with(good_call, "rrcb-dump 1", "rrcb-dump 2"),
                    "call.txt:1: 'rrcb-dump 2' instead of 'rrcb-dump 1'");
    expect_bad_call(with(good_call, "end\n", ""), "call.txt:8: the file is truncated");
    expect_bad_call(with(good_call, "ranks 2\n", ""), "call.txt:7: no number of ranks");
    for (const char* ranks : {"ranks 0", "ranks -3", "ranks two", "ranks"})
        expect_bad_call(with(good_call, "ranks 2", ranks), "call.txt:5: '" + std::string(ranks));
    expect_bad_call(with(good_call, "ranks 2", "ranks 1"), "'ranks 1', but there is rank-1.txt");
    expect_bad_call(with(good_call, "ranks 2", "ranks 3"), "rank-2.txt: cannot be opened: No such");
}

TEST(Dump, names_what_is_wrong_with_a_rank) {
    expect_bad_rank(with(good_rank, "\nrank 1", "\nrank 0"),
                    "rank-1.txt:2: 'rank 0' instead of 'rank 1'");
    expect_bad_rank(with(good_rank, "dimension 2", "dimension 4"), "rank-1.txt:5: 'dimension 4'");
    expect_bad_rank(with(good_rank, "dimension 2\n", ""), "objects without a dimension");
    expect_bad_rank(with(good_rank, "objects 2", "objects -1"), "rank-1.txt:8: 'objects -1'");
    expect_bad_rank(with(good_rank, "objects 2", "objects 1"), "rank-1.txt:10: '-inf");
    expect_bad_rank(with(good_rank, "objects 2", "objects 3"), "rank-1.txt:11: 'end' holds 0");
    expect_bad_rank(with(good_rank, "end\n", ""), "rank-1.txt:11: the file is truncated");
    expect_bad_rank(with(good_rank, "nan 0x1p-1 0x1p+0 4", ""),
                    "rank-1.txt:9: '0x1.8p+0 ' holds 1 numbers; coordinates and weights of a "
                    "point are 4");
    const std::string line = "rrcb-dump-rank 1\nrank 0\ndimension 1\nobjects 1\n0x1p+0\nend\n";
    expect_failure([&] { read(good_call, good_rank, line); },
                   "rank 1 has another dimension or number of weights");
    expect_bad_rank("rrcb-dump-rank 1\nrank 1\nobjects 0\nend\n", "the dump holds no points");
}

Workload read_csv(const std::string& text) {
    std::istringstream input(text);
    return read_points(input, "p.csv");
}

std::string error_of(const std::string& text) {
    try {
        read_csv(text);
    } catch (const Failure& failure) {
        return failure.what();
    }
    return "no error";
}

TEST(PointsFile, reads_points_in_two_dimensions) {
    const Workload workload = read_csv("x,y\n1,2\n-3.5,4e2\n");
    EXPECT_EQ(workload.dimension, 2);
    EXPECT_FALSE(workload.weighted);
    EXPECT_EQ(workload.coordinates, (std::vector<double>{1, 2, -3.5, 400}));
}

TEST(PointsFile, reads_weights_blanks_and_foreign_line_ends) {
    const Workload workload = read_csv("x, y, z, weight\r\n1, 2, 3, 0.5\r\n\r\n4,5,6,0");
    EXPECT_EQ(workload.dimension, 3);
    EXPECT_EQ(workload.coordinates, (std::vector<double>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(workload.weights, (std::vector<double>{0.5, 0}));
}

TEST(PointsFile, names_a_missing_column) {
    EXPECT_EQ(error_of("x,z\n1,2\n"),
              "p.csv:1: column 2 must be 'y'; the header must be x,y[,z][,weight]");
    EXPECT_EQ(error_of("1,2\n3,4\n"),
              "p.csv:1: column 1 must be 'x'; the header must be x,y[,z][,weight]");
}

TEST(PointsFile, names_an_unknown_column) {
    EXPECT_EQ(error_of("x,y,mass\n1,2,3\n"),
              "p.csv:1: column 3 is 'mass'; the header must be x,y[,z][,weight]");
}

TEST(PointsFile, names_line_and_column_of_what_is_no_finite_number) {
    EXPECT_EQ(error_of("x,y\n1,2\n3,nan\n"),
              "p.csv:3: column 'y': 'nan' is not finite; remove or mend the point");
    EXPECT_EQ(error_of("x,y\n-inf,2\n"),
              "p.csv:2: column 'x': '-inf' is not finite; remove or mend the point");
    EXPECT_EQ(error_of("x,y\n1,2m\n"),
              "p.csv:2: column 'y': '2m' is not a number; write it like -1.5e3");
    EXPECT_EQ(error_of("x,y,weight\n1,2,-1\n"),
              "p.csv:2: column 'weight': '-1' is negative; a weight must be 0 or more");
}

TEST(PointsFile, names_a_short_or_long_line) {
    EXPECT_EQ(error_of("x,y,z\n1,2,3\n4,5"),
              "p.csv:3: column 'z' is missing: 2 fields instead of 3; complete or remove the line");
    EXPECT_EQ(error_of("x,y\n1,2,3\n"), "p.csv:2: 3 fields instead of 2; remove what is too much");
}

TEST(PointsFile, names_what_is_empty) {
    EXPECT_EQ(error_of(""), "p.csv:1: the file is empty; the header must be x,y[,z][,weight]");
    EXPECT_EQ(error_of("x,y\n"), "p.csv:2: no points after the header; add one a line");
}

}  // namespace
}  // namespace comparisons
