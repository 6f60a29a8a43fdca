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
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace rrcb {

namespace {

/// More rounds place hardly any part; the parts left then take unused numbers.
constexpr int most_rounds = 16;

void pass(Butterfly& butterfly, Butterfly::Direction direction, bool flag, RemapBuffers& buffers,
          Participant& self) {
    const Flags flags{0, flag ? 1.0 : 0.0};
    // A single rank needs no messages.
    if (butterfly.num_ranks() == 1) return butterfly.start(flags);
    buffers.messages.run(butterfly, direction, flags, self);
}

std::vector<Overlap> count_overlaps(std::span<const Part> parts, const PreviousParts& previous,
                                    const NumberRule& rule, int rank) {
    const Origins origins(previous, rule, rank);
    const auto origin_in_group = [&](std::int32_t origin, Part part) {
        return rule.is_in_group(part, origin) ? origin : no_origin;
    };
    std::vector<Overlap> overlaps;
    // A table if it is no longer than the list of points: a map would take most of the call.
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

/// Limits the search to overlaps with their present number and the largest others: 16 for each
/// part per rank plus 65,536 on all ranks. The others lose their origin.
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

/// Sends the overlaps to the searching ranks of their parts.
void hand_in(std::span<const Part> parts, const PreviousParts& previous, RemapBuffers& buffers,
             Participant& self) {
    auto& search = buffers.search;
    self.attempt([&] {
        std::vector<Overlap> overlaps =
            count_overlaps(parts, previous, search.rule(), mpi::rank_of(self.comm));
        // Searching ranks ask for the numbers of their parts, unless they get all.
        if (buffers.numbers.empty())
            for (Part part = search.parts().first; part < search.parts().end; ++part)
                overlaps.push_back({no_origin, part, 0});
        limit_overlaps(search.rule(), overlaps);
        search.hand_in(overlaps, buffers.told);
    });
    pass(buffers.told, Butterfly::to_owners, false, buffers, self);
    self.attempt([&] { search.start(buffers.told.owned()); });
}

/// Makes offers until none is refused. Returns false if none would change a number.
bool exchange_offers(RemapBuffers& buffers, Participant& self) {
    auto& offers = buffers.offers;
    for (int round = 0; round < most_rounds; ++round) {
        bool moves = false;
        bool refuses = false;
        self.attempt([&] {
            offers.clear();
            moves = buffers.search.offer(offers);
        });
        pass(offers, Butterfly::to_owners, moves, buffers, self);
        if (round == 0 && offers.flags()[1] == 0) return false;
        self.attempt([&] { refuses = buffers.search.choose(offers); });
        pass(offers, Butterfly::back, refuses, buffers, self);
        self.attempt([&] { buffers.search.follow(offers); });
        if (offers.flags()[1] == 0) break;
    }
    return true;
}

/// Gives unused numbers to the parts without one.
void join_what_is_left(RemapBuffers& buffers, Participant& self) {
    Butterfly& left = buffers.offers;
    const NumberSearch::Counts here = buffers.search.left();
    NumberSearch::Counts before{};
    if (buffers.search.rule().is_spread) {
        mpi::check(MPI_Exscan(here.data(), before.data(), 2, MPI_INT64_T, MPI_SUM, self.comm),
                   "MPI_Exscan");
        if (mpi::rank_of(self.comm) == 0) before = {};
    }
    self.attempt([&] {
        left.clear();
        buffers.search.meet(before, left);
    });
    pass(left, Butterfly::to_owners, here[0] > 0, buffers, self);
    if (left.flags()[1] == 0) return;
    self.attempt([&] {
        left.owned().for_each([&](const Record& met) { left.answer(met.key, met.payload); });
    });
    pass(left, Butterfly::back, false, buffers, self);
    self.attempt([&] { buffers.search.take(before, left); });
}

Remap make_summary(std::span<const GlobalCount, 3> sums) {
    Remap summary;
    summary.num_points = sums[0];
    summary.kept_before = sums[1];
    summary.kept_after = std::max(sums[1], sums[2]);
    summary.identity = summary.kept_after == summary.kept_before;
    return summary;
}

/// Broadcasts the numbers found by rank 0, or a failure known to it. Collective.
NewNumbers share_decision(RemapBuffers& buffers, Participant& self) {
    auto& [search, told, offers, messages, numbers, decision] = buffers;
    if (mpi::rank_of(self.comm) == root) {
        const auto sums = search.count_points();
        if (sums[2] <= sums[1]) search.reset();
        std::ranges::copy(search.numbers(), decision.begin());
        std::ranges::copy(sums, decision.end() - 4);
        decision.back() = self.failing_rank();
    }
    mpi::broadcast(std::as_writable_bytes(std::span(decision)), root, self.comm);
    fail_together(static_cast<int>(decision.back()), self);
    std::ranges::transform(decision.begin(), decision.end() - 4, numbers.begin(),
                           [](GlobalCount number) { return static_cast<Part>(number); });
    NewNumbers result{make_summary(std::span(decision).last<4>().first<3>())};
    result.remap.numbers = std::move(numbers);
    return result;
}

/// Sends the numbers found by all ranks to all, or to the ranks with points of the parts.
/// Collective: one reduction, and another or a pass if any number changes.
NewNumbers return_numbers(RemapBuffers& buffers, Participant& self) {
    auto& search = buffers.search;
    auto& told = buffers.told;
    auto& numbers = buffers.numbers;
    auto sums = search.count_points();
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, sums.data(), 3, MPI_INT64_T, MPI_SUM, self.comm),
               "MPI_Allreduce");
    NewNumbers result{make_summary(sums)};
    if (!numbers.empty()) {
        if (result.remap.identity) search.reset();
        std::ranges::copy(search.numbers(), numbers.begin() + search.parts().first);
        mpi::check(MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()),
                                 MPI_INT, MPI_SUM, self.comm),
                   "MPI_Allreduce");
        result.remap.numbers = std::move(numbers);
    } else if (!result.remap.identity) {
        self.attempt([&] {
            told.owned().for_each([&, index = std::size_t{0}](const Record& record) mutable {
                // The searching rank of a part asks for it, so all parts have records.
                told.answer(record.key, std::array{static_cast<double>(search.numbers()[index++])});
            });
        });
        pass(told, Butterfly::back, false, buffers, self);
        self.attempt([&] {
            told.answers().for_each([&](const Record& answer) {
                result.parts.push_back(static_cast<Part>(answer.key));
                result.remap.numbers.push_back(static_cast<Part>(answer.payload[0]));
            });
        });
    }
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

