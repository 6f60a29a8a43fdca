#include "points_file.hpp"

#include "failure.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace comparisons {
namespace {

Workload read(const std::string& text) {
    std::istringstream input(text);
    return read_points(input, "p.csv");
}

std::string error_of(const std::string& text) {
    try {
        read(text);
    } catch (const Failure& failure) {
        return failure.what();
    }
    return "no error";
}

TEST(PointsFile, reads_points_in_two_dimensions) {
    const Workload workload = read("x,y\n1,2\n-3.5,4e2\n");
    EXPECT_EQ(workload.dimension, 2);
    EXPECT_FALSE(workload.weighted);
    EXPECT_EQ(workload.coordinates, (std::vector<double>{1, 2, -3.5, 400}));
}

TEST(PointsFile, reads_weights_blanks_and_foreign_line_ends) {
    const Workload workload = read("x, y, z, weight\r\n1, 2, 3, 0.5\r\n\r\n4,5,6,0");
    EXPECT_EQ(workload.dimension, 3);
    EXPECT_EQ(workload.coordinates, (std::vector<double>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(workload.weights, (std::vector<double>{0.5, 0}));
}

TEST(PointsFile, names_a_missing_column) {
    EXPECT_EQ(error_of("x,z\n1,2\n"),
              "p.csv:1: column 'y' is missing; the header must be x,y[,z][,weight]");
    EXPECT_EQ(error_of("1,2\n3,4\n"),
              "p.csv:1: column 'x' is missing; the header must be x,y[,z][,weight]");
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
    EXPECT_EQ(error_of("x,y\n"), "p.csv:1: no points after the header; add one a line");
}

}  // namespace
}  // namespace comparisons
