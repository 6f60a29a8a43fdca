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
    quiet.emplace(near->homes(), radius, territory.dimension(), territory.images());
    lists.emplace(near->ranks(), territory.images() != nullptr);
}

void Neighbours::State::check_positions(const Points& points) const {
    check_lengths(points);
    require(points.dimension == territory.dimension(),
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
        reaches.numbers().size() / static_cast<std::size_t>(territory.num_parts());
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
        exchange->attempt([&] { reaches.emplace(territory.num_parts(), territory.dimension()); });
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

}  // namespace rrcb
