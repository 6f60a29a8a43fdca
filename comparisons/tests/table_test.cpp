#include "comparison_mpi.hpp"
#include "progress.hpp"

#include <gtest/gtest.h>

namespace comparisons {
namespace {

Measurement measured(const std::string& method, std::vector<double> times) {
    Measurement measurement;
    measurement.method = method;
    measurement.times_ms = std::move(times);
    measurement.imbalances = {1.25};
    measurement.worst_unbalance_percent = -25;
    measurement.moved_fraction = 0.5;
    measurement.traffic = {3, 400, 50, 6, 7};
    measurement.ghosts = Ghosts{0.5, 90, 40, 2, 30};
    return measurement;
}

Comparison comparison() {
    Measurement ours = measured("rrcb", {2, 1, 6});
    ours.rounds = 1;
    Measurement failed;
    failed.method = "rrcb-sampled[mesh=4,k=2]";
    failed.error = "it said \"no\"";
    return {"slope",
            "sorted",
            2,
            1000,
            4,
            {Lists::all, 3},
            {measured("zoltan-rcb", {4, 9, 8}), ours, failed}};
}

TEST(Table, writes_the_columns_of_the_contract) {
    EXPECT_EQ(
        table_csv(std::vector{comparison()}),
        "method,ranks,parts,points,dim,workload,layout,lists,repeats,time_ms_median,"
        "time_ms_min,time_ms_max,imbalance,lu_max_percent,messages,bytes,root_bytes_in,"
        "collectives,communicators,moved_fraction,time_vs_zoltan_rcb,time_ms_low,time_ms_high,"
        "time_vs_zoltan_rcb_low,time_vs_zoltan_rcb_high,imbalance_low,imbalance_high,seeds,"
        "lu_worst_percent,rounds,error,ghosts,ghosts_max,neighbours_max,off_machine_ghosts\n"
        "zoltan-rcb,4,4,1000,2,slope,sorted,ALL,3,8,4,9,1.25,25,3,400,50,6,7,0.5,1,"
        ",,,,1.25,1.25,1,-25,,,90,40,2,30\n"
        "rrcb,4,4,1000,2,slope,sorted,ALL,3,2,1,6,1.25,25,3,400,50,6,7,0.5,0.25,"
        ",,,,1.25,1.25,1,-25,1,,90,40,2,30\n"
        "\"rrcb-sampled[mesh=4,k=2]\",4,4,1000,2,slope,sorted,ALL,3,,,,,,,,,,,,,"
        ",,,,,,,,,"
        "\"it said \"\"no\"\"\",,,,\n");
}

TEST(Table, lists_the_calls_of_each_turn) {
    Comparison twice = comparison();
    twice.second_times_ms = {5};
    EXPECT_EQ(call_times_csv(std::vector{twice}),
              "method,ranks,workload,layout,turn,time_ms\n"
              "zoltan-rcb,4,slope,sorted,1,4\nzoltan-rcb,4,slope,sorted,2,9\n"
              "zoltan-rcb,4,slope,sorted,3,8\nrrcb,4,slope,sorted,1,2\n"
              "rrcb,4,slope,sorted,2,1\nrrcb,4,slope,sorted,3,6\n"
              "zoltan-rcb again,4,slope,sorted,1,5\n");
}

TEST(Table, knows_of_failed_methods) {
    Comparison sound = comparison();
    EXPECT_TRUE(has_failures(std::vector{sound}));
    sound.measurements.pop_back();
    EXPECT_FALSE(has_failures(std::vector{sound}));
}

std::string rows_of(const Comparison& comparison) {
    return table_csv(std::span(&comparison, 1));
}

TEST(Table, tells_intervals_of_six_repeats_and_ten_seeds) {
    Comparison six = comparison();
    six.measurements = {measured("zoltan-rcb", {4, 5, 4, 8, 2, 4}),
                        measured("rrcb-sampled", {6, 5, 2, 4, 3, 1})};
    // The interval of ten sorted values is from the second to the ninth.
    six.measurements[1].imbalances = {1.9, 1.1, 1.8, 1.2, 1.7, 1.3, 1.6, 1.4, 1.5, 1};
    const std::string rows = rows_of(six);
    // The ratios are 1.5, 1, 0.5, 0.5, 1.5 and 0.25. The ratio of the medians is 3.5 / 4.
    EXPECT_NE(
        rows.find(
            ",3.5,1,6,1.45,25,3,400,50,6,7,0.5,0.875,1,6,0.25,1.5,1.1,1.8,10,-25,,,90,40,2,30\n"),
        std::string::npos)
        << rows;
    EXPECT_NE(rows.find(",0.5,1,2,8,1,1,1.25,1.25,1,-25,,,90,40,2,30\n"), std::string::npos)
        << rows;
}

TEST(Table, leaves_out_ratios_where_zoltan_s_rcb_is_not_there) {
    Comparison alone = comparison();
    alone.measurements.erase(alone.measurements.begin());
    alone.measurements[0].ghosts.off_machine.reset();
    EXPECT_NE(rows_of(alone).find(",0.5,,,,,,1.25,1.25,1,-25,1,,90,40,2,\n"), std::string::npos);
}

TEST(Table, writes_imbalances_to_all_digits) {
    Comparison exact = comparison();
    exact.measurements[1].imbalances = {1.0003765};
    EXPECT_NE(rows_of(exact).find(",1.0003765,"), std::string::npos);
}

TEST(Progress, shows_how_much_is_done_if_asked_to) {
    for (const bool is_shown : {true, false}) {
        testing::internal::CaptureStderr();
        Progress progress(is_shown, "calls", 3);
        progress.advance(1);
        progress.advance(2);
        EXPECT_EQ(testing::internal::GetCapturedStderr(),
                  is_shown ? "\rcalls: 1 of 3\rcalls: 3 of 3\n" : "");
    }
}

}  // namespace
}  // namespace comparisons
