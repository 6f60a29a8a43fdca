#include "comparison_mpi.hpp"
#include "failure_mpi.hpp"
#include "git_hash.hpp"
#include "scene_mpi.hpp"
#include "text.hpp"
#include "traffic.hpp"
#include "workload_mpi.hpp"

#include <rrcb/error.hpp>
#include <rrcb/version.hpp>
#include <rrcb/zoltan/rrcb_zoltan.h>

#include <Trilinos_version.h>
#include <zoltan.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <iostream>
#include <sstream>

namespace {

using namespace comparisons;

/// Makes the allocator keep freed memory for later calls, for all methods. Otherwise the comparison
/// would include how often a library returns memory and pays for new pages.
void keep_freed_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, -1);
#endif
}

/// Returns the versions of this program, the library, Zoltan and MPI, one per line.
std::string versions() {
    char mpi[MPI_MAX_LIBRARY_VERSION_STRING];
    int length = 0;
    MPI_Get_library_version(mpi, &length);
    std::ostringstream text;
    text << "rrcb " << rrcb::version() << " (" << git_hash << ")\n"
         << "Zoltan " << ZOLTAN_VERSION_NUMBER << " of Trilinos " << TRILINOS_VERSION_STRING << '\n'
         << trim(mpi) << '\n';
    return text.str();
}

/// Returns the command line of the program.
std::string command_line(int argc, char** argv) {
    std::string words;
    for (int i = 1; i < argc; ++i) words += std::string(i == 1 ? "" : " ") + argv[i];
    return words;
}

/// Returns the information needed to repeat a run: versions, command, ranks, and the parameters of
/// every method.
std::string run_record(const Arguments& arguments, const std::string& command, MPI_Comm comm) {
    std::ostringstream text;
    text << versions() << "arguments: " << command << "\nranks: " << size_of(comm)
         << "\nseed: " << arguments.seed << "\nparameters, all others are Zoltan's defaults:\n";
    for (const Method& method : arguments.methods) {
        text << "  " << method.label << ':';
        for (const auto& [name, value] : zoltan_parameters(method, arguments.lists)) {
            text << ' ' << name << '=' << value;
        }
        if (varies_with_seed(method)) {
            text << " and the next " << num_judged_seeds - 1 << " seeds";
        }
        text << '\n';
    }
    return text.str();
}

void check_surroundings(const Arguments& arguments, MPI_Comm comm) {
    const int size = size_of(comm);
    if (arguments.ranks != 0 && arguments.ranks != size) {
        throw Failure("--ranks=" + std::to_string(arguments.ranks) + " but mpirun started " +
                      std::to_string(size) + "; give mpirun the same number with -n");
    }
    if (RRCB_Zoltan_Active() == 0) {
        throw Failure("rrcb_zoltan is not in front of Zoltan; link it before Zoltan");
    }
}

Workload make_workload(const Arguments& arguments, MPI_Comm comm) {
    if (!arguments.replay.empty()) {
        Replay replay = read_replay(arguments.replay, comm);
        if (rank_of(comm) == 0) std::cout << replay.note;
        return std::move(replay.workload);
    }
    if (!arguments.file.empty()) {
        return file_workload(arguments.file, arguments.layout, arguments.seed, comm);
    }
    return cloud_workload({arguments.cloud, arguments.points, arguments.dimension, arguments.seed},
                          arguments.layout, comm);
}

/// Compares all methods on the requested points. For a scene these are its snapshots, and its
/// simulations are compared as well. Returns false if a method failed.
bool compare_all(const Arguments& arguments, const ResultsFolder& folder, MPI_Comm comm) {
    std::vector<Comparison> comparisons;
    const auto compare = [&](std::span<const Workload> workloads) {
        for (const Workload& workload : workloads)
            comparisons.push_back(compare_methods(workload, arguments, folder, comm));
    };
    bool succeeded = true;
    if (!arguments.cloud.empty() || !arguments.file.empty() || !arguments.replay.empty()) {
        compare(std::vector{make_workload(arguments, comm)});
    } else if (arguments.only == Only::calls) {
        compare(scene_snapshots(plan_scene(arguments, 1, comm), comm));
    } else {
        const bool calls = arguments.only == Only::all;
        const SnapshotVisitor visit = [&](std::span<const Workload> workloads) {
            if (calls) compare(workloads);
        };
        succeeded = std::ranges::none_of(run_scene(arguments, folder, visit, comm),
                                         &SimulationRounds::has_failed);
    }
    folder.write("table.csv", [&] { return table_csv(comparisons); });
    folder.write("calls.csv", [&] { return calls_csv(comparisons); });
    folder.write("call_times.csv", [&] { return call_times_csv(comparisons); });
    return succeeded && !has_failures(comparisons);
}

int compare(const Arguments& arguments, const std::string& command, MPI_Comm comm) {
    check_surroundings(arguments, comm);
    const ResultsFolder folder(arguments.out, comm);
    const std::string record = run_record(arguments, command, comm);
    folder.write("run.txt", [&] { return record; });

    const bool succeeded = compare_all(arguments, folder, comm);
    if (rank_of(comm) == 0) std::cout << "Written to " << arguments.out << '\n';
    return succeeded ? 0 : 1;
}

int run(int argc, char** argv, MPI_Comm comm) {
    const Arguments arguments = read_arguments(argc, argv);
    set_ranks_per_machine(arguments.ghosts.ranks_per_node.value_or(0));
    if (!arguments.help) return compare(arguments, command_line(argc, argv), comm);
    if (rank_of(comm) == 0) std::cout << *arguments.help;
    return 0;
}

/// Returns the exit code. A Failure, which all ranks throw, is printed once. Any other exception
/// ends the program on all ranks.
int run_and_report(int argc, char** argv, MPI_Comm comm) {
    try {
        return run(argc, argv, comm);
    } catch (const Failure& failure) {
        if (rank_of(comm) == 0) std::cerr << "rrcb_compare: " << failure.what() << std::endl;
    } catch (const rrcb::Error& error) {
        if (rank_of(comm) == 0) std::cerr << "rrcb_compare: " << error.what() << std::endl;
    } catch (const std::exception& error) {
        std::cerr << "rrcb_compare: rank " << rank_of(comm) << ": " << error.what() << std::endl;
        MPI_Abort(comm, 1);
    }
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    keep_freed_memory();
    MPI_Init(&argc, &argv);
    float zoltan_version = 0;
    Zoltan_Initialize(argc, argv, &zoltan_version);
    const int code = run_and_report(argc, argv, MPI_COMM_WORLD);
    std::cout.flush();
    MPI_Barrier(MPI_COMM_WORLD);
    MPI_Finalize();
    return code;
}
