#include "collective/rank_counts_mpi.hpp"

#include "collective/butterfly_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/rank_counts.hpp"

#include <algorithm>
#include <array>

namespace rrcb {

namespace {

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
