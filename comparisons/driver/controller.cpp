// What rules for rebalancing cost beside the least that is possible, as CSV on standard output.
//
//   rrcb_controller [--quick]     with --quick: half the generated histories, one coarse scene
#include "generated_histories.hpp"
#include "rebalance_policies.hpp"
#include "row.hpp"
#include "scene_histories.hpp"

#include <mpi.h>

#include <exception>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace comparisons;

/// Of RRCB and of Zoltan's RCB on the slope, in steps; see docs/rebalancing.md.
const std::vector<double> costs = {1.3, 5};

Row row_of(const std::string& trace, const std::string& rule, double cost, double least) {
    return Row()
        .add("trace", trace)
        .add("rule", rule)
        .add("cost", cost)
        .add("regret", cost / least - 1);
}

void add_rows(const LoadHistory& history, std::vector<Row>& rows) {
    const double least = optimum(history);
    rows.push_back(row_of(history.name, "optimum", least, least));
    for (const NamedPolicy& policy : policies())
        rows.push_back(row_of(history.name, policy.name, cost_of(history, *policy.make()), least));
    rows.push_back(row_of(history.name, "best interval", cost_of_best_interval(history), least));
}

std::string table(bool quick) {
    std::vector<Row> rows;
    // Seeds that the rule was not made by.
    for (const unsigned seed : {1U, 2U}) {
        if (quick && seed > 1) break;
        for (const LoadHistory& history : generated_histories(seed)) add_rows(history, rows);
    }
    for (const char* scene :
         {"slope", "submarine_slide", "torpedo_anchor", "anchor_plate", "elastic_structure"}) {
        const Recording recording{.scene = scene, .quick = quick};
        for (const LoadHistory& history : scene_histories(recording, costs))
            add_rows(history, rows);
        if (quick) break;
    }
    return csv(row_of({}, {}, 1, 1), rows);
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int exit_code = 0;
    try {
        std::cout << table(argc > 1 && std::string_view(argv[1]) == "--quick");
    } catch (const std::exception& error) {
        std::cerr << "rrcb_controller: " << error.what() << '\n';
        exit_code = 1;
    }
    MPI_Finalize();
    return exit_code;
}
