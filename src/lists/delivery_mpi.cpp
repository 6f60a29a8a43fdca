#include "lists/delivery_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/column_type.hpp"
#include "collective/communicator.hpp"
#include "collective/neighbour_exchange_mpi.hpp"
#include "collective/rank_counts_mpi.hpp"
#include "collective/stream_mpi.hpp"
#include "lists/message_rows.hpp"
#include "options/rejection.hpp"

#include <rrcb/detail/mix.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

namespace rrcb {

namespace {

using detail::ByteColumn;

/// One column in a message. The bytes of a point are contiguous.
struct Lane {
    const std::byte* from;
    std::byte* to;
    std::size_t bytes;  ///< number of bytes of a point
};

/// Returns the number of bytes of a point in all columns.
std::size_t point_bytes_of(std::span<const ByteColumn> columns) {
    std::size_t bytes = 0;
    for (const ByteColumn& column : columns) {
        if (column.components > (mpi::longest_message - bytes) / column.value_bytes)
            reject(
                "a point has more bytes in these columns than a message holds; move the columns in "
                "several calls");
        bytes += column.components * column.value_bytes;
    }
    return bytes;
}

std::uint64_t hash_of_columns(std::span<const ByteColumn> columns) {
    std::uint64_t hash = columns.size();
    for (const ByteColumn& column : columns) hash = detail::mix(hash ^ type_of(column));
    return hash;
}

template <class Value>
Value of_root(Value value, const Participant& self) {
    mpi::broadcast(std::as_writable_bytes(std::span(&value, 1)), root, self.comm);
    return value;
}

/// Throws the Error that names the first column of the lowest rank which differs from the root's.
/// Collective. Called only if the hashes of the columns differ.
void refuse_types(std::span<const ByteColumn> columns, Participant& self) {
    const std::size_t num_of_root = of_root(columns.size(), self);
    self.attempt([&] {
        if (columns.size() != num_of_root)
            reject(std::to_string(columns.size()) + " columns, but " + std::to_string(num_of_root) +
                   " on rank 0; give the same columns on every rank");
    });
    for (std::size_t k = 0; k < num_of_root; ++k) {
        const ColumnType here = k < columns.size() ? type_of(columns[k]) : ColumnType{};
        const ColumnType there = of_root(here, self);
        self.attempt([&] {
            if (here != there)
                reject("column " + std::to_string(k) + " (the first is 0) has " +
                       text_of_type(here) + ", but " + text_of_type(there) +
                       " on rank 0; give the same on every rank");
        });
    }
    agree(self);
}

/// Throws Error unless the counts that other ranks send to this one are the `expected` ones.
void check_agreement(std::span<const RankCount> expected, std::span<const RankCount> sent) {
    const auto differ = std::ranges::mismatch(expected, sent, [](const auto& a, const auto& b) {
        return a.rank == b.rank && a.count == b.count;
    });
    constexpr RankCount none{std::numeric_limits<int>::max(), 0};
    const RankCount mine = differ.in1 != expected.end() ? *differ.in1 : none;
    const RankCount theirs = differ.in2 != sent.end() ? *differ.in2 : none;
    const int rank = std::min(mine.rank, theirs.rank);
    if (rank == none.rank) return;
    const auto count_in = [&](const RankCount& share) {
        return std::to_string(share.rank == rank ? share.count : 0);
    };
    reject("rank " + std::to_string(rank) + " sends " + count_in(theirs) + " points, not " +
           count_in(mine) +
           " as this plan has it; make the plans of all ranks in one call, with this "
           "communicator");
}

std::vector<Lane> make_results(std::span<const ByteColumn> columns, LocalIndex num_points) {
    std::vector<Lane> lanes;
    for (const ByteColumn& column : columns)
        lanes.push_back({column.from, column.resize(column.result, num_points * column.components),
                         column.value_bytes * column.components});
    return lanes;
}

void keep(const Delivery& delivery, const Lane& lane) {
    if (delivery.num_kept == 0) return;
    std::byte* to = lane.to;
    LocalIndex begin = 0;
    const auto copy_run = [&](LocalIndex end) {
        const std::size_t bytes = (end - begin) * lane.bytes;
        copy_bytes(lane.from + begin * lane.bytes, bytes, to);
        to += bytes;
    };
    for (const LocalIndex index : delivery.removed) {
        copy_run(index);
        begin = index + 1;
    }
    copy_run(delivery.num_points);
}

/// Returns true if the points after the delivery may have the same hash as those before: their
/// number is the same, and some column has the same first, middle and last rows. A column of
/// structs counts as unchanged: its bytes may differ although the positions in it do not.
bool is_like_before(const Delivery& delivery, std::span<const ByteColumn> columns,
                    std::span<const Lane> lanes) {
    const LocalIndex count = delivery.num_points;
    if (delivery.num_kept + total(delivery.from) != count) return false;
    for (std::size_t k = 0; k < lanes.size(); ++k) {
        const auto is_same = [&](LocalIndex i) {
            const std::size_t at = i * lanes[k].bytes;
            return std::memcmp(lanes[k].from + at, lanes[k].to + at, lanes[k].bytes) == 0;
        };
        if (columns[k].kind == detail::ValueKind::other || count == 0 ||
            (is_same(0) && is_same(count / 2) && is_same(count - 1)))
            return true;
    }
    return false;
}

/// Returns true if the messages to some ranks, each sent as one piece, take at most half of the
/// limit.
bool are_within(const TransferOptions& options, std::span<const ByteColumn> columns,
                std::span<const RankCount> counts) {
    std::size_t bytes = 0;
    for (const RankCount& one : counts)
        bytes +=
            NeighbourExchange::header_bytes(columns.size()) + message_bytes(columns, one.count);
    return bytes <= options.max_bytes / 2;
}

void run(Stream& stream, const Delivery& delivery, std::span<const Lane> lanes, Participant& self) {
    // Each piece of a message contains the rows of one column after the other.
    const auto pack = [&](std::size_t first, std::size_t count, std::byte* place) {
        for (const Lane& lane : lanes) {
            if (delivery.sent.empty()) {
                copy_bytes(lane.from + first * lane.bytes, count * lane.bytes, place);
            } else {
                gather(lane.from, lane.bytes, delivery.sent.subspan(first, count), place);
            }
            place += count * lane.bytes;
        }
    };
    const auto unpack = [&](std::size_t first, std::size_t count, const std::byte* place) {
        for (const Lane& lane : lanes) {
            copy_bytes(place, count * lane.bytes,
                       lane.to + (delivery.num_kept + first) * lane.bytes);
            place += count * lane.bytes;
        }
    };
    stream.run(self, pack, unpack);
}

}  // namespace

std::byte* detail::refuse_to_resize(std::size_t from, std::size_t to) {
    reject("an array of fixed size has " + std::to_string(from) + " values, but " +
           std::to_string(to) + " are needed; give a vector, or an array of that size");
}

LocalIndex total(std::span<const RankCount> counts) {
    LocalIndex sum = 0;
    for (const RankCount& share : counts) sum += share.count;
    return sum;
}

void check_column(const ByteColumn& column, LocalIndex count, std::string_view entries) {
    const std::size_t components = column.components;
    if (components == 0)
        reject("components of a column must be 1 or more; leave out columns without values");
    if (column.num_values % components == 0 && column.num_values / components == count) return;
    std::string fix = "; give " + std::to_string(components) + " for each";
    if (count > 0 && column.num_values > 0 && column.num_values % count == 0)
        fix += ", or column(values, " + std::to_string(column.num_values / count) + ')';
    reject("a column has " + std::to_string(column.num_values) + " values for " +
           std::to_string(count) + " " + std::string(entries) + fix);
}

void check_results(std::span<const ByteColumn> columns) {
    for (std::size_t k = 0; k < columns.size(); ++k)
        for (std::size_t j = 0; j < k; ++j)
            if (columns[j].result == columns[k].result)
                reject("columns " + std::to_string(j) + " and " + std::to_string(k) +
                       " (the first is 0) are the same array; name each array once");
}

void check_counts(std::span<const RankCount> counts, LocalIndex total_count, int num_ranks) {
    int least = 0;
    for (const RankCount& share : counts) {
        if (share.rank < least || share.rank >= num_ranks)
            reject("the plan names rank " + std::to_string(share.rank) + ", which is none of the " +
                   std::to_string(num_ranks) +
                   " of this communicator or not in ascending order; give the plan as it was made, "
                   "with its communicator");
        least = share.rank + 1;
    }
    require(total(counts) == total_count,
            "the counts of the plan do not add up to its list; give the plan as it was made");
}

Delivered deliver(const Delivery& delivery, std::span<const ByteColumn> columns,
                  const TransferOptions& options, Participant& self) {
    std::size_t point_bytes = 0;
    self.attempt([&] {
        for (const ByteColumn& column : columns)
            check_column(column, delivery.num_points, "points of the plan");
        point_bytes = point_bytes_of(columns);
    });
    const auto overtaking = static_cast<double>(delivery.overtaking);
    const bool fits =
        are_within(options, columns, delivery.to) && are_within(options, columns, delivery.from);
    Flags flags{0, overtaking, -overtaking, !fits ? 2. : delivery.to.empty() ? 0. : 1.};
    const std::vector<RankCount> sent = exchange_counts(delivery.to, self, &flags);
    self.compare([&] {
        require(
            flags[1] == 0 || flags[1] != -flags[2],
            "the points were transferred since these ghosts were found; find them again, or, if "
            "other points were transferred, use another communicator for these");
        check_agreement(delivery.from, sent);
    });
    std::optional<Stream> stream;
    std::vector<Lane> lanes;
    self.attempt([&] {
        stream.emplace(point_bytes, options.max_bytes);
        stream->allocate(delivery.to, delivery.from, mpi::rank_of(self.comm),
                         mpi::size_of(self.comm));
        lanes = make_results(columns, delivery.num_kept + total(delivery.from));
        if (delivery.is_in_place)
            for (Lane& lane : lanes) lane.from = lane.to;
    });
    std::array shared{Shared{"the type of a column", hash_of_columns(columns)},
                      Shared{"TransferOptions::max_bytes", options.max_bytes}};
    const std::size_t differing = find_difference(self, shared);
    if (differing == 0) refuse_types(columns, self);
    if (differing < shared.size()) refuse(shared[differing], self);
    if (!delivery.is_in_place)
        for (const Lane& lane : lanes) keep(delivery, lane);
    run(*stream, delivery, lanes, self);
    if (options.report != nullptr)
        *options.report = {stream->num_bytes(), point_bytes * total(delivery.to),
                           stream->num_messages()};
    return {flags[3] > 0, flags[3] < 2, is_like_before(delivery, columns, lanes)};
}

}  // namespace rrcb
