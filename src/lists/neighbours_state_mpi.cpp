#include "lists/neighbours_state_mpi.hpp"

#include "collective/column_type.hpp"
#include "collective/stamp_access.hpp"
#include "lists/message_rows.hpp"
#include "lists/near_points.hpp"
#include "lists/part_reaches.hpp"
#include "lists/transfer_log.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <cstring>
#include <numeric>
#include <string>
#include <utility>

namespace rrcb {

using detail::ByteColumn;
using detail::SumColumn;

void detail::NeighbourAccess::fail(Neighbours& neighbours, CallName call, const Failure& failure) {
    NeighbourExchange& exchange = *Neighbours::State::of(neighbours).exchange;
    exchange.begin(call);
    exchange.attempt([&] { throw Error(failure.code, failure.text.data()); });
}

void Neighbours::State::open(std::vector<int> ranks, std::shared_ptr<CallLog> log) {
    exchange = std::make_unique<NeighbourExchange>(std::move(ranks), std::move(log));
    const std::size_t number = own() + 1;
    for (std::vector<Range>* ranges : {&send, &receive, &common}) ranges->resize(number);
    by_rank.resize(number);
    std::iota(by_rank.begin(), by_rank.end(), std::size_t{0});
    std::ranges::sort(by_rank, {}, [&](std::size_t n) { return rank_of(n); });
    near.emplace(territory.near_boxes(nullptr));
    quiet.emplace(near->homes(), radius, territory.cuts().dimension, territory.images());
    lists.emplace(near->ranks(), territory.images() != nullptr);
}

void Neighbours::State::check_positions(const Points& points) const {
    check_lengths(points);
    require(points.dimension == territory.cuts().dimension,
            "positions must have the dimension of the cuts: column(x, 2) or (x, 3)");
}

void Neighbours::State::check_radii(const Points& points, const Radii& radii) const {
    if (!radii.each) return;
    require(radii.each->size() == points.count, "cutoffs must have one entry for each point");
    require(std::ranges::all_of(*radii.each, [&](double r) { return r >= 0 && r <= radius; }),
            "each cutoff must be 0 or more, and at most that of NeighbourOptions");
}

void Neighbours::State::require_ghosts(Stage least) const {
    if (stage >= least) return;
    require(stage != Stage::moved,
            "points migrated since the ghosts were found; call find_ghosts() and fetch() again");
    reject(stage == Stage::none ? "there are no ghosts; call find_ghosts() and fetch() before"
                                : "ghosts were found, but not fetched; call fetch() before");
}

/// Exchanges the reaches of parts with the neighbours.
void Neighbours::State::exchange_reaches(const Points& points, const Radii& radii,
                                         PartReaches& reaches) {
    const std::size_t width =
        reaches.numbers().size() / static_cast<std::size_t>(territory.cuts().num_parts);
    const std::span<const Part> ends = territory.ends();
    const std::size_t row = sizeof(Part) * 4 + width * sizeof(double);
    exchange->attempt([&] {
        territory.note_reaches(points, radii, reaches);
        for (std::size_t n = 0; n < own(); ++n) {
            std::byte* place = exchange->message_to(n, ends.size(), block_bytes(row, ends.size()));
            for (const Part end : ends) {
                std::memcpy(place, &end, sizeof end);
                std::memcpy(place + 4 * sizeof end, reaches.numbers_of(end).data(),
                            width * sizeof(double));
                place += row;
            }
        }
    });
    exchange->run();
    exchange->end();
    exchange->attempt([&] {
        for (std::size_t n = 0; n < own(); ++n) {
            const std::size_t num_rows = exchange->rows_from(n);
            const std::byte* place = exchange->message_from(n, block_bytes(row, num_rows));
            for (std::size_t k = 0; k < num_rows; ++k, place += row) {
                Part end = 0;
                std::memcpy(&end, place, sizeof end);
                const auto* numbers = reinterpret_cast<const double*>(place + 4 * sizeof end);
                for (double& number : reaches.numbers_of(end))
                    number = std::max(number, *numbers++);
            }
        }
        near.emplace(territory.near_boxes(&reaches));
    });
}

void Neighbours::State::find_ghosts(const Points& points, const Radii& radii) {
    std::optional<PartReaches> reaches;
    if (radii.are_of_receivers()) {
        exchange->attempt(
            [&] { reaches.emplace(territory.cuts().num_parts, territory.cuts().dimension); });
        exchange_reaches(points, radii, *reaches);
    }
    exchange->attempt([&] {
        lists->clear();
        NearPoints near_points{
            points,           radii, *near, territory.images(), reaches ? &*reaches : nullptr,
            territory.rank(), *lists};
        near_points.list(*quiet, [&](LocalIndex i, const Vector& x) {
            if (territory.is_at_home(x)) return;
            territory.check_position(points, i);
            if (!territory.is_within_reach(x, radii.of(i)))
                reject(territory.name_of(points, i) +
                       " is too far outside the parts of this rank for its cutoff; call migrate() "
                       "before, or give more travel");
        });
        lists->write(ghosts);
        std::swap(shifts, ghosts.shifts);
        ghosts.shifts.clear();
        ghosts.receive.clear();
        note_sent();
        ghosts.num_points = points.count;
        detail::StampAccess::points(ghosts.stamp) = next_stamp();
        ++num_found;
        stage = Stage::found;
    });
}

void Neighbours::State::note_sent() {
    std::ranges::fill(send, Range{});
    LocalIndex first = 0;
    for (const RankCount& one : ghosts.send) {
        const auto found = std::ranges::lower_bound(exchange->ranks(), one.rank);
        const bool is_neighbour = found != exchange->ranks().end() && *found == one.rank;
        if (!is_neighbour && one.rank != territory.rank())
            reject(
                "rank " + std::to_string(one.rank) +
                " needs points, but is no neighbour; call migrate() before, or give more travel");
        const std::size_t n =
            is_neighbour ? static_cast<std::size_t>(found - exchange->ranks().begin()) : own();
        send[n] = {first, one.count};
        first += one.count;
    }
}

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
    require(std::ranges::all_of(shared.indices, [&](LocalIndex i) { return i < number; }),
            "indices of shared entries must be below the number of entries");
    if (is_listed.size() < number) is_listed.resize(number);
    entries.clear();
    entries.reserve(shared.indices.size());
    for (const LocalIndex i : shared.indices) {
        if (is_listed[i] == 0) entries.push_back(i);
        is_listed[i] = 1;
    }
    for (const LocalIndex i : entries) is_listed[i] = 0;
}

void Neighbours::State::add_shared(const SharedEntries& shared,
                                   std::span<const SumColumn> columns) {
    for (std::size_t n = 0; n < own(); ++n) {
        if (exchange->rows_from(n) != common[n].count)
            reject("rank " + std::to_string(rank_of(n)) + " shares " +
                   std::to_string(exchange->rows_from(n)) + " entries with rank " +
                   std::to_string(territory.rank()) + ", which lists " +
                   std::to_string(common[n].count));
        exchange->message_from(n, message_bytes(of_ghosts, common[n].count));
    }
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
                exchange->message_from(n, message_bytes(of_ghosts, common[n].count)) +
                message_bytes(std::span(of_ghosts).first(k), common[n].count);
            columns[k].add(shared_with(shared, n), column.components, values, sums);
        }
    }
}

}  // namespace rrcb
