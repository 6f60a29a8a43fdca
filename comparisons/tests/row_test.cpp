#include "row.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace comparisons {
namespace {

Row measured(const std::string& method, double value, const std::string& error = "") {
    return Row().add("method", method).end_key().add("value", value).add_error(error);
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
    EXPECT_EQ(row.text(), "\"a,b\",,\"it said \"\"no\"\"\"");
}

TEST(Row, people_read_columns_and_reasons_of_any_length) {
    std::ostringstream out;
    print_columns(out, measured("", 0),
                  {measured("long", 10), Row().add("method", "b").add("error", "a reason")});
    EXPECT_EQ(out.str(),
              "method  value  error\n"
              "long       10       \n"
              "b       a reason\n");
}

}  // namespace
}  // namespace comparisons
