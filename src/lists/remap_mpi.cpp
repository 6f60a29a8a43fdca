#include "lists/remap_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "options/rejection.hpp"

#include <rrcb/options.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace rrcb {

namespace {

/// More rounds place hardly any part: what is left by then takes unused numbers.
constexpr int most_rounds = 16;

/// Key of the number of points in the message to rank 0.
Key key_of_points(const NumberRule& rule) {
    return static_cast<Key>(rule.num_parts);
}

/// Parameters of all steps.
struct Steps {
    RemapBuffers& buffers;
    Participant& self;

    const NumberRule& rule() const { return buffers.search.rule(); }

    void pass(Butterfly& butterfly, Butterfly::Direction direction, const Flags& flags = {}) {
        if (butterfly.num_ranks() == 1) return butterfly.start(flags);
        buffers.messages.run(butterfly, direction, flags, self);
    }
};

/// Counts the points of each part and origin. The origin is -1 if no part can keep the points.
std::vector<Overlap> count_overlaps(std::span<const Part> parts, const PreviousParts& previous,
                                    const NumberRule& rule, int rank) {
    const auto [first, end] = rule.numbers_of(rank);
    const std::int32_t own = rule.by_rank && first < end ? rank : -1;
    std::unordered_map<Key, GlobalCount> counts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const bool is_kept = !rule.by_rank && previous && (*previous)[i] < rule.num_parts;
        const std::int32_t origin = is_kept ? (*previous)[i] : own;
        ++counts[(static_cast<Key>(parts[i]) << 32) | static_cast<std::uint32_t>(origin)];
    }
    std::vector<Overlap> overlaps;
    for (const auto& [pair, count] : counts)
        overlaps.push_back({static_cast<std::int32_t>(pair), static_cast<Part>(pair >> 32), count});
    return overlaps;
}

/// Leaves the largest overlaps their counts, and all that keep their number among the first.
void limit_overlaps(const NumberRule& rule, std::vector<Overlap>& overlaps) {
    std::ranges::sort(overlaps, {}, [&](const Overlap& overlap) {
        return std::tuple(overlap.origin < 0, rule.home_of(overlap.part) != overlap.origin,
                          -overlap.count, overlap.part, overlap.origin);
    });
    for (std::size_t k = 0; k < overlaps.size(); ++k)
        if (k >= rule.most_overlaps() || overlaps[k].origin < 0) overlaps[k].count = 0;
    std::ranges::sort(overlaps, {}, [](const Overlap& o) { return std::tuple(o.part, o.origin); });
}

/// Brings the overlaps to the ranks that search for their parts. Collective: one pass.
void hand_in(std::span<const Part> parts, const PreviousParts& previous, Steps& steps) {
    Butterfly& told = steps.buffers.told;
    steps.self.attempt([&] {
        std::vector<Overlap> overlaps =
            count_overlaps(parts, previous, steps.rule(), mpi::rank_of(steps.self.comm));
        const PartRange own = steps.buffers.search.parts();
        // A rank needs the numbers of all parts that it searched for.
        for (Part part = own.first; steps.rule().is_spread && part < own.end; ++part)
            overlaps.push_back({-1, part, 0});
        limit_overlaps(steps.rule(), overlaps);
        steps.buffers.search.hand_in(overlaps, told);
        const std::array points{0.0, static_cast<double>(parts.size())};
        if (!steps.rule().is_spread) told.add(key_of_points(steps.rule()), root, points);
    });
    steps.pass(told, Butterfly::to_owners);
    steps.self.attempt([&] { steps.buffers.search.start(told.owned()); });
}

/// Makes offers until all are accepted. Returns false if none would change a number.
bool exchange_offers(Steps& steps) {
    auto& [search, told, offers, left, messages, decision, numbers] = steps.buffers;
    for (int round = 0; round < most_rounds; ++round) {
        bool moves = false;
        bool refuses = false;
        steps.self.attempt([&] {
            offers.clear();
            moves = search.offer(offers);
        });
        steps.pass(offers, Butterfly::to_owners, {0, moves ? 1.0 : 0.0});
        if (round == 0 && offers.flags()[1] == 0) return false;
        steps.self.attempt([&] { refuses = search.choose(offers); });
        steps.pass(offers, Butterfly::back, {0, refuses ? 1.0 : 0.0});
        steps.self.attempt([&] { search.follow(offers); });
        if (offers.flags()[1] == 0) break;
    }
    return true;
}

