#include "estimate/merge_tree_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/meeting_mpi.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

namespace rrcb {

namespace {

constexpr std::size_t most_doubles = 8192;  // doubles in a message

/// First message of a rank: its summary, and as much of its records as fits.
struct FirstMessage {
    Summary summary;
    std::array<double, most_doubles> records;

    std::span<double> records_of() {
        return std::span(records).first(
            std::min(most_doubles, static_cast<std::size_t>(summary.num_doubles)));
    }
};
static_assert(std::is_trivially_copyable_v<Summary>);

void send_records(std::span<const double> records, int to, mpi::Tag tag, Participant& self) {
    for (std::size_t at = 0; at < records.size(); at += most_doubles)
        send(std::as_bytes(records.subspan(at, std::min(most_doubles, records.size() - at))), to,
             tag, self);
}

/// Appends `count` doubles that it receives. Without memory it still receives them, because the
/// sender waits for that.
void receive_records(std::vector<double>& records, std::size_t count, int from, mpi::Tag tag,
                     Participant& self) {
    const std::size_t start = records.size();
    self.attempt([&] { records.resize(start + count); });
    const bool has_room = records.size() == start + count;
    std::array<double, most_doubles> dropped;
    for (std::size_t at = 0; at < count; at += most_doubles) {
        double* to = has_room ? records.data() + start + at : dropped.data();
        receive(std::as_writable_bytes(std::span(to, std::min(most_doubles, count - at))), from,
                tag, self);
    }
}

void send_up(Contribution& mine, int to, Participant& self) {
    if (!mine.summary.is_usable()) mine.records.clear();
    const bool is_usable = mine.summary.is_usable();
    mine.summary.num_extent_doubles = is_usable ? std::ssize(mine.extents) : 0;
    mine.summary.num_total_doubles = is_usable ? std::ssize(mine.part_totals) : 0;
    mine.summary.num_doubles = static_cast<std::int64_t>(mine.records.size());
    FirstMessage first;
    first.summary = mine.summary;
    const std::span<double> in_first = first.records_of();
    std::copy_n(mine.records.begin(), in_first.size(), in_first.begin());
    send(std::as_bytes(std::span(&first, 1))
             .first(offsetof(FirstMessage, records) + in_first.size_bytes()),
         to, mpi::contribution_tag, self);
    send_records(std::span(mine.records).subspan(in_first.size()), to, mpi::contribution_tag, self);
}

/// Receives and adds the contribution of a child.
void receive_up(Contribution& mine, int child, int dimension, std::size_t most, Participant& self) {
    FirstMessage first;
    receive(std::as_writable_bytes(std::span(&first, 1)), child, mpi::contribution_tag, self);
    const std::span<double> in_first = first.records_of();
    self.attempt(
        [&] { mine.records.insert(mine.records.end(), in_first.begin(), in_first.end()); });
    receive_records(mine.records,
                    static_cast<std::size_t>(first.summary.num_doubles) - in_first.size(), child,
                    mpi::contribution_tag, self);
    self.attempt([&] { absorb(mine, first.summary, dimension, most); });
}

}  // namespace

void merge_up(Contribution& mine, int dimension, const MergeTree& tree, std::size_t most,
              Participant& self) {
    const int rank = mpi::rank_of(self.comm);
    mine.summary.first_rank = rank;
    tree.for_each_child(rank, [&](int child) { receive_up(mine, child, dimension, most, self); });
    // Sent with the cells, in one message.
    if (rank != 0)
        self.attempt([&] {
            std::vector<double>& records = mine.records;
            records.insert(records.end(), mine.extents.begin(), mine.extents.end());
            records.insert(records.end(), mine.part_totals.begin(), mine.part_totals.end());
        });
    if (self.failed()) mine.summary.failing_rank = rank;
    if (rank != 0) send_up(mine, tree.parent(rank), self);
}

void gather_records(std::vector<double>& records, Participant& self) {
    std::uint64_t count = records.size();
    const auto length = std::span(&count, 1);
    if (mpi::rank_of(self.comm) != root) {
        send(std::as_bytes(length), root, mpi::points_tag, self);
        send_records(records, root, mpi::points_tag, self);
        return;
    }
    const int num_ranks = mpi::size_of(self.comm);
    for (int rank = root + 1; rank < num_ranks; ++rank) {
        receive(std::as_writable_bytes(length), rank, mpi::points_tag, self);
        receive_records(records, static_cast<std::size_t>(count), rank, mpi::points_tag, self);
    }
}

}  // namespace rrcb
