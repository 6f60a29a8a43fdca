#pragma once

#include "collective/neighbour_exchange_mpi.hpp"
#include "lists/delivery_mpi.hpp"
#include "lists/migration.hpp"
#include "lists/radii.hpp"
#include "lists/rank_lists.hpp"
#include "lists/rows.hpp"
#include "lists/territory.hpp"

#include <rrcb/neighbours.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Access to neighbours for bindings, whose columns have no C++ types.
struct detail::NeighbourAccess {
    static void migrate(Neighbours& neighbours, const Points& positions,
                        std::span<const ByteColumn> columns) {
        neighbours.migrate_columns(positions, columns);
    }
    static void find_ghosts(Neighbours& neighbours, const Points& points,
                            const std::optional<std::span<const double>>& radii) {
        neighbours.find_ghosts_of(points, radii);
    }
    static void fetch(Neighbours& neighbours, std::span<const ByteColumn> columns) {
        neighbours.fetch_columns(columns);
    }
    static void accumulate(Neighbours& neighbours, std::span<const SumColumn> columns) {
        neighbours.accumulate_columns(columns);
    }
    static void sum(Neighbours& neighbours, const SharedEntries& shared,
                    std::span<const SumColumn> columns) {
        neighbours.sum_columns(shared, columns);
    }
    /// Finds the neighbours by the parts of the state, and opens the exchange. Collective.
    static void open(Neighbours& neighbours, const NeighbourOptions& options,
                     std::uint64_t bits_of_parts, const char* name_of_parts, Participant& self);
    /// Begins a call and fails at once, on this rank and on the neighbours. Throws Error.
    static void fail(Neighbours& neighbours, CallName call, const Failure& failure);
};

struct Neighbours::State {
    /// Points or ghosts of one rank in a list that is sorted by rank.
    struct Range {
        LocalIndex first = 0;
        LocalIndex count = 0;
    };

    /// Consecutive entries of the list of a pair of ranks, whose values a message contains.
    struct Run {
        std::uint64_t first;
        std::uint64_t count;
    };
    static_assert(sizeof(Run) == 16);

    /// Entries of this rank, and the row of a message from which their values follow.
    struct Segment {
        std::span<const LocalIndex> entries;
        LocalIndex row;
    };

    /// Values from a neighbour, and the segments for which they are.
    struct Received {
        const std::byte* values;
        std::size_t begin, end;
    };

    /// Marks of shared entries during a call.
    enum class Mark : std::uint8_t { none, zero, sent };

    /// Progress of the ghosts.
    enum class Stage : std::uint8_t { none, moved, found, fetched };

    /// Takes what a Territory takes: cuts or boxes, options, the rank and the number of ranks.
    template <class... Arguments>
    explicit State(const NeighbourOptions& options, Arguments&&... of_territory)
        : territory(std::forward<Arguments>(of_territory)...),
          radius(options.cutoff),
          needs(options.needs) {
        if (options.periodic) ghosts.periodic = *options.periodic;
        ghosts.cutoff = radius;
        ghosts.needs = needs;
    }

    /// Throws Error if the neighbours have been moved from.
    static State& of(const Neighbours& neighbours);

    /// Makes the exchange, and memory for one range of each neighbour.
    void open(std::vector<int> ranks, std::shared_ptr<CallLog> log);

    /// Returns the index that stands for this rank next to those of the neighbours.
    std::size_t own() const { return exchange->ranks().size(); }
    int rank_of(std::size_t n) const {
        return n == own() ? territory.rank() : exchange->ranks()[n];
    }

    /// Returns the points that a neighbour needs.
    std::span<const LocalIndex> sent_to(std::size_t n) const {
        return std::span(ghosts.send_indices).subspan(send[n].first, send[n].count);
    }