/// Gives unused numbers to the parts without one.
void join_what_is_left(Steps& steps) {
    auto& [search, told, offers, left, messages, decision, numbers] = steps.buffers;
    NumberSearch::Counts before;
    const NumberSearch::Counts here = search.left();
    if (steps.rule().is_spread) {
        std::array counts{here.parts, here.numbers};
        mpi::check(
            MPI_Exscan(MPI_IN_PLACE, counts.data(), 2, MPI_INT64_T, MPI_SUM, steps.self.comm),
            "MPI_Exscan");
        if (mpi::rank_of(steps.self.comm) > 0) before = {counts[0], counts[1]};
    }
    steps.self.attempt([&] { search.meet(before, left); });
    steps.pass(left, Butterfly::to_owners, {0, here.parts > 0 ? 1.0 : 0.0});
    if (left.flags()[1] == 0) return;
    steps.self.attempt([&] { answer_all(left); });
    steps.pass(left, Butterfly::back);
    steps.self.attempt([&] { search.take(before, left); });
}

GlobalCount num_points_of(const Butterfly& told, const NumberRule& rule) {
    GlobalCount num_points = 0;
    told.owned().for_each([&](const Record& record) {
        if (record.key == key_of_points(rule))
            num_points = static_cast<GlobalCount>(record.payload[1]);
    });
    return num_points;
}

Remap make_summary(std::span<const GlobalCount, 3> sums) {
    Remap summary;
    summary.num_points = sums[0];
    summary.kept_before = sums[1];
    summary.kept_after = std::max(sums[1], sums[2]);
    summary.identity = summary.kept_after == summary.kept_before;
    return summary;
}

/// Shares the numbers that rank 0 found, or its failure. Collective: one broadcast.
NewNumbers share_decision(Steps& steps) {
    auto& [search, told, offers, left, messages, decision, numbers] = steps.buffers;
    const std::span<GlobalCount, 4> head = std::span(decision).first<4>();
    if (mpi::rank_of(steps.self.comm) == root) {
        const auto [before, after] = search.kept();
        if (after <= before) search.reset();
        std::ranges::copy(std::array{GlobalCount{steps.self.failing_rank()},
                                     num_points_of(told, steps.rule()), before, after},
                          head.begin());
        std::ranges::copy(search.numbers(), decision.begin() + head.size());
    }
    mpi::broadcast(std::as_writable_bytes(std::span(decision)), root, steps.self.comm);
    fail_together(static_cast<int>(head[0]), steps.self);
    NewNumbers result{make_summary(head.last<3>())};
    for (std::size_t k = 0; k < numbers.size(); ++k)
        numbers[k] = static_cast<Part>(decision[head.size() + k]);
    result.remap.numbers = std::move(numbers);
    return result;
}

/// Returns the numbers to the ranks that have points of the parts. Collective: one reduction, and
/// one pass if any number changes.
NewNumbers return_numbers(std::size_t num_points, Steps& steps) {
    auto& [search, told, offers, left, messages, decision, numbers] = steps.buffers;
    const auto [before, after] = search.kept();
    std::array<GlobalCount, 3> sums{static_cast<GlobalCount>(num_points), before, after};
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, sums.data(), 3, MPI_INT64_T, MPI_SUM, steps.self.comm),
               "MPI_Allreduce");
    NewNumbers result{make_summary(sums)};
    if (result.remap.identity) return result;
    steps.self.attempt([&] {
        told.owned().for_each([&](const Record& record) {
            const auto index = static_cast<std::size_t>(record.key) -
                               static_cast<std::size_t>(search.parts().first);
            told.answer(record.key, std::array{static_cast<double>(search.numbers()[index])});
        });
    });
    steps.pass(told, Butterfly::back);
    steps.self.attempt([&] {
        told.answers().for_each([&](const Record& answer) {
            result.parts.push_back(static_cast<Part>(answer.key));
            result.remap.numbers.push_back(static_cast<Part>(answer.payload[0]));
        });
    });
    return result;
}

}  // namespace

