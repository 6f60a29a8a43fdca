#pragma once

#include "collective/participant.hpp"

#include <rrcb/plan.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace rrcb {

/// Sends records of one size between ranks, in pieces that keep within a limit of memory. Each rank
/// knows how many records it receives from every other rank.
class Stream {
  public:
    /// The size and the limit must be the same on every rank. Throws Error if the limit is less
    /// than the memory of one record to send and one to receive.
    Stream(std::size_t record_bytes, std::size_t limit);

    /// Allocates memory for the records to and from each rank. Both lists are in ascending order of
    /// ranks.
    ///
    /// Not collective. Throws std::bad_alloc.
    void allocate(std::span<const RankCount> to, std::span<const RankCount> from, int rank,
                  int num_ranks);

    std::size_t num_bytes() const { return sends_.buffer.size() + receives_.buffer.size(); }
    std::size_t num_messages() const { return sends_.pieces.size(); }

    /// Sends and receives. Before, the ranks must have agreed that all of them have memory.
    ///
    /// Collective. pack(first, count, place) writes records to send; unpack(first, count, place)
    /// reads received ones. Records are numbered through over all ranks. If a message fails, throws
    /// Error on this rank only.
    ///
    /// There is no deadlock: a piece belongs to the same step, a distance between ranks, on both of
    /// its ranks, and each lane begins and ends its pieces in the order of steps. So the unfinished
    /// piece of the lowest step is first in its lane on both ranks, and can begin.
    template <class Pack, class Unpack>
    void run(Participant& self, Pack&& pack, Unpack&& unpack) {
        const auto begin_all = [&] {
            while (receives_.may_begin()) receive(receives_.begin_next(), self);
            while (sends_.may_begin()) {
                const Piece& piece = sends_.begin_next();
                pack(piece.first, piece.count, &sends_.buffer[piece.offset]);
                send(piece, self);
            }
        };
        begin_all();
        while (Lane* lane = wait(self)) {
            const Piece& piece = lane->pieces[lane->num_ended++];
            if (lane == &receives_)
                unpack(piece.first, piece.count, &receives_.buffer[piece.offset]);
            begin_all();
        }
        self.throw_alone();
    }

  private:
    /// Consecutive records to or from one rank, and their place in the buffer.
    struct Piece {
        int rank;
        std::size_t first;
        std::size_t count;
        std::size_t offset = 0;
    };

    /// The pieces in one direction, some of which are under way.
    struct Lane {
        std::vector<Piece> pieces;
        std::vector<std::byte> buffer;
        std::vector<MPI_Request> requests;  ///< one for each piece that may be under way
        std::size_t num_begun = 0;
        std::size_t num_ended = 0;

        bool may_begin() const {
            return num_begun < pieces.size() && num_begun - num_ended < requests.size();
        }
        const Piece& begin_next() { return pieces[num_begun++]; }
        MPI_Request& request_of(std::size_t piece) { return requests[piece % requests.size()]; }
        MPI_Request oldest() {
            return num_ended < num_begun ? request_of(num_ended) : MPI_REQUEST_NULL;
        }
    };

    void lay_out(std::span<const RankCount> counts, int rank, int num_ranks, Lane& lane) const;
    void make_buffer(Lane& lane) const;
    void send(const Piece& piece, Participant& self);
    void receive(const Piece& piece, Participant& self);
    Lane* wait(Participant& self);

    std::size_t record_bytes_;
    std::size_t lane_bytes_;    ///< maximum memory of each direction
    std::size_t most_records_;  ///< in a piece
    Lane sends_;
    Lane receives_;
};

}  // namespace rrcb
