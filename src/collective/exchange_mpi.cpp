#include "collective/exchange_mpi.hpp"

#include "collective/communicator.hpp"
#include "collective/rank_counts_mpi.hpp"

#include <rrcb/error.hpp>

#include <algorithm>
#include <utility>

namespace rrcb {

std::size_t Exchange::most_records() const {
    return mpi::longest_message / record_bytes_;
}

void Exchange::make_outbox(std::vector<RankCount> counts, std::size_t num_records) {
    const std::size_t most = counts.size() + num_records / most_records();
    requests_.reserve(mpi::to_int(static_cast<std::int64_t>(most)));
    buffers_.outbox.resize(record_bytes_ * num_records);
    counts_ = std::move(counts);
}

std::size_t Exchange::announce(Participant& self) {
    const std::size_t num_records = count_arrivals(counts_, self);
    self.attempt([&] {
        buffers_.inbox.resize(record_bytes_ * num_records);
        arrived_.reserve(std::min(
            num_records, static_cast<std::size_t>(num_ranks_) + num_records / most_records()));
    });
    return num_records;
}

void Exchange::send_all(Participant& self) {
    const std::byte* next = buffers_.outbox.data();
    for (const auto& [destination, total] : counts_) {
        LocalIndex left = total;
        while (left > 0) {
            const std::size_t count = std::min(left, most_records());
            const std::size_t bytes = count * record_bytes_;
            MPI_Request& request = requests_.emplace_back(MPI_REQUEST_NULL);
            self.check(MPI_Isend(next, static_cast<int>(bytes), MPI_BYTE, destination,
                                 mpi::exchange_tag, self.comm, &request),
                       "MPI_Isend");
            next += bytes;
            left -= count;
        }
    }
}

void Exchange::receive_all(Participant& self) {
    std::size_t first = 0;
    // All records before `first` have been received. The inbox has the announced length, so no
    // other message is expected.
    while (first < buffers_.inbox.size()) {
        const std::size_t most =
            std::min(buffers_.inbox.size() - first, most_records() * record_bytes_);
        MPI_Status status{};
        int bytes = 0;
        self.check(MPI_Recv(&buffers_.inbox[first], static_cast<int>(most), MPI_BYTE,
                            MPI_ANY_SOURCE, mpi::exchange_tag, self.comm, &status),
                   "MPI_Recv");
        if (MPI_Get_count(&status, MPI_BYTE, &bytes) != MPI_SUCCESS || bytes <= 0) return;
        const auto size = static_cast<std::size_t>(bytes);
        arrived_.push_back({status.MPI_SOURCE, first / record_bytes_, size / record_bytes_});
        first += size;
    }
}

void Exchange::run(Participant& self) {
    send_all(self);
    receive_all(self);
    self.check(
        MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE),
        "MPI_Waitall");
    self.throw_alone();
    std::ranges::sort(arrived_, [](const Message& a, const Message& b) {
        return std::pair(a.source, a.first) < std::pair(b.source, b.first);
    });
}

}  // namespace rrcb
