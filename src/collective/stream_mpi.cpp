#include "collective/stream_mpi.hpp"

#include "collective/communicator.hpp"

#include <rrcb/error.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace rrcb {

namespace {

/// Number of pieces for which each direction has memory if the limit is small: some are packed
/// while others are sent.
constexpr std::size_t pieces_under_way = 4;

}  // namespace

Stream::Stream(std::size_t record_bytes, std::size_t limit)
    : record_bytes_(record_bytes), lane_bytes_(limit / 2), most_records_(0) {
    if (record_bytes_ == 0) return;
    if (record_bytes_ > std::min(lane_bytes_, mpi::longest_message))
        throw Error(ErrorCode::invalid_argument,
                    "a point has " + std::to_string(record_bytes_) +
                        " bytes in these columns; TransferOptions::max_bytes must hold two, and a "
                        "message one");
    const std::size_t bytes = std::min(lane_bytes_ / pieces_under_way, mpi::longest_message);
    most_records_ = std::max(std::size_t{1}, bytes / record_bytes_);
}

/// Divides the records of a lane into pieces. They are ordered by steps: the number of ranks from
/// this rank to the other one, counted in the direction of the messages.
void Stream::lay_out(std::span<const RankCount> counts, int rank, int num_ranks, Lane& lane) const {
    std::size_t first = 0;
    for (const RankCount& share : counts) {
        const std::size_t end = first + share.count;
        while (first < end) {
            const std::size_t count = std::min(end - first, most_records_);
            lane.pieces.push_back({share.rank, first, count});
            first += count;
        }
    }
    std::ranges::sort(lane.pieces, {}, [&](const Piece& piece) {
        const int step = &lane == &sends_ ? piece.rank - rank : rank - piece.rank;
        return std::pair(step < 0 ? step + num_ranks : step, piece.first);
    });
}

/// Allocates memory for each piece, or for as many pieces of the maximum length as the limit
/// allows.
void Stream::make_buffer(Lane& lane) const {
    if (lane.pieces.empty()) return;
    std::size_t bytes = 0;
    std::size_t longest = 0;
    for (Piece& piece : lane.pieces) {
        piece.offset = bytes;
        bytes += piece.count * record_bytes_;
        longest = std::max(longest, piece.count * record_bytes_);
    }
    std::size_t num_places = lane.pieces.size();
    if (bytes > lane_bytes_) {
        num_places = lane_bytes_ / longest;
        bytes = num_places * longest;
        for (std::size_t k = 0; k < lane.pieces.size(); ++k)
            lane.pieces[k].offset = k % num_places * longest;
    }
    lane.buffer.resize(bytes);
    lane.requests.assign(num_places, MPI_REQUEST_NULL);
}

void Stream::allocate(std::span<const RankCount> to, std::span<const RankCount> from, int rank,
                      int num_ranks) {
    if (record_bytes_ == 0) return;
    lay_out(to, rank, num_ranks, sends_);
    lay_out(from, rank, num_ranks, receives_);
    make_buffer(sends_);
    make_buffer(receives_);
}

void Stream::send(const Piece& piece, Participant& self) {
    self.check(MPI_Isend(&sends_.buffer[piece.offset],
                         static_cast<int>(piece.count * record_bytes_), MPI_BYTE, piece.rank,
                         mpi::stream_tag, self.comm, &sends_.request_of(sends_.num_begun - 1)),
               "MPI_Isend");
}

void Stream::receive(const Piece& piece, Participant& self) {
    self.check(
        MPI_Irecv(&receives_.buffer[piece.offset], static_cast<int>(piece.count * record_bytes_),
                  MPI_BYTE, piece.rank, mpi::stream_tag, self.comm,
                  &receives_.request_of(receives_.num_begun - 1)),
        "MPI_Irecv");
}

/// Waits for one of the oldest pieces, and returns its lane; null if all pieces have ended.
Stream::Lane* Stream::wait(Participant& self) {
    MPI_Request oldest[] = {receives_.oldest(), sends_.oldest()};
    int ended = MPI_UNDEFINED;
    self.check(MPI_Waitany(2, oldest, &ended, MPI_STATUS_IGNORE), "MPI_Waitany");
    if (ended == MPI_UNDEFINED) return nullptr;
    return ended == 0 ? &receives_ : &sends_;
}

}  // namespace rrcb
