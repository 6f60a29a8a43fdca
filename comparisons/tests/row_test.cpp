#include "row.hpp"

#include <gtest/gtest.h>

namespace comparisons {
namespace {

Row measured(const std::string& method, double value, const std::string& error = "") {
    return Row()
        .add("method", method)
        .end_key(error)
        .add("value", value)
        .add_error()
        .add("more", value);
}

TEST(Row, values_that_are_none_are_empty) {
    const Row row = Row()
                        .add("none", std::optional<double>())
                        .add_interval("time_", Interval{1, 2.5})
                        .add_interval("path_", std::nullopt);
    EXPECT_EQ(row.header(), "none,time_low,time_high,path_low,path_high");
    EXPECT_EQ(row.text(), ",1,2.5,,");
}

TEST(Row, of_a_failure_tells_what_failed_and_why) {
    const Row row = measured("a,b", 1, "it said \"no\"");
    EXPECT_EQ(row.text(), "\"a,b\",,\"it said \"\"no\"\"\",");
}

}  // namespace
}  // namespace comparisons
