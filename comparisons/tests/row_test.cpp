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
                        .add_spread("path", Spread{3, std::nullopt})
                        .add_spread("gain", std::nullopt);
    EXPECT_EQ(row.header(),
              "none,time_low,time_high,path,path_low,path_high,gain,gain_low,gain_high");
    EXPECT_EQ(row.text(), ",1,2.5,3,,,,,");
}

TEST(Row, of_a_failure_tells_what_failed_and_why) {
    const Row row = measured("a,b", 1, "it said \"no\"");
    EXPECT_EQ(row.text(), "\"a,b\",,\"it said \"\"no\"\"\"");
    EXPECT_EQ(row.key(), "\"a,b\"");
    EXPECT_TRUE(row.has_failed());
    EXPECT_TRUE(Row(row).add("more", 1).has_failed()) << "columns may stand behind the error";
    EXPECT_EQ(Row().add("repeat", 2).add(row).key(), "2,\"a,b\"");
}

TEST(Row, is_read_as_it_was_written) {
    const std::vector<Row> rows = {measured("plain", 0.1), measured("a \"b\"", 2),
                                   measured("two,\nlines", 3, "\"quoted\"")};
    const std::string text = csv(measured("", 0), rows);
    const std::vector<Row> read = read_csv(text, measured("", 0));
    ASSERT_EQ(read.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(read[i].columns(), rows[i].columns());
    EXPECT_EQ(read[1].key(), rows[1].key());
    EXPECT_TRUE(read_csv(text, Row().add("another", 0)).empty());
    EXPECT_EQ(read_csv(text + "cut,sh", measured("", 0)).size(), 3U);
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
