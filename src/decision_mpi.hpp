#pragma once

#include "agreement_mpi.hpp"
#include "contribution.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/bisection.hpp>

#include <mpi.h>

namespace rrcb {

/// The decision of the root: how it went, and the cuts to assign by or to start from.
struct Decision {
    int failing_rank = no_rank;  ///< the root, when it could not decide
    Report report;
    Bisection bisection;
};

/// True when the cuts are to be moved by what the ranks count: the literal midpoint has no weight
/// to aim at, and all points at the root need no second look.
bool is_refined(const Options& options);

/// Records of all ranks at the root, in the order of the ranks; empty elsewhere. Collective.
std::vector<double> gather_records(std::span<const double> mine, std::span<const Header> headers,
                                   MPI_Comm comm);

/// Bisects, at the root, what the ranks contributed; or takes the cuts of an earlier call.
Failure decide(std::span<const Header> headers, std::span<const double> records,
               const Options& options, const Cuts* previous, Decision& decision);

/// Gives everybody the root's decision as one message. Collective.
void broadcast(Decision& decision, int dimension, const Options& options, MPI_Comm comm);

}  // namespace rrcb
