#include "far_jump_mpi.hpp"

#include "arms_mpi.hpp"

#include <rrcb/error.hpp>

#include <algorithm>

namespace comparisons {

namespace {

Discovery step_until_failure(const Arm& arm, Particles& particles, const Flow& flow) {
    constexpr int most_steps = 100;
    Discovery found;
    try {
        for (int step = 0; step < most_steps; ++step)
            for (const Stage& stage : arm) {
                if (&stage == &arm.back()) flow.push(particles);
                if (stage.name != "find_ghosts") ++found.calls;
                stage.call(particles);
            }
    } catch (const rrcb::Error& error) {
        found.text = error.what();
    }
    found.points = particles.size();
    return found;
}

/// Returns the value of each rank. Collective.
std::vector<Discovery> gathered(const Discovery& mine, MPI_Comm comm) {
    int num_ranks = 1;
    MPI_Comm_size(comm, &num_ranks);
    constexpr int most = 1024;  // characters
    std::vector<Discovery> all(static_cast<std::size_t>(num_ranks));
    for (int rank = 0; rank < num_ranks; ++rank) {
        Discovery& one = all[static_cast<std::size_t>(rank)] = mine;
        std::uint64_t numbers[] = {static_cast<std::uint64_t>(one.calls), one.points};
        one.text.resize(most);
        MPI_Bcast(numbers, 2, MPI_UINT64_T, rank, comm);
        MPI_Bcast(one.text.data(), most, MPI_CHAR, rank, comm);
        one.calls = static_cast<int>(numbers[0]);
        one.points = numbers[1];
        one.text.resize(std::min(one.text.find('\0'), one.text.size()));
    }
    return all;
}

}  // namespace

std::vector<Discovery> jump_far(const Flow& flow) {
    const Arm arm = make_arm("neighbours", flow);
    Particles particles = flow.start();
    int rank = 0;
    MPI_Comm_rank(flow.comm(), &rank);
    if (rank == 0) flow.jump(particles);
    return gathered(step_until_failure(arm, particles, flow), flow.comm());
}

}  // namespace comparisons
