#include "lists/remap_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "lists/group_numbers_mpi.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <rrcb/detail/mix.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace rrcb {

namespace {

/// Merges two lists that ascend by origin, and adds up the counts of equal origins.
void join_overlaps(std::span<const double> a, std::span<const double> b,
                   std::vector<double>& joined) {
    while (!a.empty() || !b.empty()) {
        const bool takes_a = !a.empty() && (b.empty() || a[0] <= b[0]);
        const bool takes_b = !b.empty() && (a.empty() || b[0] <= a[0]);
        joined.push_back(takes_a ? a[0] : b[0]);
        joined.push_back((takes_a ? a[1] : 0) + (takes_b ? b[1] : 0));
        if (takes_a) a = a.subspan(2);
        if (takes_b) b = b.subspan(2);
    }
}

std::vector<Overlap> count_overlaps(std::span<const Part> parts, const PreviousParts& previous,
                                    const NumberRule& rule, int rank) {
    const Origins origins(previous, rule, rank);
    const auto origin_in_group = [&](std::int32_t origin, Part part) {
        return rule.is_in_group(part, origin) ? origin : no_origin;
    };
    std::vector<Overlap> overlaps;
    // Uses a table if it is no longer than the list of points. A map would take most of the call's
    // time.
    if (rule.by_rank && rule.num_parts <= std::ssize(parts)) {
        std::vector<GlobalCount> of_parts(rule.num_parts);
        for (const Part part : parts) ++of_parts[part];
        for (Part part = 0; part < rule.num_parts; ++part)
            if (of_parts[part] > 0)
                overlaps.push_back({origin_in_group(origins.own(), part), part, of_parts[part]});
        return overlaps;
    }
    std::unordered_map<Key, GlobalCount> counts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::int32_t origin = origin_in_group(origins.of(i), parts[i]);
        ++counts[(static_cast<Key>(parts[i]) << 32) | static_cast<std::uint32_t>(origin)];
    }
    for (const auto& [pair, count] : counts)
        overlaps.push_back({static_cast<std::int32_t>(pair), static_cast<Part>(pair >> 32), count});
    return overlaps;
}

/// Limits the overlaps of this rank to 16 for each part that a rank has, plus its share of 65,536.
/// Overlaps that keep their present number come first, then the largest others. The overlaps beyond
/// the limit get no_origin, so that they do not influence the new numbers.
void limit_overlaps(const NumberRule& rule, std::vector<Overlap>& overlaps) {
    const auto parts_per_rank = static_cast<std::size_t>((rule.num_parts - 1) / rule.num_ranks + 1);
    const std::size_t limit =
        16 * parts_per_rank + 65536 / static_cast<std::size_t>(rule.num_ranks);
    if (overlaps.size() > limit) {
        std::ranges::nth_element(overlaps, overlaps.begin() + limit, {}, [&](const Overlap& o) {
            return std::tuple(o.origin == no_origin, rule.home_of(o.part) != o.origin, -o.count,
                              o.part, o.origin);
        });
        for (std::size_t k = limit; k < overlaps.size(); ++k) overlaps[k].origin = no_origin;
    }
    std::ranges::sort(overlaps, {}, [](const Overlap& o) { return std::tuple(o.part, o.origin); });
}

/// Adds a record for each part with points.
void add_records(std::span<const Overlap> overlaps, Butterfly& told) {
    std::vector<double> payload;
    for (std::size_t k = 0; k < overlaps.size(); ++k) {
        const auto& [origin, part, count] = overlaps[k];
        payload.insert(payload.end(), {static_cast<double>(origin), static_cast<double>(count)});
        if (k + 1 < overlaps.size() && overlaps[k + 1].part == part) continue;
        told.add(static_cast<Key>(part), root, payload);
        payload.clear();
    }
}

