#include "collective/rank_counts_mpi.hpp"

#include "collective/butterfly_mpi.hpp"
#include "collective/communicator.hpp"

#include <array>
#include <bit>
#include <cstdint>

namespace rrcb {

namespace {

/// A key has the destination rank in its upper bits and the source rank in these lower ones.
constexpr int source_bits = 32;

}  // namespace

void add_counts(std::span<const RankCount> to, Butterfly& butterfly) {
    const auto source = static_cast<Key>(butterfly.rank());
    for (const auto& [rank, count] : to)
        butterfly.add(static_cast<Key>(rank) << source_bits | source, rank,
                      std::array{std::bit_cast<double>(std::uint64_t{count})});
}

std::vector<RankCount> counts_in(const Butterfly& butterfly) {
    std::vector<RankCount> counts;
    butterfly.owned().for_each([&](const Record& one) {
        const Key source = one.key - (one.key >> source_bits << source_bits);
        counts.push_back({static_cast<int>(source), std::bit_cast<std::uint64_t>(one.payload[0])});
    });
    return counts;
}

std::vector<RankCount> exchange_counts(std::span<const RankCount> to, Participant& self,
                                       Flags* flags) {
    Butterfly butterfly(mpi::rank_of(self.comm), mpi::size_of(self.comm), nullptr);
    self.attempt([&] { add_counts(to, butterfly); });
    ButterflyMessages messages;
    messages.run(butterfly, Butterfly::to_owners, flags != nullptr ? *flags : Flags{}, self);
    if (flags != nullptr) *flags = butterfly.flags();
    std::vector<RankCount> from;
    self.attempt([&] { from = counts_in(butterfly); });
    return from;
}

}  // namespace rrcb
