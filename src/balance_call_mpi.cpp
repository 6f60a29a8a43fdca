// The public functions.
#include "balance_mpi.hpp"
#include "collective/duplicate.hpp"
#include "gather/keeping.hpp"

#include <utility>

namespace rrcb {

Balance balance(const Points& points, const Options& options, const Cuts* previous, bool may_stay,
                Participant& self) {
    Outcome reused = balance_once(points, options, previous, may_stay, self);
    if (!reused.may_be_poor) return std::move(reused.balance);
    Balance anew = balance_once(points, options, nullptr, false, self).balance;
    const double imbalance = reused.balance.report.imbalance;
    const bool gains = is_worth_moving(imbalance, anew.report.imbalance, options);
    const int rounds = reused.balance.report.details.rounds + anew.report.details.rounds;
    Balance& best = gains ? anew : reused.balance;
    best.report.details.rounds = rounds;
    return std::move(best);
}

Balance balance(const Points& points, const Options& options, MPI_Comm comm) {
    Participant self{mpi::duplicate_of(comm)};
    return balance(points, options, nullptr, true, self);
}

Balance rebalance(const Points& points, const Options& options, const Cuts& previous,
                  MPI_Comm comm) {
    Participant self{mpi::duplicate_of(comm)};
    return balance(points, options, &previous, true, self);
}

}  // namespace rrcb
