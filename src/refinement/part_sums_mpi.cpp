#include "refinement/part_sums_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"

#include <rrcb/quality.hpp>

namespace rrcb {

double add_up_parts(std::span<double> here, std::span<double> sums,
                    std::span<const double> part_sizes, const Participant& self) {
    const std::size_t num_parts = part_sizes.size();
    here.back() = self.failure.failed ? 1 : 0;
    mpi::check(MPI_Reduce(here.data(), sums.data(), mpi::to_int(std::ssize(here)), MPI_DOUBLE,
                          MPI_SUM, root, self.comm),
               "MPI_Reduce");
    if (mpi::rank_of(self.comm) == root) sums.back() = imbalance(sums.first(num_parts), part_sizes);
    mpi::broadcast(std::as_writable_bytes(sums), root, self.comm);
    if (sums[num_parts] > 0) agree(self);
    return sums.back();
}

}  // namespace rrcb
