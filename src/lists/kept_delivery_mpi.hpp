#pragma once

#include "collective/neighbour_exchange_mpi.hpp"
#include "lists/delivery_mpi.hpp"

#include <rrcb/ghosts.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace rrcb {

/// The exchange of a ghost plan that is used repeatedly. It records the calls with certain columns
/// that a collective call has shown all ranks to make.
class detail::KeptExchange {
  public:
    /// Keeps an exchange with a plan, unless the plan has one that fits. Not collective.
    static void keep(const GhostPlan& plan, Participant& self);

    /// Makes the exchange of a plan. Not collective. Throws std::bad_alloc.
    KeptExchange(const GhostPlan& plan, const Participant& self);

    /// Returns the exchange of a plan if all ranks have made this call with such columns before,
    /// and no transfer since; otherwise null. The result is the same on every rank.
    static NeighbourExchange* find(const GhostPlan& plan, CallName call,
                                   std::span<const ByteColumn> columns,
                                   const TransferOptions& options, MPI_Comm user);

    /// Records that a collective call with such columns has succeeded on all ranks.
    void note(CallName call, std::span<const ByteColumn> columns, const TransferOptions& options);

  private:
    std::uint64_t num_transfers() const;

    NeighbourExchange exchange_;
    std::uint64_t lists_;                    ///< hash of the plan's counts
    std::array<std::uint64_t, 8> proven_{};  ///< hashes of the latest recorded calls
    std::size_t num_proven_ = 0;
    std::uint64_t num_transfers_ = 0;  ///< number of transfers before these calls
};

/// Moves columns as deliver(), but without collective calls. The call of the exchange must have
/// begun.
void deliver_kept(const Delivery& delivery, std::span<const detail::ByteColumn> columns,
                  TransferReport* report, NeighbourExchange& exchange);

}  // namespace rrcb
