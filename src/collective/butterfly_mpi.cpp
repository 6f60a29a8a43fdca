#include "collective/butterfly_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/meeting_mpi.hpp"

#include <algorithm>

namespace rrcb {

namespace {

std::size_t num_pieces(std::size_t length, std::size_t most_in_piece) {
    return (length + most_in_piece - 1) / most_in_piece;
}

std::span<const double> piece_of(std::span<const double> message, std::size_t number,
                                 std::size_t most_in_piece) {
    const std::size_t first = number * most_in_piece;
    return message.subspan(first, std::min(most_in_piece, message.size() - first));
}

void add_failure(Flags& flags, const Butterfly& butterfly, const Participant& self) {
    if (self.failed())
        mark_failed(flags, butterfly.rank(), butterfly.num_ranks(), self.failure.may_follow);
}

void begin_to_send(std::span<const double> piece, int to, MPI_Request& request, Participant& self) {
    self.check(MPI_Isend(piece.data(), static_cast<int>(piece.size_bytes()), MPI_BYTE, to,
                         self.tag(mpi::butterfly_tag), self.comm, &request),
               "MPI_Isend");
}

}  // namespace

std::span<double> ButterflyMessages::piece() {
    return std::span(piece_).first(std::min(piece_.size(), mpi::longest_message / sizeof(double)));
}

void ButterflyMessages::run(Butterfly& butterfly, Butterfly::Direction direction, Flags flags,
                            Participant& self) {
    add_failure(flags, butterfly, self);
    if (butterfly.is_central() && direction == Butterfly::back) {
        if (butterfly.rank() == root) {
            flags[0] = std::max(flags[0], butterfly.flags()[0]);
        } else {
            flags = {};
        }
    }
    butterfly.start(flags);
    const int num_steps = butterfly.num_steps();
    for (int k = 0; k < num_steps; ++k) {
        const int step = direction == Butterfly::to_owners ? k : num_steps - 1 - k;
        for (const Butterfly::Link& link : butterfly.links(step, direction))
            exchange(butterfly, step, direction, link, self);
    }
    const int failing = failing_rank(butterfly.flags(), butterfly.num_ranks());
    // The other ranks learn of the failure on the way back.
    if (butterfly.is_central() && direction == Butterfly::to_owners) return self.hear_of(failing);
    note_met(self);
    fail_together(failing, self);
}

/// Sends and receives the messages of a link. Each piece is sent and received at the same time, so
/// that two ranks never wait for each other.
void ButterflyMessages::exchange(Butterfly& butterfly, int step, Butterfly::Direction direction,
                                 const Butterfly::Link& link, Participant& self) {
    butterfly.pack_nothing();
    if (link.sends) self.attempt([&] { butterfly.pack(step, direction, link); });
    if (self.failed()) {
        // On the way to rank 0 a rank sends after it has received everything, so it can still add
        // the failure to its flags for rank 0.
        if (butterfly.is_central() && direction == Butterfly::to_owners) {
            Flags flags = butterfly.flags();
            add_failure(flags, butterfly, self);
            butterfly.start(flags);
        }
        butterfly.pack_nothing();
    }
    const std::span<const double> sent = butterfly.message();
    const std::size_t longest = piece().size();
    const std::size_t num_sent = link.sends ? num_pieces(sent.size(), longest) : 0;
    std::size_t num_received = link.receives ? 1 : 0;
    for (std::size_t k = 0; k < num_sent || k < num_received; ++k) {
        MPI_Request request = MPI_REQUEST_NULL;
        if (k < num_sent) begin_to_send(piece_of(sent, k, longest), link.rank, request, self);
        if (k < num_received) num_received = receive(k, link.rank, self);
        wait(request, "MPI_Wait", self);
    }
    if (!link.receives) return;
    butterfly.hear(head_);
    self.attempt([&] { butterfly.take(step, direction, link, arrived_); });
}

/// Receives a piece of a message, even if there is no memory to keep it. Returns the number of
/// pieces.
std::size_t ButterflyMessages::receive(std::size_t number, int from, Participant& self) {
    const std::span<double> piece = this->piece();
    std::fill_n(piece.begin(), head_.size(), 0.0);
    rrcb::receive(std::as_writable_bytes(piece), from, mpi::butterfly_tag, self);
    if (number == 0) {
        std::copy_n(piece.begin(), head_.size(), head_.begin());
        arrived_.clear();
    }
    const auto length = std::max(static_cast<std::size_t>(head_[0]), head_.size());
    self.attempt([&] {
        if (number == 0) arrived_.reserve(length);
        const std::size_t size = std::min(piece.size(), length - number * piece.size());
        arrived_.insert(arrived_.end(), piece.begin(), piece.begin() + size);
    });
    return num_pieces(length, piece.size());
}

}  // namespace rrcb
