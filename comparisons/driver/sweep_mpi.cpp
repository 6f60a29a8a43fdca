#include "sweep_mpi.hpp"

#include "comparison_mpi.hpp"
#include "cycle_mpi.hpp"
#include "failure_mpi.hpp"
#include "workload_mpi.hpp"

#include <algorithm>
#include <iostream>

namespace comparisons {

SavedRows::SavedRows(const ResultsFolder& folder, std::string name, Row columns)
    : folder_(folder), name_(std::move(name)), columns_(std::move(columns)) {
    std::vector<Row> rows = read_csv(folder.read(name_), columns_);
    std::erase_if(rows, &Row::has_failed);
    add_and_save(rows);
}

bool SavedRows::add(const std::vector<Row>& rows) {
    const std::string text = folder_.from_root([&] { return csv(columns_, rows); });
    const std::vector<Row> added = read_csv(text, columns_);
    add_and_save(added);
    return std::ranges::none_of(added, &Row::has_failed);
}

void SavedRows::add_and_save(const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        if (keys_.insert(row.key()).second) rows_.push_back(row);
    }
    folder_.write(name_, [&] { return csv(columns_, rows_); });
}

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
    Comparison comparison = describe(workload,
                                     {.lists = sweep.arguments.lists,
                                      .repeats = sweep.arguments.repeats,
                                      .ghosts = sweep.arguments.ghosts},
                                     sweep.comm);
    std::erase_if(settings,
                  [&](const Method& m) { return rows.has(table_key(comparison, m.label)); });
    sweep.say(workload.name + ", " + std::to_string(workload.dimension) + "-D, " + workload.layout +
              ": " + std::to_string(settings.size()) + " settings to measure");
    if (settings.empty()) return true;
    const Method reference = read_method("zoltan-rcb");
    if (std::ranges::find(settings, reference.label, &Method::label) == settings.end()) {
        settings.insert(settings.begin(), reference);
    }
    comparison.measurements =
        measure(workload, settings, comparison.plan, sweep.progress, sweep.comm);
    return rows.add(table_rows(comparison));
}

bool run_sweep(const Arguments& arguments, const ResultsFolder& folder, Progress& progress,
               MPI_Comm comm) {
    const Sweep sweep{arguments, folder, progress, comm, rank_of(comm), size_of(comm)};
    SavedRows rows(folder, "sweep.csv", table_columns());
    bool succeeded = true;
    if (sweep.includes("clouds")) {
        succeeded = on_each_cloud(sweep, arguments.points, [&](const Workload& workload) {
            return measure_missing(sweep, workload, arguments.methods, rows);
        });
    }
    if (sweep.includes("snapshots")) succeeded = study_snapshots(sweep, rows) && succeeded;
    if (sweep.includes("cycle")) succeeded = study_cycle(sweep) && succeeded;
    if (sweep.includes("ranks")) succeeded = study_ranks(sweep) && succeeded;
    if (sweep.includes("simulations")) succeeded = study_simulations(sweep) && succeeded;
    if (sweep.includes("paper")) succeeded = study_paper(sweep) && succeeded;
    return succeeded;
}

}  // namespace comparisons
