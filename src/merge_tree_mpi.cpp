#include "merge_tree_mpi.hpp"

#include "mpi/communicator.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace rrcb {

namespace {

constexpr int merge_tag = 1;
constexpr std::size_t piece = 8192;  // doubles in a message

void send(std::span<const std::byte> bytes, int to, Member& me) {
    me.always([&] {
        mpi::check(MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, merge_tag,
                            me.comm),
                   "MPI_Send");
    });
}

void receive(std::span<std::byte> bytes, int from, Member& me) {
    me.always([&] {
        mpi::check(MPI_Recv(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, from, merge_tag,
                            me.comm, MPI_STATUS_IGNORE),
                   "MPI_Recv");
    });
}

/// Receives `count` doubles behind those that are there. Without memory for them they are still
/// received, for their sender's sake.
void receive_records(std::vector<double>& records, std::size_t count, int from, Member& me) {
    const std::size_t start = records.size();
    me.locally([&] { records.resize(start + count); });
    const bool has_room = records.size() == start + count;
    std::array<double, piece> dropped;
    for (std::size_t at = 0; at < count; at += piece) {
        double* to = has_room ? records.data() + start + at : dropped.data();
        receive(std::as_writable_bytes(std::span(to, std::min(piece, count - at))), from, me);
    }
}

void send_up(Contribution& mine, int to, Member& me) {
    if (!mine.summary.is_usable()) mine.records.clear();
    mine.summary.num_doubles = static_cast<std::int64_t>(mine.records.size());
    send(std::as_bytes(std::span(&mine.summary, 1)), to, me);
    const std::span<const double> records(mine.records);
    for (std::size_t at = 0; at < records.size(); at += piece)
        send(std::as_bytes(records.subspan(at, std::min(piece, records.size() - at))), to, me);
}

}  // namespace

void merge_up(Contribution& mine, int dimension, const MergeTree& tree, std::size_t most,
              Member& me) {
    const int rank = mpi::rank_of(me.comm);
    mine.summary.first_rank = rank;
    tree.for_each_child(rank, [&](int child) {
        Summary theirs;
        receive(std::as_writable_bytes(std::span(&theirs, 1)), child, me);
        receive_records(mine.records, static_cast<std::size_t>(theirs.num_doubles), child, me);
        me.locally([&] { absorb(mine, theirs, dimension, most); });
    });
    if (me.failure.failed) mine.summary.failing_rank = rank;
    if (rank != 0) send_up(mine, tree.parent(rank), me);
}

}  // namespace rrcb
