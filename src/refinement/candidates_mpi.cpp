#include "refinement/candidates_mpi.hpp"

#include "collective/communicator.hpp"

#include <algorithm>
#include <numeric>

namespace rrcb {

namespace {

constexpr int count_where_failed = -1;

}  // namespace

Candidates::Candidates(int dimension)
    : record_length_(static_cast<std::size_t>(dimension) + 2), record_(dimension + 2, MPI_DOUBLE) {}

void Candidates::expect(GlobalCount num_points, int num_ranks) {
    all_records_.resize(static_cast<std::size_t>(mpi::to_int(num_points)) * record_length_);
    counts_.resize(static_cast<std::size_t>(num_ranks));
    offsets_.resize(static_cast<std::size_t>(num_ranks));
}

void Candidates::clear() {
    failed_ = false;
    records_.clear();
}

void Candidates::add(std::size_t list, const LocalSearch& search) {
    search.append_candidates(static_cast<double>(list), records_);
}

void Candidates::mark_failed() {
    clear();
    failed_ = true;
}

void Candidates::gather(int root, MPI_Comm comm) {
    const auto num_records = static_cast<int>(records_.size() / record_length_);
    const int told = failed_ ? count_where_failed : num_records;
    mpi::check(MPI_Gather(&told, 1, MPI_INT, counts_.data(), 1, MPI_INT, root, comm), "MPI_Gather");
    any_failed_ = std::ranges::count(counts_, count_where_failed) > 0;
    std::ranges::replace(counts_, count_where_failed, 0);
    std::exclusive_scan(counts_.begin(), counts_.end(), offsets_.begin(), 0);
    mpi::check(MPI_Gatherv(records_.data(), num_records, record_.get(), all_records_.data(),
                           counts_.data(), offsets_.data(), record_.get(), root, comm),
               "MPI_Gatherv");
}

std::vector<std::vector<double>> Candidates::lists(std::size_t num_lists) const {
    std::vector<std::vector<double>> lists(num_lists);
    const auto length = static_cast<std::ptrdiff_t>(record_length_);
    for (auto record = all_records_.begin(); record != all_records_.end(); record += length) {
        std::vector<double>& list = lists[static_cast<std::size_t>(*record)];
        list.insert(list.end(), record + 1, record + length);
    }
    return lists;
}

}  // namespace rrcb
