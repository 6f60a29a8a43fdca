#include "table.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace comparisons {
namespace {

Measurement measured(const std::string& method, std::vector<double> times) {
    Measurement measurement;
    measurement.method = method;
    measurement.times_ms = std::move(times);
    measurement.imbalance = 1.25;
    measurement.worst_unbalance_percent = 25;
    measurement.moved_fraction = 0.5;
    measurement.traffic = {3, 400, 50, 6, 7};
    return measurement;
}

Comparison comparison() {
    Measurement failed;
    failed.method = "rrcb-sampled[mesh=4,k=2]";
    failed.error = "it said \"no\"";
    return {"slope",
            "sorted",
            2,
            1000,
            4,
            {Lists::all, 3},
            {measured("zoltan-rcb", {4, 9, 8}), measured("rrcb", {2, 1, 6}), failed}};
}

TEST(Table, writes_the_columns_of_the_contract) {
    std::ostringstream out;
    write_table(out, std::vector{comparison()});
    EXPECT_EQ(out.str(),
              "method,ranks,parts,points,dim,workload,layout,lists,repeats,time_ms_median,"
              "time_ms_min,time_ms_max,imbalance,lu_max_percent,messages,bytes,root_bytes_in,"
              "collectives,communicators,moved_fraction,time_vs_zoltan_rcb,error\n"
              "zoltan-rcb,4,4,1000,2,slope,sorted,ALL,3,8,4,9,1.25,25,3,400,50,6,7,0.5,1,\n"
              "rrcb,4,4,1000,2,slope,sorted,ALL,3,2,1,6,1.25,25,3,400,50,6,7,0.5,0.25,\n"
              "\"rrcb-sampled[mesh=4,k=2]\",4,4,1000,2,slope,sorted,ALL,3,,,,,,,,,,,,,"
              "\"it said \"\"no\"\"\"\n");
}

TEST(Table, knows_of_failed_methods) {
    Comparison sound = comparison();
    EXPECT_TRUE(has_failures(std::vector{sound}));
    sound.measurements.pop_back();
    EXPECT_FALSE(has_failures(std::vector{sound}));
}

TEST(Table, takes_the_middle_of_the_times) {
    EXPECT_EQ(median({5, 1, 3}), 3);
    EXPECT_EQ(median({8, 1, 2, 4}), 3);
    EXPECT_EQ(median({}), 0);
}

}  // namespace
}  // namespace comparisons
