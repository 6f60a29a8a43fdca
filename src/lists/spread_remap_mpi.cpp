#include "lists/spread_remap_mpi.hpp"

#include "collective/communicator.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <iterator>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace rrcb {

namespace {

void add_up(std::span<const double> a, std::span<const double> b, std::vector<double>& joined) {
    std::ranges::transform(a, b, std::back_inserter(joined), std::plus<>());
}

/// What all steps of a renumbering share.
struct Steps {
    SpreadRemapRoom& room;
    ButterflyMessages& messages;
    Participant& self;

    void pass(Butterfly& butterfly, Butterfly::Direction direction, const Flags& flags = {}) {
        messages.run(butterfly, direction, flags, self);
    }
};

std::vector<Overlap> count_by_part(std::span<const Part> parts, int rank) {
    std::unordered_map<Part, GlobalCount> counts;
    for (const Part part : parts) ++counts[part];
    std::vector<Overlap> overlaps;
    for (const auto& [part, count] : counts) overlaps.push_back({rank, part, count});
    std::ranges::sort(overlaps, {}, &Overlap::part);
    return overlaps;
}

constexpr int bits_of_part = 32;

/// Overlaps with earlier parts of this rank, of which all ranks told.
std::vector<Overlap> overlaps_of(const Butterfly& told) {
    std::vector<Overlap> overlaps;
    told.owned().for_each([&](const Record& record) {
        overlaps.push_back({static_cast<std::int32_t>(record.key >> bits_of_part),
                            static_cast<Part>(record.key & ((Key{1} << bits_of_part) - 1)),
                            static_cast<GlobalCount>(record.payload[0])});
    });
    return overlaps;
}

/// Tells the overlaps with earlier parts to the ranks of these; returns whether there are any.
bool tell_overlaps(std::span<const Part> parts, const PreviousParts& previous, Steps& steps) {
    const NumberRule& rule = steps.room.search.rule();
    steps.self.attempt([&] {
        if (!previous) return;
        std::vector<Overlap> overlaps = overlaps_by_part(parts, *previous, rule.num_parts);
        keep_largest(rule.most_overlaps(), overlaps);
        std::ranges::sort(overlaps, {},
                          [](const Overlap& o) { return std::tie(o.origin, o.part); });
        for (const auto& [origin, part, count] : overlaps)
            steps.room.told.add((static_cast<Key>(origin) << bits_of_part) + static_cast<Key>(part),
                                rule.rank_of(origin), std::array{static_cast<double>(count)});
    });
    steps.pass(steps.room.told, Butterfly::to_owners, {0, previous ? 1.0 : 0.0});
    return steps.room.told.flags()[1] > 0;
}

/// Makes offers until all stand; false where nobody makes any that would change a number.
bool exchange_offers(Steps& steps) {
    Butterfly& offers = steps.room.offers;
    NumberSearch& search = steps.room.search;
    for (int round = 0; round < most_rounds_of_offers; ++round) {
        auto news = NumberSearch::News::none;
        steps.self.attempt([&] {
            offers.clear();
            news = search.offer(offers);
        });
        const bool moves = news == NumberSearch::News::elsewhere;
        steps.pass(offers, Butterfly::to_owners,
                   {0, news != NumberSearch::News::none ? 1.0 : 0.0, moves ? 1.0 : 0.0});
        if (round == 0 && offers.flags()[2] == 0) return false;
        steps.self.attempt([&] { search.choose(offers); });
        if (offers.flags()[1] == 0) break;
        steps.pass(offers, Butterfly::back);
        steps.self.attempt([&] { search.follow(offers); });
    }
    return true;
}

/// Brings parts and numbers together that no offer did.
void join_what_is_left(Steps& steps) {
    NumberSearch& search = steps.room.search;
    Butterfly& left = steps.room.left;
    NumberSearch::Counts mine;
    steps.self.attempt([&] { mine = search.settle(); });
    std::array<std::int64_t, 2> before{};
    const std::array here{mine.parts, mine.numbers};
    mpi::check(MPI_Exscan(here.data(), before.data(), 2, MPI_INT64_T, MPI_SUM, steps.self.comm),
               "MPI_Exscan");
    if (mpi::rank_of(steps.self.comm) == 0) before = {};
    const NumberSearch::Counts counts{before[0], before[1]};
    bool has_any = false;
    steps.self.attempt([&] { has_any = search.meet(counts, left); });
    steps.pass(left, Butterfly::to_owners, {0, has_any ? 1.0 : 0.0});
    if (left.flags()[1] == 0) return;
    steps.self.attempt([&] { answer_all(left); });
    steps.pass(left, Butterfly::back);
    steps.self.attempt([&] { search.take(counts, left); });
}

/// What the new numbers keep, summed over the ranks.
Remap sum_up(std::size_t num_points, const NumberSearch::Kept& kept, MPI_Comm comm) {
    std::array<GlobalCount, 3> sums{static_cast<GlobalCount>(num_points), kept.before, kept.after};
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, sums.data(), 3, MPI_INT64_T, MPI_SUM, comm),
               "MPI_Allreduce");
    Remap summary;
    summary.num_points = sums[0];
    summary.kept_before = sums[1];
    summary.kept_after = std::max(sums[1], sums[2]);
    summary.identity = summary.kept_after == summary.kept_before;
    return summary;
}

std::vector<Numbered> exchange_numbers(std::span<const Part> touched, Steps& steps) {
    NumberSearch& search = steps.room.search;
    Butterfly& numbers = steps.room.left;
    std::vector<Numbered> result;
    steps.self.attempt([&] {
        numbers.clear();
        search.tell(touched, numbers);
    });
    steps.pass(numbers, Butterfly::to_owners);
    steps.self.attempt([&] { search.conclude(numbers); });
    steps.pass(numbers, Butterfly::back);
    steps.self.attempt([&] { result = search.result(numbers); });
    return result;
}

}  // namespace

SpreadRemapRoom::SpreadRemapRoom(int num_parts, MPI_Comm comm)
    : search(num_parts, mpi::size_of(comm), mpi::rank_of(comm)),
      told(mpi::rank_of(comm), mpi::size_of(comm), add_up),
      offers(mpi::rank_of(comm), mpi::size_of(comm), NumberSearch::keep_larger),
      left(mpi::rank_of(comm), mpi::size_of(comm), NumberSearch::unite) {}

SpreadRemap remap_spread(std::span<const Part> parts, Origins origins,
                         const PreviousParts& previous, SpreadRemapRoom& room,
                         ButterflyMessages& messages, Participant& self) {
    Steps steps{room, messages, self};
    std::vector<Overlap> overlaps;
    std::vector<Part> touched;
    self.attempt([&] {
        overlaps = count_by_part(parts, mpi::rank_of(self.comm));
        for (const Overlap& overlap : overlaps) touched.push_back(overlap.part);
    });
    if (origins == Origins::parts && !tell_overlaps(parts, previous, steps))
        origins = Origins::ranks;
    self.attempt([&] {
        if (origins == Origins::parts) overlaps = overlaps_of(room.told);
        if (origins == Origins::ranks) keep_largest(room.search.rule().most_overlaps(), overlaps);
        room.search.start(origins, overlaps);
    });
    if (exchange_offers(steps)) join_what_is_left(steps);
    NumberSearch::Kept kept;
    self.attempt([&] { kept = room.search.kept(); });
    SpreadRemap result{sum_up(parts.size(), kept, self.comm)};
    if (!result.summary.identity) result.numbers = exchange_numbers(touched, steps);
    return result;
}

}  // namespace rrcb
