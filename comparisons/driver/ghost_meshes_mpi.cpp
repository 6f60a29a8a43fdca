#include "failure.hpp"
#include "ghost_study_mpi.hpp"
#include "ghosts_mpi.hpp"
#include "partitioner_mpi.hpp"

#include <rrcb/rrcb.hpp>

#include <array>
#include <functional>
#include <iostream>
#include <utility>
#include <variant>

/// Marks what Callgrind counts.
extern "C" [[gnu::noinline]] void rrcb_ghosts_call(const std::function<void()>& call) {
    call();
    // Not a jump to the call, which would leave this function before.
    asm volatile("" ::: "memory");
}

namespace comparisons {

namespace {

/// Zoltan's RCB, the mesh by default, and meshes of so many cells along each axis.
std::vector<std::string> mesh_methods(int dimension) {
    std::vector<std::string> methods{"zoltan-rcb", "rrcb-arrays"};
    for (const char* cells : dimension == 2 ? std::array{"8", "12", "16", "22", "32"}
                                            : std::array{"4", "5", "6", "8", "10"})
        methods.push_back("rrcb-arrays[mesh=" + std::string(cells) + "]");
    return methods;
}

/// Adds the traffic of all ranks. Collective.
void add_up(Traffic& traffic, MPI_Comm comm) {
    std::array sums{traffic.messages, traffic.bytes, traffic.root_bytes_in};
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_INT64_T, MPI_SUM,
                  comm);
    std::tie(traffic.messages, traffic.bytes, traffic.root_bytes_in) = std::tuple_cat(sums);
}

MadeParts by_zoltan(const Method& method, const Workload& workload, int num_parts, MPI_Comm comm) {
    ZoltanParameters parameters = zoltan_parameters(method, Lists::parts);
    parameters.emplace_back("NUM_GLOBAL_PARTS", std::to_string(num_parts));
    parameters.emplace_back("IMBALANCE_TOL", "1.01");
    ZoltanPartitioner zoltan(parameters, workload, comm);
    start_counting_traffic();
    const int code = zoltan.partition();
    MadeParts made{.parts = {}, .traffic = stop_counting_traffic()};
    if (code != ZOLTAN_OK) throw Failure("Zoltan failed");
    made.parts = zoltan.parts();
    return made;
}

rrcb::Options options_of(const Method& method, int num_parts) {
    auto options = std::get<rrcb::Options>(*method.options);
    options.num_parts = num_parts;
    return options;
}

void compare(const Cloud& cloud, Layout layout, MPI_Comm comm) {
    const Workload workload = cloud_workload(cloud, layout, comm);
    const double radius = ghost_reach * GhostCounter(workload, {}, comm).radius();
    const GhostCounter counter(workload, {radius}, comm);
    for (const int num_parts : {4, 16, 64})
        for (const std::string& method : mesh_methods(cloud.dimension)) {
            const MadeParts made = make_parts(method, workload, num_parts, comm);
            const Ghosts ghosts = counter.count(made.parts, num_parts);
            print(Row()
                      .add("cloud", cloud.name)
                      .add("dim", cloud.dimension)
                      .add("layout", std::string(layout_name(layout)))
                      .add("parts", num_parts)
                      .add("seed", static_cast<double>(cloud.seed))
                      .add("method", method)
                      .add("ghosts", static_cast<double>(ghosts.sum))
                      .add("ghosts_max", static_cast<double>(ghosts.most))
                      .add("rounds", made.rounds)
                      .add("cells", static_cast<double>(made.cells))
                      .add("messages", static_cast<double>(made.traffic.messages))
                      .add("bytes", static_cast<double>(made.traffic.bytes))
                      .add("root_bytes_in", static_cast<double>(made.traffic.root_bytes_in)),
                  comm);
        }
}

}  // namespace

std::span<const char* const> ghost_clouds() {
    static constexpr std::array names{"uniform",  "slab",  "slope",  "run_out",  "polygon", "wave",
                                      "clusters", "shell", "spiral", "diagonal", "cusps",   "drops",
                                      "pile",     "jets",  "web",    "discs"};
    return names;
}

void print(const Row& row, MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    if (rank != 0) return;
    static bool is_first = true;
    if (std::exchange(is_first, false)) std::cout << row.header() << '\n';
    std::cout << row.text() << std::endl;
}

MadeParts make_parts(const std::string& name, const Workload& workload, int num_parts,
                     MPI_Comm comm) {
    const Method method = read_method(name);
    MadeParts made;
    if (method.options) {
        const rrcb::Options options = options_of(method, num_parts);
        start_counting_traffic();
        rrcb::Balance balance = rrcb::balance(workload.points(), options, {}, comm);
        made = {std::move(balance.parts), balance.report.details.rounds,
                balance.report.details.num_records, stop_counting_traffic()};
    } else {
        made = by_zoltan(method, workload, num_parts, comm);
    }
    add_up(made.traffic, comm);
    return made;
}

void compare_meshes(bool quick, MPI_Comm comm) {
    const auto clouds = quick ? ghost_clouds().first(1) : ghost_clouds();
    for (const char* name : clouds)
        for (const int dimension : {2, 3})
            for (const Layout layout : {Layout::sorted, Layout::scattered})
                for (std::uint64_t seed = 1; seed <= (quick ? 1 : 2); ++seed)
                    compare({name, quick ? 1000 : ghost_points, dimension, seed}, layout, comm);
}

void call_with_meshes(int dimension, int num_parts, MPI_Comm comm) {
    const Workload workload =
        cloud_workload({"slope", ghost_points, dimension, 1}, Layout::sorted, comm);
    for (const std::string& name : mesh_methods(dimension)) {
        const Method method = read_method(name);
        if (!method.options) continue;
        const rrcb::Options options = options_of(method, num_parts);
        rrcb_ghosts_call([&] { rrcb::balance(workload.points(), options, {}, comm); });
        print(Row().add("method", name), comm);
    }
}

}  // namespace comparisons
