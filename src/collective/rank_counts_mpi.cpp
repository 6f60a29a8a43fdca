#include "collective/rank_counts_mpi.hpp"

#include "collective/butterfly_mpi.hpp"
#include "collective/communicator.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace rrcb {

namespace {

/// Bits of a key below the destination rank: those of the source rank, if any.
constexpr int source_bits = 32;

double word_of(LocalIndex count) {
    return std::bit_cast<double>(std::uint64_t{count});
}

LocalIndex count_of(std::span<const double> payload) {
    return std::bit_cast<std::uint64_t>(payload[0]);
}

void add_counts(std::span<const double> a, std::span<const double> b, std::vector<double>& joined) {
    joined.push_back(word_of(count_of(a) + count_of(b)));
}

RankCounts exchange(RankCounts::Kind kind, std::span<const RankCount> to, const Flags& flags,
                    Participant& self) {
    RankCounts counts(kind, mpi::rank_of(self.comm), mpi::size_of(self.comm));
    self.attempt([&] { counts.add(to); });
    // On the stack, to receive even if no memory is left.
    std::array<double, 1024> buffer;
    const auto piece =
        std::span(buffer).first(std::min(buffer.size(), mpi::longest_message / sizeof(double)));
    ButterflyMessages(piece).run(counts.butterfly(), Butterfly::to_owners, flags, self);
    return counts;
}

}  // namespace

RankCounts::RankCounts(Kind kind, int rank, int num_ranks)
    : kind_(kind), butterfly_(rank, num_ranks, kind == sum ? add_counts : nullptr) {}

void RankCounts::add(std::span<const RankCount> to) {
    const Key source = kind_ == each ? static_cast<Key>(butterfly_.rank()) : 0;
    for (const auto& [rank, count] : to)
        butterfly_.add(static_cast<Key>(rank) << source_bits | source, rank,
                       std::array{word_of(count)});
}

LocalIndex RankCounts::total() const {
    LocalIndex total = 0;
    butterfly_.owned().for_each([&](const Record& one) { total += count_of(one.payload); });
    return total;
}

std::vector<RankCount> RankCounts::from() const {
    std::vector<RankCount> counts;
    butterfly_.owned().for_each([&](const Record& one) {
        const Key source = one.key - (one.key >> source_bits << source_bits);
        counts.push_back({static_cast<int>(source), count_of(one.payload)});
    });
    return counts;
}

LocalIndex count_arrivals(std::span<const RankCount> to, Participant& self) {
    return exchange(RankCounts::sum, to, {}, self).total();
}

std::vector<RankCount> exchange_counts(std::span<const RankCount> to, Participant& self,
                                       Flags* flags) {
    RankCounts counts = exchange(RankCounts::each, to, flags != nullptr ? *flags : Flags{}, self);
    if (flags != nullptr) *flags = counts.butterfly().flags();
    std::vector<RankCount> from;
    self.attempt([&] { from = counts.from(); });
    return from;
}

}  // namespace rrcb
