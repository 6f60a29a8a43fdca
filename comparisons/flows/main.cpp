// Balances flows with several policies and prints CSV on standard output, with a row for each call.
//
//   mpirun -n 4 rrcb_flows PARTS FLOWS POLICIES
//
// FLOWS and POLICIES are names separated by commas, or "all". comparisons/studies/run flows makes
// tables.
#include "collective/watch_mpi.hpp"
#include "failure_mpi.hpp"
#include "flow.hpp"
#include "follower_mpi.hpp"
#include "ghosts_mpi.hpp"
#include "row.hpp"
#include "text.hpp"

#include <array>
#include <exception>
#include <iostream>

namespace {

using namespace comparisons;

/// Radii of ghosts, in units of the mean spacing.
constexpr std::array near_and_wide{1.2, 2.5};

/// Returns all particles at a call, on every rank. Collective.
Workload at_call(const Flow& flow, std::size_t call) {
    Workload all{flow.name, "", flow.dimension, {}, false, {}};
    if (rank_of(MPI_COMM_WORLD) == 0) all.coordinates = flow.positions(call);
    all.coordinates.resize(flow.num_points * static_cast<std::size_t>(flow.dimension));
    MPI_Bcast(all.coordinates.data(), static_cast<int>(all.coordinates.size()), MPI_DOUBLE, 0,
              MPI_COMM_WORLD);
    return all;
}

struct PolicyCounts {
    CallCounts call;
    std::array<std::int64_t, near_and_wide.size()> ghosts{};
};

std::vector<std::string> read_names(const std::string& word) {
    std::vector<std::string> names;
    if (word != "all")
        for (const std::string_view name : split(word, ',')) names.emplace_back(name);
    return names;
}

/// Counts the ghosts of the parts of each policy. The policies are distributed over the ranks, and
/// rank 0 gets the results. Collective.
void count_ghosts(std::vector<PolicyCounts>& counts, const std::vector<Follower>& followers,
                  const Workload& now, double spacing, int num_parts) {
    const int rank = rank_of(MPI_COMM_WORLD);
    const auto num_ranks = static_cast<std::size_t>(size_of(MPI_COMM_WORLD));
    if (rank < static_cast<int>(followers.size()))
        for (std::size_t k = 0; k < near_and_wide.size(); ++k) {
            const GhostCounter counter(now, {near_and_wide[k] * spacing, {}}, MPI_COMM_SELF);
            for (auto p = static_cast<std::size_t>(rank); p < followers.size(); p += num_ranks)
                counts[p].ghosts[k] = counter.count(followers[p].parts(), num_parts).sum;
        }
    for (PolicyCounts& of : counts)
        MPI_Reduce(rank == 0 ? MPI_IN_PLACE : of.ghosts.data(), of.ghosts.data(),
                   static_cast<int>(of.ghosts.size()), MPI_INT64_T, MPI_SUM, 0, MPI_COMM_WORLD);
}

void follow(const Flow& flow, const std::vector<Policy>& chosen, int num_parts) {
    const int rank = rank_of(MPI_COMM_WORLD);
    std::vector<Follower> followers;
    for (const Policy& policy : chosen) followers.emplace_back(policy, num_parts, MPI_COMM_WORLD);
    for (std::size_t call = 0; call < flow.num_calls; ++call) {
        const Workload now = at_call(flow, call);
        std::vector<PolicyCounts> counts;
        for (Follower& follower : followers) counts.push_back({follower.go_on(now)});
        count_ghosts(counts, followers, now, flow.spacing, num_parts);
        for (std::size_t p = 0; rank == 0 && p < chosen.size(); ++p)
            print(Row()
                      .add("flow", flow.name)
                      .add("dim", flow.dimension)
                      .add("parts", num_parts)
                      .add("policy", chosen[p].name)
                      .add("call", call)
                      .add("points", flow.num_points)
                      .add("moved", counts[p].call.moved)
                      .add("ghosts_near", counts[p].ghosts[0])
                      .add("ghosts_wide", counts[p].ghosts[1])
                      .add("messages", counts[p].call.messages));
    }
}

void run(const std::vector<std::string>& words) {
    if (words.size() != 3) throw Failure("PARTS, FLOWS and POLICIES are needed; see the source");
    const std::optional<int> num_parts = read_number<int>(words[0]);
    if (!num_parts || *num_parts < 1) throw Failure("PARTS must be a number of 1 or more");
    const std::vector<Policy> chosen = policies(read_names(words[2]));
    // The first call duplicates the communicator. It must not be counted for the first flow.
    const std::vector<double> no_points;
    rrcb::balance(rrcb::Points(no_points, 2), MPI_COMM_WORLD);
    for (const std::string& name : words[1] == "all" ? flow_names() : read_names(words[1]))
        follow(make_flow(name), chosen, *num_parts);
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    // A rank that waits for long sends a message. On a busy machine such messages would distort the
    // counts.
    rrcb::mpi::patience = std::chrono::hours(1);
    try {
        run({argv + 1, argv + argc});
    } catch (const std::exception& error) {
        std::cerr << "rrcb_flows: " << error.what() << '\n';
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    MPI_Finalize();
    return 0;
}