/// Sends the overlaps to rank 0. Collective.
void hand_in(std::span<const Part> parts, const PreviousParts& previous, RemapBuffers& buffers,
             Participant& self) {
    self.attempt([&] {
        std::vector<Overlap> overlaps =
            count_overlaps(parts, previous, buffers.rule, mpi::rank_of(self.comm));
        limit_overlaps(buffers.rule, overlaps);
        add_records(overlaps, buffers.told);
    });
    // A single rank needs no messages.
    if (buffers.rule.num_ranks > 1)
        buffers.messages.run(buffers.told, Butterfly::to_owners, {}, self);
}

/// On rank 0, decides the new numbers. Writes them, and three counts: all points, points kept by
/// the old numbers, points kept by the new ones.
void decide(const NumberRule& rule, const Records& told, std::span<GlobalCount> decision) {
    std::vector<Overlap> overlaps;
    told.for_each([&](const Record& record) {
        for (std::size_t k = 0; k < record.payload.size(); k += 2)
            overlaps.push_back({static_cast<std::int32_t>(record.payload[k]),
                                static_cast<Part>(record.key),
                                static_cast<GlobalCount>(record.payload[k + 1])});
    });
    std::vector<Part> numbers = greedy_numbers(rule, overlaps);
    std::array<GlobalCount, 3> sums{};
    for (const auto& [origin, part, count] : overlaps) {
        sums[0] += count;
        if (origin == rule.home_of(part)) sums[1] += count;
        if (origin == rule.home_of(numbers[part])) sums[2] += count;
    }
    if (sums[2] <= sums[1]) std::iota(numbers.begin(), numbers.end(), Part{0});
    std::ranges::copy(numbers, decision.begin());
    std::ranges::copy(sums, decision.begin() + rule.num_parts);
}

Remap make_summary(std::span<const GlobalCount, 3> sums) {
    Remap summary;
    summary.num_points = sums[0];
    summary.kept_before = sums[1];
    summary.kept_after = std::max(sums[1], sums[2]);
    summary.identity = summary.kept_after == summary.kept_before;
    return summary;
}

/// Returns the result for more parts than are renumbered: `numbers` are the old ones. Collective:
/// one reduction.
Remap unchanged(std::span<const Part> parts, const PreviousParts& previous, const NumberRule& rule,
                std::vector<Part>&& numbers, Participant& self) {
    std::array<GlobalCount, 3> sums{
        std::ssize(parts), num_kept(parts, {}, previous, rule, mpi::rank_of(self.comm)), 0};
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_INT64_T, MPI_SUM, self.comm),
               "MPI_Allreduce");
    Remap result = make_summary(sums);
    result.numbers = std::move(numbers);
    return result;
}

void check_lists(std::span<const Part> parts, const PreviousParts& previous,
                 std::span<const RankRange> ranks_of_parts, int num_ranks) {
    require(!ranks_of_parts.empty(), "ranks_of_parts is empty; give one entry per part");
    check_ranks(ranks_of_parts, num_ranks);
    require(std::ranges::is_sorted(ranks_of_parts, {}, &RankRange::first_rank),
            "ranks_of_parts must ascend");
    if (previous && previous->size() != parts.size())
        reject("previous has " + std::to_string(previous->size()) + " entries, parts has " +
               std::to_string(parts.size()) + "; give one of each per point");
    check_parts(parts, static_cast<int>(ranks_of_parts.size()));
}

}  // namespace

std::uint64_t hash_of(std::span<const RankRange> ranks_of_parts) {
    std::uint64_t hash = ranks_of_parts.size();
    for (const RankRange& ranks : ranks_of_parts)
        for (const int number : {ranks.first_rank, ranks.count})
            hash = detail::mix(hash ^ static_cast<std::uint64_t>(number));
    return hash;
}

GlobalCount num_kept(std::span<const Part> parts, std::span<const Part> numbers,
                     const PreviousParts& previous, const NumberRule& rule, int rank) {
    const Origins origins(previous, rule, rank);
    GlobalCount kept = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::int32_t origin = origins.of(i);
        const Part number = numbers.empty() ? parts[i] : numbers[parts[i]];
        if (origin != no_origin && rule.home_of(number) == origin) ++kept;
    }
    return kept;
}

