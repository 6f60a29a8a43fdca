#pragma once

#include "collective/neighbour_exchange_mpi.hpp"
#include "lists/delivery_mpi.hpp"

#include <rrcb/ghosts.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace rrcb {

/// Exchange of a plan of ghosts that is used again, with the calls that all ranks have proven to
/// make with the same columns.
class detail::KeptExchange {
  public:
    /// Keeps one with a plan, if it has none that fits. Not collective.
    static void keep(const GhostPlan& plan, Participant& self);

    /// Not collective. Throws std::bad_alloc.
    KeptExchange(const GhostPlan& plan, const Participant& self);

    /// Returns the exchange of a plan if the ranks have made this call with such columns, and no
    /// transfer since; else null. The same on every rank.
    static NeighbourExchange* find(const GhostPlan& plan, CallName call,
                                   std::span<const ByteColumn> columns,
                                   const TransferLimits& limits, MPI_Comm user);

    /// Records that a collective call with such columns has ended on all ranks.
    void note(CallName call, std::span<const ByteColumn> columns, const TransferLimits& limits);

  private:
    std::uint64_t num_transfers() const;

    NeighbourExchange exchange_;
    std::uint64_t lists_;                    ///< hash of the plan's counts
    std::array<std::uint64_t, 8> proven_{};  ///< hashes of the latest calls
    std::size_t num_proven_ = 0;
    std::uint64_t num_transfers_ = 0;  ///< transfers of the ranks before these calls
};

/// Moves columns as deliver(), without collective calls, by an exchange whose call has begun.
void deliver_kept(const Delivery& delivery, std::span<const detail::ByteColumn> columns,
                  TransferReport* report, NeighbourExchange& exchange);

}  // namespace rrcb
