#include "parallel/migration_mpi.hpp"

#include "parallel/communicator_mpi.hpp"

#include <algorithm>

namespace mpm {

namespace {

constexpr int migration_tag = 2;

/// Rows of the points sent to one rank.
struct Message {
    int rank;
    std::vector<double> rows;
};

std::vector<Message> pack(const Particles& particles, const Leavers& leavers,
                          std::span<const int> receivers) {
    const std::size_t width = particles.column_names().size();
    std::vector<Message> messages;
    for (const int receiver : receivers) messages.push_back({receiver, {}});
    for (std::size_t k = 0; k < leavers.points.size(); ++k) {
        if (leavers.owners[k] == nobody) continue;
        const auto message =
            std::ranges::lower_bound(messages, leavers.owners[k], {}, &Message::rank);
        const std::size_t at = message->rows.size();
        message->rows.resize(at + width);
        particles.copy_row(leavers.points[k], std::span(message->rows).subspan(at));
    }
    return messages;
}

/// Returns the ranks whose entry is not zero.
std::vector<int> ranks_with(std::span<const int> counts) {
    std::vector<int> ranks;
    for (std::size_t rank = 0; rank < counts.size(); ++rank)
        if (counts[rank] > 0) ranks.push_back(static_cast<int>(rank));
    return ranks;
}

struct Partners {
    std::vector<int> receivers, senders;  ///< ascending
};

Partners find_partners(const Leavers& leavers, MPI_Comm comm) {
    std::vector<int> outgoing(static_cast<std::size_t>(size_of(comm))), incoming(outgoing.size());
    for (const int owner : leavers.owners)
        if (owner != nobody) outgoing[static_cast<std::size_t>(owner)] = 1;
    MPI_Alltoall(outgoing.data(), 1, MPI_INT, incoming.data(), 1, MPI_INT, comm);
    return {ranks_with(outgoing), ranks_with(incoming)};
}

std::vector<double> receive(int sender, MPI_Comm comm) {
    MPI_Status status;
    MPI_Probe(sender, migration_tag, comm, &status);
    int length = 0;
    MPI_Get_count(&status, MPI_DOUBLE, &length);
    std::vector<double> rows(static_cast<std::size_t>(length));
    MPI_Recv(rows.data(), length, MPI_DOUBLE, sender, migration_tag, comm, MPI_STATUS_IGNORE);
    return rows;
}

}  // namespace

// rrcb::transfer would move the same points in the same order, but it needs a plan. The plan takes
// three more collective calls and, with the rows as its column, 1.4 to 1.9 times the instructions.
// rrcb::ghosts would not help in the steps either, because they exchange sums at nodes, not points.
std::size_t migrate(Particles& particles, const Leavers& leavers, Reach reach,
                    std::span<const int> neighbours, MPI_Comm comm) {
    if (reach == Reach::nowhere) {
        particles.remove(leavers.points);
        return 0;
    }
    Partners partners{{neighbours.begin(), neighbours.end()}, {}};
    partners.senders = partners.receivers;
    if (reach == Reach::anywhere) partners = find_partners(leavers, comm);

    std::vector<Message> messages = pack(particles, leavers, partners.receivers);
    particles.remove(leavers.points);
    std::vector<MPI_Request> requests(messages.size());
    for (std::size_t k = 0; k < messages.size(); ++k)
        MPI_Isend(messages[k].rows.data(), static_cast<int>(messages[k].rows.size()), MPI_DOUBLE,
                  messages[k].rank, migration_tag, comm, &requests[k]);
    const std::size_t num_stayed = particles.size();
    for (const int sender : partners.senders) particles.append(receive(sender, comm));
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    return particles.size() - num_stayed;
}

}  // namespace mpm
