#include "collective/agreement_mpi.hpp"
#include "collective/meeting_mpi.hpp"
#include "estimate/decision_mpi.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

namespace rrcb {

namespace {

constexpr std::size_t most_doubles = 8192;  // doubles in a message

/// First message of a rank: its summary, and as many of its records as fit.
struct FirstMessage {
    Summary summary;
    std::array<double, most_doubles> records;

    std::span<double> records_of() {
        return std::span(records).first(
            std::min(most_doubles, static_cast<std::size_t>(summary.num_doubles)));
    }
};
static_assert(std::is_trivially_copyable_v<Summary> && sizeof(Summary) % sizeof(double) == 0);

/// Sends the summary and all doubles: cells, extents and totals.
void send_up(Contribution& mine, int to, Participant& self) {
    Summary& summary = mine.summary;
    std::vector<double>& doubles = mine.records;
    self.attempt([&] {
        doubles.insert(doubles.end(), mine.extents.begin(), mine.extents.end());
        doubles.insert(doubles.end(), mine.part_totals.begin(), mine.part_totals.end());
    });
    if (self.failed()) summary.failing_rank = mpi::rank_of(self.comm);
    if (!summary.is_usable()) doubles.clear();
    summary.num_doubles = std::ssize(doubles);
    summary.num_extent_doubles = doubles.empty() ? 0 : std::ssize(mine.extents);
    summary.num_total_doubles = doubles.empty() ? 0 : std::ssize(mine.part_totals);
    FirstMessage first;
    first.summary = summary;
    const std::span<double> in_first = first.records_of();
    std::copy_n(doubles.begin(), in_first.size(), in_first.begin());
    send(std::as_bytes(std::span(&first, 1)).first(sizeof first.summary + in_first.size_bytes()),
         to, mpi::contribution_tag, self);
    for (std::size_t at = in_first.size(); at < doubles.size(); at += most_doubles)
        send(std::as_bytes(
                 std::span(doubles).subspan(at, std::min(most_doubles, doubles.size() - at))),
             to, mpi::contribution_tag, self);
}

/// Receives and adds the contribution of a child. Without memory it still receives all messages,
/// because the child waits for that.
void receive_up(Contribution& mine, int child, int dimension, std::size_t most, Participant& self) {
    FirstMessage first;
    receive(std::as_writable_bytes(std::span(&first, 1)), child, mpi::contribution_tag, self);
    const auto count = static_cast<std::size_t>(first.summary.num_doubles);
    const std::span<double> in_first = first.records_of();
    std::vector<double> doubles;
    self.attempt([&] {
        doubles.reserve(count);
        doubles.assign(in_first.begin(), in_first.end());
        doubles.resize(count);
    });
    for (std::size_t at = in_first.size(); at < count; at += most_doubles) {
        double* to = doubles.empty() ? first.records.data() : doubles.data() + at;
        receive(std::as_writable_bytes(std::span(to, std::min(most_doubles, count - at))), child,
                mpi::contribution_tag, self);
    }
    self.attempt([&] { absorb(mine, first.summary, doubles, dimension, most); });
}

}  // namespace

void merge_up(Contribution& mine, int dimension, const MergeTree& tree, std::size_t most,
              Participant& self) {
    const int rank = mpi::rank_of(self.comm);
    mine.summary.first_rank = rank;
    tree.for_each_child(rank, [&](int child) { receive_up(mine, child, dimension, most, self); });
    if (rank != root) send_up(mine, tree.parent(rank), self);
}

}  // namespace rrcb
