#include "search/part_sums_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>

namespace rrcb {

double PartSums::add_up(std::span<const double> part_sizes, Participant& self) {
    const std::size_t num_parts = part_sizes.size();
    here_.back() = self.failed() ? 1 : 0;
    mpi::check(MPI_Reduce(here_.data(), sums_.data(), mpi::to_int(std::ssize(here_)), MPI_DOUBLE,
                          MPI_SUM, root, self.comm),
               "MPI_Reduce");
    if (mpi::rank_of(self.comm) == root)
        sums_.back() = imbalance(std::span(sums_).first(num_parts), part_sizes);
    mpi::broadcast(std::as_writable_bytes(std::span(sums_)), root, self.comm);
    if (sums_[num_parts] > 0) fail_together(some_rank, self);
    return sums_.back();
}

void PartSums::set(std::span<const double> here, std::span<const double> sums) {
    std::ranges::copy(here, here_.begin());
    std::ranges::copy(sums, sums_.begin());
}

std::vector<double> PartSums::take() {
    sums_.resize(sums_.size() - 2);
    return std::move(sums_);
}

}  // namespace rrcb
