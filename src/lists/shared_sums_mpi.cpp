#include "lists/message_rows.hpp"
#include "lists/neighbours_state_mpi.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <cstring>
#include <string>

namespace rrcb {

using detail::ByteColumn;
using detail::no_entry;
using detail::SumColumn;

namespace {

bool are_zero(const std::byte* values, std::size_t bytes) {
    std::uint64_t word = 0;
    for (; bytes >= sizeof word; bytes -= sizeof word, values += sizeof word) {
        std::memcpy(&word, values, sizeof word);
        if (word != 0) return false;
    }
    return std::all_of(values, values + bytes, [](std::byte b) { return b == std::byte{}; });
}

bool is_zero(std::span<const ByteColumn> columns, LocalIndex entry) {
    return std::ranges::all_of(columns, [&](const ByteColumn& column) {
        return are_zero(column.from + entry * row_bytes(column), row_bytes(column));
    });
}

}  // namespace

/// Checks the lists, and finds the entries that are not 0 on this rank.
void Neighbours::State::list_shared(const SharedEntries& shared,
                                    std::span<const SumColumn> columns) {
    LocalIndex number = 0;
    if (!columns.empty())
        number =
            columns[0].points.num_values / std::max<std::size_t>(1, columns[0].points.components);
    for (const SumColumn& column : columns) check_column(column.points, number, "entries");
    if (number > 0) check_results(of_ghosts);
    common.assign(own() + 1, {});
    LocalIndex first = 0;
    for (const RankCount& one : shared.ranks) {
        const auto found = std::ranges::lower_bound(exchange->ranks(), one.rank);
        if (found == exchange->ranks().end() || *found != one.rank)
            reject("entries are shared with rank " + std::to_string(one.rank) +
                   ", which is no neighbour of this one");
        const auto n = static_cast<std::size_t>(found - exchange->ranks().begin());
        require(common[n].count == 0, "shared entries must name each rank once");
        require(one.count <= shared.indices.size() - first,
                "the numbers of shared entries do not add up to their list");
        common[n] = {first, one.count};
        first += one.count;
    }
    require(first == shared.indices.size(),
            "the numbers of shared entries do not add up to their list");
    require(std::ranges::all_of(shared.indices,
                                [&](LocalIndex i) { return i < number || i == no_entry; }),
            "indices of shared entries must be below the number of entries, or the greatest "
            "LocalIndex");
    if (marks.size() < number) marks.resize(number);
    entries.clear();
    entries.reserve(shared.indices.size());
    for (const LocalIndex i : shared.indices) {
        if (i == no_entry || marks[i] != Mark::none) continue;
        marks[i] = is_zero(of_ghosts, i) ? Mark::zero : Mark::sent;
        if (marks[i] == Mark::sent) entries.push_back(i);
    }
}

/// Writes a message: the number of listed entries, the runs of those that are not 0 on this rank,
/// and their values.
void Neighbours::State::pack_shared(const SharedEntries& shared, std::size_t n) {
    const std::span<const LocalIndex> listed = shared_with(shared, n);
    runs.assign(1, {listed.size(), 0});
    sent_entries.clear();
    std::size_t next = listed.size();
    for (std::size_t k = 0; k < listed.size(); ++k) {
        if (listed[k] == no_entry || marks[listed[k]] != Mark::sent) continue;
        if (k != next) runs.push_back({k, 0});
        ++runs.back().count;
        next = k + 1;
        sent_entries.push_back(listed[k]);
    }
    runs.front().count = runs.size() - 1;
    const std::size_t bytes = runs.size() * sizeof(Run);
    std::byte* const place = exchange->message_to(
        n, sent_entries.size(), bytes + message_bytes(of_ghosts, sent_entries.size()));
    std::memcpy(place, runs.data(), bytes);
    pack(of_ghosts, sent_entries, place + bytes);
}

void Neighbours::State::clear_marks(const SharedEntries& shared) {
    for (const LocalIndex i : shared.indices)
        if (i != no_entry) marks[i] = Mark::none;
}

/// Reads where the values of a message belong. Throws Error if the lists of the ranks differ.
void Neighbours::State::find_segments(const SharedEntries& shared, std::size_t n) {
    const std::span<const LocalIndex> listed = shared_with(shared, n);
    const std::byte* place = exchange->message_from(n).data();
    Run head{};
    std::memcpy(&head, place, sizeof head);
    if (head.first != listed.size())
        reject("rank " + std::to_string(rank_of(n)) + " shares " + std::to_string(head.first) +
               " entries with rank " + std::to_string(territory.rank()) + ", which lists " +
               std::to_string(listed.size()));
    received[n].begin = segments.size();
    received[n].values = place + (1 + head.count) * sizeof head;
    LocalIndex row = 0;
    for (std::uint64_t r = 0; r < head.count; ++r) {
        Run run{};
        std::memcpy(&run, place += sizeof run, sizeof run);
        // Entries that this rank does not hold divide a run.
        LocalIndex begin = run.first;
        for (LocalIndex k = run.first; k <= run.first + run.count; ++k) {
            if (k < run.first + run.count && listed[k] != no_entry) continue;
            if (k > begin)
                segments.push_back({listed.subspan(begin, k - begin), row + begin - run.first});
            begin = k + 1;
        }
        row += run.count;
    }
    received[n].end = segments.size();
}

void Neighbours::State::add_shared(const SharedEntries& shared,
                                   std::span<const SumColumn> columns) {
    segments.clear();
    received.resize(own());
    for (std::size_t n = 0; n < own(); ++n) find_segments(shared, n);
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const ByteColumn& column = columns[k].points;
        const std::size_t bytes = row_bytes(column);
        std::byte* const sums = column.resize(column.result, column.num_values);
        own_values.resize(entries.size() * bytes);
        gather(sums, bytes, entries, own_values.data());
        for (const LocalIndex i : entries) std::fill_n(sums + i * bytes, bytes, std::byte{});
        for (const std::size_t n : by_rank) {
            if (n == own()) {
                columns[k].add(entries, column.components, own_values.data(), sums);
                continue;
            }
            const std::byte* const values =
                received[n].values +
                message_bytes(std::span(of_ghosts).first(k), exchange->rows_from(n));
            for (const Segment& segment : std::span(segments).subspan(
                     received[n].begin, received[n].end - received[n].begin))
                columns[k].add(segment.entries, column.components, values + segment.row * bytes,
                               sums);
        }
    }
}

}  // namespace rrcb
