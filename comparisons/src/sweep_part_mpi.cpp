#include "sweep_part_mpi.hpp"

#include "comparison_mpi.hpp"
#include "table.hpp"
#include "workload_mpi.hpp"

#include <algorithm>
#include <iostream>

namespace comparisons {

bool Sweep::includes(const std::string& part) const {
    return std::ranges::find(arguments.only, part) != arguments.only.end();
}

void Sweep::say(const std::string& line) const {
    if (rank == 0) std::cout << line << std::endl;
}

bool on_each_cloud(const Sweep& sweep, rrcb::GlobalCount num_points,
                   const std::function<bool(const Workload&)>& visit) {
    const SweptClouds& swept = sweep.arguments.swept;
    bool succeeded = true;
    for (const std::string& name : swept.names) {
        for (const int dimension : swept.dimensions) {
            for (const Layout layout : swept.layouts) {
                const Workload workload = cloud_workload(
                    {name, num_points, dimension, sweep.arguments.seed}, layout, sweep.comm);
                succeeded = visit(workload) && succeeded;
            }
        }
    }
    return succeeded;
}

bool measure_missing(const Sweep& sweep, const Workload& workload, std::vector<Method> settings,
                     SavedRows& rows) {
    Comparison comparison =
        describe(workload, {sweep.arguments.lists, sweep.arguments.repeats}, sweep.comm);
    std::erase_if(settings,
                  [&](const Method& m) { return rows.has(row_key(comparison, m.label)); });
    sweep.say(workload.name + ", " + std::to_string(workload.dimension) + "-D, " + workload.layout +
              ": " + std::to_string(settings.size()) + " settings to measure");
    if (settings.empty()) return true;
    const Method reference = read_method("zoltan-rcb");
    if (std::ranges::find(settings, reference.label, &Method::label) == settings.end()) {
        settings.insert(settings.begin(), reference);
    }
    comparison.measurements =
        measure(workload, settings, comparison.plan, sweep.progress, sweep.comm);
    return !rows.add([&](std::ostream& out) { write_rows(out, comparison); });
}

}  // namespace comparisons
