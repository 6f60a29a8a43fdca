#include "collective/neighbour_exchange_mpi.hpp"

#include "collective/column_type.hpp"
#include "collective/communicator.hpp"
#include "collective/spread_failure_mpi.hpp"
#include "collective/watch_mpi.hpp"
#include "options/rejection.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

namespace rrcb {

/// First bytes of a message. The types of the columns follow, then the rows.
struct NeighbourExchange::Header {
    std::uint64_t call_number;
    std::uint64_t version;
    std::uint64_t num_rows;
    std::uint32_t call;
    std::uint32_t num_columns;
};

namespace {

constexpr std::size_t alignment = 16;

std::size_t aligned(std::size_t bytes) {
    return (bytes + alignment - 1) / alignment * alignment;
}

std::string at_ranks(const std::string& mine, int rank, const std::string& theirs, int other) {
    return mine + " on rank " + std::to_string(rank) + ", but " + theirs + " on rank " +
           std::to_string(other) +
           "; every rank must make the same calls in the same order, with "
           "the same columns";
}

}  // namespace

NeighbourExchange::NeighbourExchange(std::vector<int> ranks, std::shared_ptr<CallLog> log)
    : log_(std::move(log)) {
    const std::size_t number = ranks.size();
    link_.ranks = std::move(ranks);
    link_.is_over.assign(number, 0);
    link_.outgoing = std::make_shared<LinkMessages>();
    link_.outgoing->messages.resize(number);
    link_.outgoing->requests.assign(number, MPI_REQUEST_NULL);
    incoming_.resize(number);
    log_->links.push_back(&link_);
}

NeighbourExchange::~NeighbourExchange() {
    std::erase(log_->links, &link_);
}

void NeighbourExchange::begin(CallName call, std::uint64_t version) {
    if (log_->end != CallLog::End::none)
        throw Error(ErrorCode::mpi,
                    log_->why + " (an earlier call failed: make other Neighbours and plans)");
    if (log_->comm == MPI_COMM_NULL)
        reject("the communicator was freed; free it after its last use");
    log_->add(call);
    ++num_calls_;
    call_ = call;
    version_ = version;
    types_.clear();
    failure_ = {};
    for (Incoming& incoming : incoming_) incoming.has_arrived = incoming.is_valid = false;
}

void NeighbourExchange::set_types(std::span<const detail::ByteColumn> columns) {
    types_.clear();
    for (const detail::ByteColumn& column : columns) types_.push_back(type_of(column));
}

std::size_t NeighbourExchange::header_bytes(std::size_t num_columns) {
    return aligned(sizeof(Header) + num_columns * sizeof(ColumnType));
}

std::size_t NeighbourExchange::num_bytes() const {
    std::size_t bytes = 0;
    for (const auto& message : link_.outgoing->messages) bytes += message.size();
    for (const Incoming& incoming : incoming_) bytes += incoming.bytes.size();
    return bytes;
}

std::byte* NeighbourExchange::message_to(std::size_t neighbour, std::size_t rows,
                                         std::size_t bytes) {
    detail::Uninitialized<std::byte>& message = link_.outgoing->messages[neighbour];
    const std::size_t begin = header_bytes(types_.size());
    mpi::to_int(static_cast<std::int64_t>(begin + bytes));
    message.resize(begin + bytes);
    std::fill_n(message.begin(), begin, std::byte{});
    const Header header{num_calls_, version_, rows, static_cast<std::uint32_t>(call_),
                        static_cast<std::uint32_t>(types_.size())};
    std::memcpy(message.data(), &header, sizeof header);
    if (!types_.empty())
        std::memcpy(message.data() + sizeof header, types_.data(),
                    types_.size() * sizeof(ColumnType));
    return message.data() + begin;
}

void NeighbourExchange::fail(const Failure& failure) {
    mpi::spread(failure, *log_);
}

/// Returns the failure with the number of this rank prefixed to its text, if there is memory for
/// that.
Failure NeighbourExchange::of_this_rank(const Failure& failure) const {
    Failure named = failure;
    rrcb::attempt([&] {
        named = failure_of(failure.code, "rank " + std::to_string(mpi::rank_of(log_->comm)) + ": " +
                                             failure.text.data());
    });
    return named;
}

void NeighbourExchange::note(const Failure& failure) {
    if (!failure_.failed) failure_ = failure;
}

void NeighbourExchange::check(int code, const char* call) {
    if (code != MPI_SUCCESS) note(of_this_rank(rrcb::attempt([&] { mpi::check(code, call); })));
}

void NeighbourExchange::run() {
    LinkMessages& out = *link_.outgoing;
    for (std::size_t n = 0; n < link_.ranks.size(); ++n)
        check(MPI_Isend(out.messages[n].data(), static_cast<int>(out.messages[n].size()), MPI_BYTE,
                        link_.ranks[n], mpi::neighbour_tag, log_->comm, &out.requests[n]),
              "MPI_Isend");
    std::optional<mpi::Watch> watch;
    try {
        while (true) {
            bool are_all = true;
            for (std::size_t n = 0; n < link_.ranks.size(); ++n) are_all = settle(n) && are_all;
            if (are_all) break;
            if (!watch) watch.emplace(*log_, mpi::Watch::Scope::neighbours);
            watch->look();
        }
    } catch (...) {
        mpi::keep_undelivered(*log_);
        throw;
    }
    for (std::size_t n = 0; n < link_.ranks.size(); ++n)
        if (incoming_[n].has_arrived && link_.is_over[n] == 0) compare(n);
}

/// Returns true if nothing more is expected from or to be sent to a neighbour in this call.
bool NeighbourExchange::settle(std::size_t neighbour) {
    if (link_.is_over[neighbour] != 0) return true;
    const Incoming& incoming = incoming_[neighbour];
    int is_sent = 0;
    check(MPI_Test(&link_.outgoing->requests[neighbour], &is_sent, MPI_STATUS_IGNORE), "MPI_Test");
    if (incoming.has_arrived && is_sent != 0) return true;
    // After the message of this call, only a notice may be received: another message belongs to the
    // next call.
    if (!incoming.has_arrived || is_notice_next(neighbour)) receive(neighbour);
    return link_.is_over[neighbour] != 0 || (incoming.has_arrived && is_sent != 0);
}

bool NeighbourExchange::is_notice_next(std::size_t neighbour) {
    int is_there = 0;
    MPI_Status status{};
    check(MPI_Iprobe(link_.ranks[neighbour], mpi::neighbour_tag, log_->comm, &is_there, &status),
          "MPI_Iprobe");
    int bytes = 0;
    if (is_there != 0) MPI_Get_count(&status, MPI_BYTE, &bytes);
    return bytes == sizeof(FailureNotice);
}

/// Receives the next message of a neighbour if it has arrived: the message of this call, or a
/// notice.
void NeighbourExchange::receive(std::size_t neighbour) {
    Incoming& incoming = incoming_[neighbour];
    int is_there = 0;
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Status status{};
    check(MPI_Improbe(link_.ranks[neighbour], mpi::neighbour_tag, log_->comm, &is_there, &message,
                      &status),
          "MPI_Improbe");
    if (is_there == 0) return;
    int bytes = 0;
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    FailureNotice notice;
    std::byte* place = reinterpret_cast<std::byte*>(&notice);
    if (bytes == sizeof notice) {
        link_.is_over[neighbour] = 1;
    } else {
        const Failure lacks_memory =
            rrcb::attempt([&] { incoming.bytes.resize(static_cast<std::size_t>(bytes)); });
        if (lacks_memory.failed) {
            // There is no memory, so the message is received without its contents.
            incoming.bytes.clear();
            bytes = 0;
            note(of_this_rank(lacks_memory));
        }
        place = incoming.bytes.data();
        incoming.has_arrived = true;
    }
    const int code = MPI_Mrecv(place, bytes, MPI_BYTE, &message, MPI_STATUS_IGNORE);
    if (!failure_.failed) check(code, "MPI_Mrecv");
    if (link_.is_over[neighbour] != 0) note(notice);
}

/// Compares the header of a message with this rank's call.
void NeighbourExchange::compare(std::size_t neighbour) {
    Incoming& incoming = incoming_[neighbour];
    const Failure differs = rrcb::attempt([&] {
        Header header;
        if (incoming.bytes.size() < sizeof header) throw std::bad_alloc();
        std::memcpy(&header, incoming.bytes.data(), sizeof header);
        const int rank = mpi::rank_of(log_->comm);
        const int other = link_.ranks[neighbour];
        const auto call = static_cast<CallName>(header.call);
        if (call != call_ || header.call_number != num_calls_)
            throw Error(ErrorCode::mpi, text_of(CallDifference{{rank, other}, {call_, call}}));
        if (header.num_columns != types_.size())
            reject(at_ranks(std::to_string(types_.size()) + " columns", rank,
                            std::to_string(header.num_columns), other));
        std::size_t place = sizeof header;
        for (std::size_t k = 0; k < types_.size(); ++k, place += sizeof(ColumnType)) {
            ColumnType theirs = 0;
            std::memcpy(&theirs, &incoming.bytes[place], sizeof theirs);
            if (theirs != types_[k])
                reject(at_ranks("column " + std::to_string(k) + " (the first is 0) has " +
                                    text_of_type(types_[k]),
                                rank, text_of_type(theirs), other));
        }
        if (header.version != version_)
            reject(at_ranks("ghosts were found " + std::to_string(version_) + " times", rank,
                            std::to_string(header.version) + " times", other));
    });
    incoming.is_valid = !differs.failed;
    note(differs);
}

std::size_t NeighbourExchange::rows_from(std::size_t neighbour) const {
    Header header;
    std::memcpy(&header, incoming_[neighbour].bytes.data(), sizeof header);
    return header.num_rows;
}

const std::byte* NeighbourExchange::message_from(std::size_t neighbour, std::size_t bytes) const {
    const detail::Uninitialized<std::byte>& message = incoming_[neighbour].bytes;
    if (message.size() != header_bytes(types_.size()) + bytes)
        throw Error(ErrorCode::internal, "a message of a neighbour has an unexpected length");
    return message.data() + header_bytes(types_.size());
}

void NeighbourExchange::end() {
    if (failure_.failed) fail(failure_);
}

}  // namespace rrcb