RemapBuffers::RemapBuffers(const NumberRule& given, int rank)
    : rule(given),
      told(rank, rule.num_ranks, join_overlaps, Butterfly::Way::central),
      numbers(static_cast<std::size_t>(rule.num_parts)),
      decision(static_cast<std::size_t>(rule.num_parts) + 4) {}

Remap find_numbers(std::span<const Part> parts, const PreviousParts& previous,
                   RemapBuffers& buffers, Participant& self) {
    std::vector<GlobalCount>& decision = buffers.decision;
    hand_in(parts, previous, buffers, self);
    if (mpi::rank_of(self.comm) == root) {
        self.attempt([&] { decide(buffers.rule, buffers.told.owned(), decision); });
        decision.back() = self.failing_rank();
    }
    mpi::broadcast(std::as_writable_bytes(std::span(decision)), root, self.comm);
    fail_together(static_cast<int>(decision.back()), self);
    std::ranges::transform(decision.begin(), decision.end() - 4, buffers.numbers.begin(),
                           [](GlobalCount number) { return static_cast<Part>(number); });
    Remap result = make_summary(std::span(decision).last<4>().first<3>());
    result.numbers = std::move(buffers.numbers);
    return result;
}

Remap remap(std::span<const Part> parts, const PreviousParts& previous,
            std::span<const RankRange> ranks_of_parts, const TreeShape& shape, Participant& self) {
    const int rank = mpi::rank_of(self.comm);
    const int num_ranks = mpi::size_of(self.comm);
    const auto num_parts = static_cast<int>(ranks_of_parts.size());
    NumberRule rule{num_parts, num_ranks, !previous, ranks_of_parts, shape};
    std::optional<GroupBuffers> buffers;
    std::vector<Part> same;
    self.attempt([&] {
        check_lists(parts, previous, ranks_of_parts, num_ranks);
        require(shape.group_size >= 1 && shape.number_fits(num_parts),
                "shape.group_size must be at least 1, and shape.round_robin_block fit the parts");
        if (num_parts > most_renumbered) {
            same.resize(ranks_of_parts.size());
            std::iota(same.begin(), same.end(), Part{0});
        } else {
            buffers.emplace(rule, rank);
        }
    });
    std::array shared{
        Shared{"whether previous is given", previous ? 1u : 0u, !parts.empty(),
               "give the earlier part of each point on every rank that has points, or on none"},
        Shared{"ranks_of_parts", hash_of(ranks_of_parts)},
        Shared{"shape.group_size", static_cast<std::uint64_t>(shape.group_size)},
        Shared{"shape.round_robin_block", static_cast<std::uint64_t>(shape.round_robin_block)}};
    agree(self, shared);
    // A rank without points may come without `previous`, but must use the same rule as the others.
    rule.by_rank = shared[0].value == 0;
    if (!buffers) return unchanged(parts, previous, rule, std::move(same), self);
    buffers->parts.rule.by_rank = rule.by_rank;
    return find_numbers(parts, previous, *buffers, self);
}

namespace {

Remap remap_over(MPI_Comm user, std::span<const Part> parts, const PreviousParts& previous,
                 std::span<const RankRange> ranks_of_parts, const TreeShape& shape) {
    Participant self = mpi::enter(user, CallName::remap);
    Remap result = remap(parts, previous, ranks_of_parts, shape, self);
    self.throw_failed_message();
    return result;
}

}  // namespace

Remap remap(std::span<const Part> parts, std::span<const RankRange> ranks_of_parts, MPI_Comm user,
            const TreeShape& shape) {
    return remap_over(user, parts, std::nullopt, ranks_of_parts, shape);
}

Remap remap(std::span<const Part> parts, std::span<const Part> previous,
            std::span<const RankRange> ranks_of_parts, MPI_Comm user, const TreeShape& shape) {
    return remap_over(user, parts, PreviousParts(previous), ranks_of_parts, shape);
}

}  // namespace rrcb
