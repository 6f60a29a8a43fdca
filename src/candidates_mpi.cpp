#include "candidates_mpi.hpp"

#include "mpi/communicator.hpp"

#include <algorithm>
#include <numeric>

namespace rrcb {

Candidates::Candidates(int dimension, std::size_t most)
    : record_length_(static_cast<std::size_t>(dimension) + 1), record_(dimension + 1, MPI_DOUBLE) {
    lengths_.reserve(most);
}

void Candidates::expect(std::size_t num_lists, GlobalCount num_points, int num_ranks) {
    const auto ranks = static_cast<std::size_t>(num_ranks);
    all_lengths_.resize(ranks * num_lists);
    all_records_.resize(static_cast<std::size_t>(mpi::to_int(num_points)) * record_length_);
    counts_.resize(ranks);
    offsets_.resize(ranks);
}

void Candidates::clear() {
    lengths_.clear();
    records_.clear();
}

void Candidates::add(const LocalSearch& search) {
    search.append_candidates(records_);
    lengths_.push_back(mpi::to_int(static_cast<std::int64_t>(search.num_candidates())));
}

void Candidates::lose(std::size_t num_lists) {
    records_.clear();
    lengths_.assign(num_lists, lost);
}

void Candidates::gather(int root, MPI_Comm comm) {
    const int num_lists = static_cast<int>(lengths_.size());
    mpi::check(MPI_Gather(lengths_.data(), num_lists, MPI_INT, all_lengths_.data(), num_lists,
                          MPI_INT, root, comm),
               "MPI_Gather");
    std::ranges::fill(counts_, 0);
    for (std::size_t k = 0; k < all_lengths_.size(); ++k)
        counts_[k / lengths_.size()] += std::max(0, all_lengths_[k]);
    std::exclusive_scan(counts_.begin(), counts_.end(), offsets_.begin(), 0);
    mpi::check(MPI_Gatherv(records_.data(), static_cast<int>(records_.size() / record_length_),
                           record_.get(), all_records_.data(), counts_.data(), offsets_.data(),
                           record_.get(), root, comm),
               "MPI_Gatherv");
}

bool Candidates::any_failed() const {
    return std::ranges::count(all_lengths_, lost) > 0;
}

std::vector<std::vector<double>> Candidates::lists() const {
    std::vector<std::vector<double>> lists(lengths_.size());
    auto next = all_records_.begin();
    for (std::size_t i = 0; i < all_lengths_.size(); ++i) {
        const auto end = next + all_lengths_[i] * static_cast<std::ptrdiff_t>(record_length_);
        std::vector<double>& list = lists[i % lists.size()];
        list.insert(list.end(), next, end);
        next = end;
    }
    return lists;
}

}  // namespace rrcb
