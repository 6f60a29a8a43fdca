#include "histogram_mpi.hpp"

#include "mpi/communicator.hpp"

#include <algorithm>
#include <numeric>

namespace rrcb {

namespace {

/// MPI_User_function: each element is one histogram.
void join(void* in, void* in_out, int* count, MPI_Datatype* type) {
    int bytes = 0;
    MPI_Type_size(*type, &bytes);
    const auto length = static_cast<std::size_t>(bytes) / sizeof(double);
    const double* from = static_cast<const double*>(in);
    double* to = static_cast<double*>(in_out);
    for (int k = 0; k < *count; ++k, from += length, to += length) {
        for (std::size_t i = 0; i < HistogramLayout::num_extents; ++i)
            to[i] = std::max(to[i], from[i]);
        for (std::size_t i = HistogramLayout::num_extents; i < length; ++i) to[i] += from[i];
    }
}

/// The reduction and its type, freed at the end of a scope.
class Joining {
  public:
    explicit Joining(const HistogramLayout& layout) {
        mpi::check(MPI_Type_contiguous(static_cast<int>(layout.length()), MPI_DOUBLE, &type_),
                   "MPI_Type_contiguous");
        mpi::check(MPI_Type_commit(&type_), "MPI_Type_commit");
        mpi::check(MPI_Op_create(join, 1, &op_), "MPI_Op_create");
    }
    Joining(const Joining&) = delete;
    Joining& operator=(const Joining&) = delete;
    ~Joining() {
        MPI_Op_free(&op_);
        MPI_Type_free(&type_);
    }

    MPI_Datatype type() const { return type_; }
    MPI_Op op() const { return op_; }

  private:
    MPI_Datatype type_ = MPI_DATATYPE_NULL;
    MPI_Op op_ = MPI_OP_NULL;
};

}  // namespace

std::vector<double> join_histograms(std::span<const double> mine, const HistogramLayout& layout,
                                    int root, MPI_Comm comm) {
    const Joining joining(layout);
    std::vector<double> joined(mpi::rank_of(comm) == root ? mine.size() : 0);
    mpi::check(
        MPI_Reduce(mine.data(), joined.data(), static_cast<int>(mine.size() / layout.length()),
                   joining.type(), joining.op(), root, comm),
        "MPI_Reduce");
    return joined;
}

std::vector<std::vector<double>> gather_candidates(std::span<const std::vector<double>> mine,
                                                   int root, MPI_Comm comm) {
    const bool is_root = mpi::rank_of(comm) == root;
    const auto num_ranks = static_cast<std::size_t>(mpi::size_of(comm));
    std::vector<int> lengths;
    std::vector<double> records;
    for (const std::vector<double>& list : mine) {
        lengths.push_back(mpi::to_int(static_cast<std::int64_t>(list.size())));
        records.insert(records.end(), list.begin(), list.end());
    }
    const int num_lists = static_cast<int>(mine.size());
    std::vector<int> all_lengths(is_root ? num_ranks * mine.size() : 0);
    mpi::check(MPI_Gather(lengths.data(), num_lists, MPI_INT, all_lengths.data(), num_lists,
                          MPI_INT, root, comm),
               "MPI_Gather");

    std::vector<int> counts(is_root ? num_ranks : 0);
    std::vector<int> offsets(counts.size());
    for (std::size_t k = 0; k < all_lengths.size(); ++k) counts[k / mine.size()] += all_lengths[k];
    std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
    std::vector<double> all(
        static_cast<std::size_t>(std::accumulate(counts.begin(), counts.end(), 0)));
    mpi::check(MPI_Gatherv(records.data(), static_cast<int>(records.size()), MPI_DOUBLE, all.data(),
                           counts.data(), offsets.data(), MPI_DOUBLE, root, comm),
               "MPI_Gatherv");

    std::vector<std::vector<double>> lists(mine.size());
    auto next = all.begin();
    for (std::size_t k = 0; k < all_lengths.size(); ++k) {
        lists[k % mine.size()].insert(lists[k % mine.size()].end(), next, next + all_lengths[k]);
        next += all_lengths[k];
    }
    return lists;
}

}  // namespace rrcb
