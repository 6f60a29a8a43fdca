#include "arithmetic/non_stop.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/column_type.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/rank_counts_mpi.hpp"
#include "collective/stamp_access.hpp"
#include "lists/message_rows.hpp"
#include "lists/neighbours_state_mpi.hpp"
#include "lists/remap_mpi.hpp"
#include "options/rejection.hpp"
#include "options/request.hpp"
#include "options/validation.hpp"

#include <rrcb/detail/mix.hpp>

#include <bit>

namespace rrcb {

using detail::ByteColumn;
using detail::SumColumn;

namespace {

/// Returns all ranks that are near this one or to which this one is near, ascending. Collective.
std::vector<int> mutual(const std::vector<int>& near, Participant& self) {
    std::vector<RankCount> to;
    self.attempt([&] {
        for (const int rank : near) to.push_back({rank, 1});
    });
    std::vector<int> ranks;
    const std::vector<RankCount> from = exchange_counts(to, self);
    self.attempt([&] {
        ranks = near;
        for (const RankCount& one : from)
            if (!std::ranges::binary_search(near, one.rank)) ranks.push_back(one.rank);
        std::ranges::sort(ranks);
    });
    return ranks;
}

std::uint64_t bits_of(std::span<const Box> boxes, int dimension) {
    std::uint64_t hash = boxes.size() + (static_cast<std::uint64_t>(dimension) << 62);
    for (const Box& box : boxes)
        for (int a = 0; a < dimension; ++a)
            for (const double end : {box.lower[a], box.upper[a]})
                hash = detail::mix(hash ^ std::bit_cast<std::uint64_t>(end + 0.0));
    return hash;
}

Shared shared(const char* name, double value) {
    return {name, std::bit_cast<std::uint64_t>(value + 0.0)};
}

}  // namespace

Neighbours::Neighbours(const Cuts& cuts, MPI_Comm comm, const NeighbourOptions& options) {
    Participant self = mpi::enter(comm, CallName::neighbours);
    std::uint64_t bits = 0;
    self.attempt([&] {
        mpi::require_group(detail::StampAccess::ranks(cuts.stamp), "the balance of the cuts", self);
        state_ = std::make_unique<State>(options, cuts, options, mpi::rank_of(self.comm),
                                         mpi::size_of(self.comm));
        bits = bits_of(cuts);
    });
    detail::NeighbourAccess::open(*this, options, bits, "the tree of cuts", self);
}

Neighbours::Neighbours(std::span<const Box> boxes, int dimension, MPI_Comm comm,
                       const NeighbourOptions& options) {
    Participant self = mpi::enter(comm, CallName::neighbours);
    std::uint64_t bits = 0;
    self.attempt([&] {
        state_ = std::make_unique<State>(options, boxes, dimension, options,
                                         mpi::rank_of(self.comm), mpi::size_of(self.comm));
        bits = bits_of(boxes, dimension);
    });
    detail::NeighbourAccess::open(*this, options, bits, "the boxes", self);
}

void detail::NeighbourAccess::open(Neighbours& neighbours, const NeighbourOptions& options,
                                   std::uint64_t bits_of_parts, const char* name_of_parts,
                                   Participant& self) {
    const std::unique_ptr<Neighbours::State>& state = neighbours.state_;
    std::vector<int> near;
    std::uint64_t bits_of_ranks = 0;
    std::uint64_t bits_of_box = 0;
    self.attempt([&] {
        near = state->territory.near_ranks();
        if (options.ranks_of_parts) bits_of_ranks = hash_of(*options.ranks_of_parts);
        if (options.periodic) bits_of_box = state->territory.images()->hash();
    });
    std::vector<int> ranks = mutual(near, self);
    self.attempt([&] {
        state->open(std::move(ranks), self.log);
        StampAccess::ranks(state->ghosts.stamp) = self.group();
    });
    agree(self, {{name_of_parts, bits_of_parts},
                 shared("the cutoff", options.cutoff),
                 shared("travel", options.travel),
                 {"needs", static_cast<std::uint64_t>(options.needs)},
                 {"ranks_of_parts", bits_of_ranks},
                 {"the periodic box", bits_of_box}});
}

Neighbours::Neighbours(Neighbours&& other) noexcept = default;
Neighbours& Neighbours::operator=(Neighbours&& other) noexcept = default;
Neighbours::~Neighbours() = default;

Neighbours::State& Neighbours::State::of(const Neighbours& neighbours) {
    if (neighbours.state_ == nullptr)
        reject("these neighbours were moved from; use the object that they were moved to");
    return *neighbours.state_;
}

const GhostPlan& Neighbours::ghost_plan() const {
    return State::of(*this).ghosts;
}

std::span<const int> Neighbours::ranks() const {
    return State::of(*this).exchange->ranks();
}

void Neighbours::fail(const std::string& text) {
    NeighbourExchange& exchange = *State::of(*this).exchange;
    exchange.begin(CallName::fail_of_neighbours);
    exchange.end_with(failure_of(ErrorCode::internal, text));
}

LocalIndex Neighbours::migrate_columns(const Points& positions,
                                       std::span<const ByteColumn> columns) {
    const NonStop arithmetic;
    State& s = State::of(*this);
    NeighbourExchange& exchange = *s.exchange;
    exchange.begin(CallName::migrate);
    exchange.attempt([&] {
        exchange.set_types(columns);
        s.check_positions(positions);
        for (const ByteColumn& column : columns) check_column(column, positions.count, "points");
        check_results(columns);
        s.migration.find(positions, s.territory, exchange.ranks());
        for (std::size_t n = 0; n < exchange.ranks().size(); ++n) {
            const std::span<const LocalIndex> points = s.migration.leaving_to(n);
            pack(columns, points,
                 exchange.message_to(n, points.size(), message_bytes(columns, points.size())));
        }
    });
    exchange.run();
    exchange.attempt([&] {
        if (s.migration.apply(columns, positions.count, exchange) && s.stage != State::Stage::none)
            s.stage = State::Stage::moved;
    });
    exchange.end();
    return s.migration.num_arrived();
}

void Neighbours::find_ghosts_of(const Points& points,
                                const std::optional<std::span<const double>>& radii) {
    const NonStop arithmetic;
    State& s = State::of(*this);
    s.exchange->begin(CallName::find_ghosts);
    const Radii all{radii ? 0 : s.radius, radii, s.needs};
    s.exchange->attempt([&] {
        s.check_positions(points);
        s.check_radii(points, all);
    });
    s.find_ghosts(points, all);
}

void Neighbours::fetch_columns(std::span<const ByteColumn> columns) {
    State& s = State::of(*this);
    NeighbourExchange& exchange = *s.exchange;
    exchange.begin(CallName::fetch_of_neighbours, s.num_found);
    const bool has_shifts = s.territory.images() != nullptr && s.stage == State::Stage::found;
    const auto bytes_of = [&](std::size_t num_rows) {
        return message_bytes(columns, num_rows) +
               (has_shifts ? block_bytes(sizeof(Shift), num_rows) : 0);
    };
    exchange.attempt([&] {
        exchange.set_types(columns);
        s.require_ghosts(State::Stage::found);
        for (const ByteColumn& column : columns)
            check_column(column, s.ghosts.num_points, "points");
        check_results(columns);
        for (std::size_t n = 0; n < exchange.ranks().size(); ++n) {
            const std::span<const LocalIndex> points = s.sent_to(n);
            std::byte* const place = exchange.message_to(n, points.size(), bytes_of(points.size()));
            pack(columns, points, place);
            if (has_shifts)
                copy_bytes(reinterpret_cast<const std::byte*>(s.shifts.data() + s.send[n].first),
                           points.size() * sizeof(Shift),
                           place + message_bytes(columns, points.size()));
        }
    });
    exchange.run();
    exchange.end();
    exchange.attempt([&] {
        s.note_received([&](std::size_t n) {
            const std::size_t num_rows = exchange.rows_from(n);
            exchange.message_from(n, bytes_of(num_rows));
            return num_rows;
        });
        for (std::size_t k = 0; k < columns.size(); ++k) {
            const std::size_t bytes = row_bytes(columns[k]);
            std::byte* const rows =
                columns[k].resize(columns[k].result, s.num_ghosts * columns[k].components);
            s.for_each_source([&](std::size_t n, const State::Range& range) {
                std::byte* const to = rows + range.first * bytes;
                if (n == s.own()) return gather(columns[k].from, bytes, s.sent_to(n), to);
                copy_bytes(exchange.message_from(n, bytes_of(range.count)) +
                               message_bytes(columns.first(k), range.count),
                           range.count * bytes, to);
            });
        }
        if (has_shifts)
            s.take_shifts([&](std::size_t n, std::size_t num_rows) {
                return exchange.message_from(n, bytes_of(num_rows)) +
                       message_bytes(columns, num_rows);
            });
        s.stage = State::Stage::fetched;
    });
}

void Neighbours::accumulate_columns(std::span<const SumColumn> columns) {
    State& s = State::of(*this);
    NeighbourExchange& exchange = *s.exchange;
    exchange.begin(CallName::accumulate_of_neighbours, s.num_found);
    exchange.attempt([&] {
        s.require_ghosts(State::Stage::fetched);
        s.of_ghosts.clear();
        for (const SumColumn& column : columns) {
            require(
                type_of(column.ghosts) == type_of(column.points),
                "columns of ghosts must have the type and the components of those of the points");
            check_column(column.ghosts, s.num_ghosts, "ghosts");
            check_column(column.points, s.ghosts.num_points, "points");
            s.of_ghosts.push_back(column.ghosts);
        }
        exchange.set_types(s.of_ghosts);
        for (std::size_t n = 0; n < exchange.ranks().size(); ++n) {
            const State::Range& range = s.receive[n];
            std::byte* place =
                exchange.message_to(n, range.count, message_bytes(s.of_ghosts, range.count));
            for (const ByteColumn& column : s.of_ghosts) {
                const std::size_t bytes = row_bytes(column);
                copy_bytes(column.from + range.first * bytes, range.count * bytes, place);
                place += block_bytes(bytes, range.count);
            }
        }
    });
    exchange.run();
    exchange.end();
    exchange.attempt([&] {
        for (std::size_t n = 0; n < exchange.ranks().size(); ++n)
            exchange.message_from(n, message_bytes(s.of_ghosts, s.send[n].count));
        for (std::size_t k = 0; k < columns.size(); ++k) {
            const auto& [ghosts, points, add] = columns[k];
            std::byte* const sums = points.resize(points.result, points.num_values);
            s.for_each_source([&](std::size_t n, const State::Range& range) {
                const std::size_t num_rows = s.send[n].count;
                add(s.sent_to(n), points.components,
                    n == s.own() ? ghosts.from + range.first * row_bytes(ghosts)
                                 : exchange.message_from(n, message_bytes(s.of_ghosts, num_rows)) +
                                       message_bytes(std::span(s.of_ghosts).first(k), num_rows),
                    sums);
            });
        }
    });
}

void Neighbours::sum_columns(const SharedEntries& shared, std::span<const SumColumn> columns) {
    State& s = State::of(*this);
    NeighbourExchange& exchange = *s.exchange;
    exchange.begin(CallName::sum);
    exchange.attempt([&] {
        s.of_ghosts.clear();
        for (const SumColumn& column : columns) s.of_ghosts.push_back(column.points);
        exchange.set_types(s.of_ghosts);
        s.list_shared(shared, columns);
        for (std::size_t n = 0; n < exchange.ranks().size(); ++n) s.pack_shared(shared, n);
        s.clear_marks(shared);
    });
    exchange.run();
    exchange.end();
    exchange.attempt([&] { s.add_shared(shared, columns); });
}

}  // namespace rrcb
