// What rules for rebalancing cost beside the least that is possible, as CSV on standard output.
//
//   rrcb_controller [--quick]     with --quick: half the generated histories, one coarse scene
#include "generated_histories.hpp"
#include "rebalance_policies.hpp"
#include "scene_histories.hpp"
#include "text.hpp"

#include <mpi.h>

#include <exception>
#include <iostream>
#include <string_view>
#include <vector>

namespace {

using namespace comparisons;

/// Of RRCB and of Zoltan's RCB on the slope, in steps; see docs/rebalancing.md.
const std::vector<double> costs = {1.3, 5};

void write_rows(const LoadHistory& history) {
    const double least = optimum(history);
    const auto write = [&](const std::string& rule, double cost) {
        std::cout << csv_field(history.name) << ',' << csv_field(rule) << ',' << write_number(cost)
                  << ',' << write_number(cost / least - 1) << '\n';
    };
    write("optimum", least);
    for (const NamedPolicy& policy : policies()) {
        write(policy.name, cost_of(history, *policy.make()));
    }
    write("best interval", cost_of_best_interval(history));
}

void write_table(bool quick) {
    std::cout << "trace,rule,cost,regret\n";
    // Seeds that the rule was not made by.
    for (const unsigned seed : {1U, 2U}) {
        if (quick && seed > 1) break;
        for (const LoadHistory& history : generated_histories(seed)) write_rows(history);
    }
    for (const char* scene :
         {"slope", "submarine_slide", "torpedo_anchor", "anchor_plate", "elastic_structure"}) {
        const Recording recording{.scene = scene, .quick = quick};
        for (const LoadHistory& history : scene_histories(recording, costs)) write_rows(history);
        if (quick) break;
    }
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int exit_code = 0;
    try {
        write_table(argc > 1 && std::string_view(argv[1]) == "--quick");
    } catch (const std::exception& error) {
        std::cerr << "rrcb_controller: " << error.what() << '\n';
        exit_code = 1;
    }
    MPI_Finalize();
    return exit_code;
}