std::uint64_t hash_of(std::span<const RankRange> ranks_of_parts) {
    std::uint64_t hash = ranks_of_parts.size();
    for (const RankRange& ranks : ranks_of_parts) {
        for (const int number : {ranks.first_rank, ranks.count})
            hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

RemapBuffers::RemapBuffers(const NumberRule& rule, int rank)
    : search(rule, rank),
      told(rank, rule.num_ranks, NumberSearch::add_up,
           rule.is_spread ? Butterfly::Way::spread : Butterfly::Way::central),
      offers(rank, rule.num_ranks, NumberSearch::append),
      left(rank, rule.num_ranks, NumberSearch::keep_larger) {
    if (rule.is_spread) return;
    // Rank 0 asks itself only.
    offers = Butterfly(root, 1, NumberSearch::append);
    left = Butterfly(root, 1, NumberSearch::keep_larger);
    numbers.resize(static_cast<std::size_t>(rule.num_parts));
    decision.resize(4 + numbers.size());
}

NewNumbers find_numbers(std::span<const Part> parts, const PreviousParts& previous,
                        RemapBuffers& buffers, Participant& self) {
    Steps steps{buffers, self};
    const bool is_spread = steps.rule().is_spread;
    hand_in(parts, previous, steps);
    if ((is_spread || mpi::rank_of(self.comm) == root) && exchange_offers(steps))
        join_what_is_left(steps);
    return is_spread ? return_numbers(parts.size(), steps) : share_decision(steps);
}

namespace {

void check_ranks(std::span<const RankRange> ranks_of_parts, int num_ranks) {
    require(!ranks_of_parts.empty(), "ranks_of_parts is empty; give one entry per part");
    require(std::ranges::all_of(ranks_of_parts,
                                [&](const RankRange& ranks) {
                                    return ranks.first_rank >= 0 && ranks.count >= 1 &&
                                           ranks.count <= num_ranks - ranks.first_rank;
                                }),
            "ranks_of_parts must name ranks of this communicator");
    require(std::ranges::is_sorted(ranks_of_parts, {}, &RankRange::first_rank),
            "ranks_of_parts must ascend");
}

void check_arguments(std::span<const Part> parts, const PreviousParts& previous,
                     std::size_t num_parts) {
    if (previous && previous->size() != parts.size())
        reject("previous has " + std::to_string(previous->size()) + " entries, parts has " +
               std::to_string(parts.size()) + "; give one of each per point");
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (parts[i] < 0 || static_cast<std::size_t>(parts[i]) >= num_parts)
            reject("part " + std::to_string(parts[i]) + " of point " + std::to_string(i) +
                   " is none of the " + std::to_string(num_parts) + " parts");
}

/// Gives every rank the numbers of all parts, of which each has those that it searched for.
/// Collective: one reduction, and one more if any number changes.
void complete(const NumberSearch& search, std::vector<Part>&& numbers, Remap& remap,
              Participant& self) {
    if (remap.identity) {
        std::iota(numbers.begin(), numbers.end(), 0);
    } else {
        std::ranges::copy(search.numbers(), numbers.begin() + search.parts().first);
    }
    agree(self);
    if (!remap.identity)
        mpi::check(MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()),
                                 MPI_INT, MPI_SUM, self.comm),
                   "MPI_Allreduce");
    remap.numbers = std::move(numbers);
}

/// Whether all ranks search, which they do where many ranks make the parts.
bool is_spread(std::size_t num_parts, MPI_Comm comm) {
    const auto many = static_cast<std::size_t>(Tuning{}.central_parts);
    return num_parts > many && static_cast<std::size_t>(mpi::size_of(comm)) > many;
}

}  // namespace

Remap remap(std::span<const Part> parts, const PreviousParts& previous,
            std::span<const RankRange> ranks_of_parts, bool is_spread, Participant& self) {
    const int num_ranks = mpi::size_of(self.comm);
    std::optional<RemapBuffers> buffers;
    std::vector<Part> numbers;
    self.attempt([&] {
        check_ranks(ranks_of_parts, num_ranks);
        check_arguments(parts, previous, ranks_of_parts.size());
        const auto num_parts = static_cast<int>(ranks_of_parts.size());
        buffers.emplace(NumberRule{num_parts, num_ranks, !previous, is_spread, ranks_of_parts},
                        mpi::rank_of(self.comm));
        if (is_spread) numbers.resize(ranks_of_parts.size());
    });
    agree(self, {{"ranks_of_parts", hash_of(ranks_of_parts)}, {"previous", previous ? 1u : 0u}});
    Remap result = find_numbers(parts, previous, *buffers, self).remap;
    if (is_spread) complete(buffers->search, std::move(numbers), result, self);
    return result;
}

Remap remap(std::span<const Part> parts, std::span<const RankRange> ranks_of_parts, MPI_Comm user) {
    Participant self{mpi::duplicate_of(user)};
    return remap(parts, std::nullopt, ranks_of_parts, is_spread(ranks_of_parts.size(), user), self);
}

Remap remap(std::span<const Part> parts, std::span<const Part> previous,
            std::span<const RankRange> ranks_of_parts, MPI_Comm user) {
    Participant self{mpi::duplicate_of(user)};
    return remap(parts, previous, ranks_of_parts, is_spread(ranks_of_parts.size(), user), self);
}

}  // namespace rrcb