    /// Calls visit(n, range) with the range of ghosts from each neighbour and from this rank, in
    /// ascending order of ranks.
    template <class Visit>
    void for_each_source(Visit&& visit) const {
        for (const std::size_t n : by_rank) visit(n, receive[n]);
    }

    void check_positions(const Points& points) const;
    void check_radii(const Points& points, const Radii& radii) const;
    /// Throws Error unless the ghosts have reached this stage.
    void require_ghosts(Stage least) const;

    /// Lists the points that other ranks need.
    void find_ghosts(const Points& points, const Radii& radii);
    void exchange_reaches(const Points& points, const Radii& radii, PartReaches& reaches);
    void note_sent();

    /// Notes the number of ghosts from each neighbour; count(n) returns it.
    template <class Count>
    void note_received(Count&& count) {
        ghosts.receive.clear();
        num_ghosts = 0;
        for (const std::size_t n : by_rank) {
            receive[n] = {num_ghosts, n == own() ? send[n].count : count(n)};
            num_ghosts += receive[n].count;
            if (receive[n].count > 0) ghosts.receive.push_back({rank_of(n), receive[n].count});
        }
    }

    /// Notes the shifts of the ghosts; place(n, count) returns those from a neighbour.
    template <class Place>
    void take_shifts(Place&& place) {
        ghosts.shifts.resize(num_ghosts);
        for_each_source([&](std::size_t n, const Range& range) {
            if (n == own())
                std::copy_n(shifts.begin() + static_cast<std::ptrdiff_t>(send[n].first),
                            range.count,
                            ghosts.shifts.begin() + static_cast<std::ptrdiff_t>(range.first));
            else
                copy_bytes(place(n, range.count), range.count * sizeof(Shift),
                           reinterpret_cast<std::byte*>(ghosts.shifts.data() + range.first));
        });
    }

    // The steps of sum(), in their order.
    void list_shared(const SharedEntries& shared, std::span<const detail::SumColumn> columns);
    std::span<const LocalIndex> shared_with(const SharedEntries& shared, std::size_t n) const {
        return std::span(shared.indices).subspan(common[n].first, common[n].count);
    }
    void pack_shared(const SharedEntries& shared, std::size_t n);
    void clear_marks(const SharedEntries& shared);
    void find_segments(const SharedEntries& shared, std::size_t n);
    void add_shared(const SharedEntries& shared, std::span<const detail::SumColumn> columns);

    Territory territory;
    double radius;
    Needs needs;
    std::unique_ptr<NeighbourExchange> exchange{};
    std::vector<std::size_t> by_rank{};  ///< indices of the neighbours and of this rank, in
                                         ///< ascending order of ranks

    Migration migration{};

    GhostPlan ghosts{};
    Stage stage = Stage::none;
    std::uint64_t num_found = 0;  ///< number of times that ghosts were found
    std::vector<Shift> shifts{};  ///< of ghosts.send_indices, in a periodic box
    LocalIndex num_ghosts = 0;    ///< of the latest fetch()
    std::vector<Range> send{};    ///< ranges of ghosts.send_indices for each neighbour and for this
                                  ///< rank
    std::vector<Range> receive{};  ///< ranges of the ghosts from each neighbour and from this rank
    std::optional<NearBoxes> near{};  ///< regions near points whose own radius counts
    std::optional<QuietBoxes> quiet{};
    std::optional<RankLists> lists{};

    std::vector<Range> common{};        ///< entries shared with each neighbour
    std::vector<LocalIndex> entries{};  ///< each shared entry that is not 0 here, once
    std::vector<Mark> marks{};          ///< for all entries; none between calls
    std::vector<Run> runs{};            ///< of a message, after one with their number
    std::vector<LocalIndex> sent_entries{};
    std::vector<Segment> segments{};
    std::vector<Received> received{};     ///< from each neighbour
    std::vector<std::byte> own_values{};  ///< this rank's values of the shared entries

    std::vector<detail::ByteColumn> of_ghosts{};
};

}  // namespace rrcb