RemapBuffers::RemapBuffers(const NumberRule& rule, int rank, bool wants_all)
    : search(rule, rank),
      told(rank, rule.num_ranks, NumberSearch::add_up,
           rule.is_spread ? Butterfly::Way::spread : Butterfly::Way::central),
      offers(rule.is_spread ? rank : root, rule.is_spread ? rule.num_ranks : 1,
             NumberSearch::append),
      numbers(wants_all || !rule.is_spread ? static_cast<std::size_t>(rule.num_parts) : 0),
      decision(rule.is_spread ? 0 : static_cast<std::size_t>(rule.num_parts) + 4) {}

NewNumbers find_numbers(std::span<const Part> parts, const PreviousParts& previous,
                        RemapBuffers& buffers, Participant& self) {
    const bool is_spread = buffers.search.rule().is_spread;
    hand_in(parts, previous, buffers, self);
    const bool searches = is_spread || mpi::rank_of(self.comm) == root;
    if (searches && exchange_offers(buffers, self)) join_what_is_left(buffers, self);
    return is_spread ? return_numbers(buffers, self) : share_decision(buffers, self);
}

Remap remap(std::span<const Part> parts, const PreviousParts& previous,
            std::span<const RankRange> ranks_of_parts, const TreeShape& shape, Participant& self,
            int central_parts) {
    const int num_ranks = mpi::size_of(self.comm);
    const bool is_spread =
        std::min<std::ptrdiff_t>(std::ssize(ranks_of_parts), num_ranks) > central_parts;
    std::optional<GroupBuffers> buffers;
    self.attempt([&] {
        check_lists(parts, previous, ranks_of_parts, num_ranks);
        const auto num_parts = static_cast<int>(ranks_of_parts.size());
        require(shape.group_size >= 1 && shape.number_fits(num_parts),
                "shape.group_size must be at least 1, and shape.dealt fit the parts");
        buffers.emplace(
            NumberRule{num_parts, num_ranks, !previous, is_spread, ranks_of_parts, shape},
            mpi::rank_of(self.comm));
    });
    std::array shared{
        Shared{"whether previous is given", previous ? 1u : 0u, !parts.empty(),
               "give the earlier part of each point on every rank that has points, or on none"},
        Shared{"ranks_of_parts", hash_of(ranks_of_parts)},
        Shared{"shape.group_size", static_cast<std::uint64_t>(shape.group_size)},
        Shared{"shape.dealt", static_cast<std::uint64_t>(shape.dealt)}};
    agree(self, shared);
    // A rank without points may lack `previous`, but must search by the same rule.
    self.attempt([&] {
        NumberSearch& search = buffers->parts.search;
        NumberRule rule = search.rule();
        rule.by_rank = shared[0].value == 0;
        if (rule.by_rank == !previous) return;
        search = NumberSearch(rule, mpi::rank_of(self.comm));
    });
    Remap result = find_numbers(parts, previous, *buffers, self).remap;
    if (is_spread) agree(self);
    return result;
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
