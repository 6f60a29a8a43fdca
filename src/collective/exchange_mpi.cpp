#include "collective/exchange_mpi.hpp"

#include "collective/communicator.hpp"
#include "collective/rank_counts_mpi.hpp"

#include <algorithm>
#include <utility>

namespace rrcb {

std::size_t Exchange::announce(Participant& self) {
    from_ = exchange_counts(to_, self);
    std::size_t num_records = 0;
    for (const RankCount& share : from_) num_records += share.count;
    self.attempt([&] {
        buffers_.inbox.resize(record_bytes_ * num_records);
        const std::size_t bytes = buffers_.inbox.size() + buffers_.outbox.size();
        const std::size_t most = to_.size() + from_.size() + bytes / longest_message();
        requests_.reserve(mpi::to_int(static_cast<std::int64_t>(most)));
    });
    return num_records;
}

std::size_t Exchange::longest_message() const {
    return mpi::longest_message / record_bytes_ * record_bytes_;
}

/// Calls begin(rank, first, size, request) for each message. The message to or from a rank has
/// `size` bytes of the buffer, from `first` on.
template <class Begin>
void Exchange::begin_all(std::span<const RankCount> counts, Begin&& begin) {
    std::size_t first = 0;
    for (const auto& [rank, count] : counts) {
        const std::size_t end = first + count * record_bytes_;
        while (first < end) {
            const std::size_t size = std::min(end - first, longest_message());
            begin(rank, first, static_cast<int>(size), &requests_.emplace_back(MPI_REQUEST_NULL));
            first += size;
        }
    }
}

void Exchange::run(Participant& self) {
    begin_all(from_, [&](int rank, std::size_t first, int size, MPI_Request* request) {
        self.check(MPI_Irecv(&buffers_.inbox[first], size, MPI_BYTE, rank, mpi::exchange_tag,
                             self.comm, request),
                   "MPI_Irecv");
    });
    begin_all(to_, [&](int rank, std::size_t first, int size, MPI_Request* request) {
        self.check(MPI_Isend(&buffers_.outbox[first], size, MPI_BYTE, rank, mpi::exchange_tag,
                             self.comm, request),
                   "MPI_Isend");
    });
    self.check(
        MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE),
        "MPI_Waitall");
    self.throw_alone();
}

}  // namespace rrcb
