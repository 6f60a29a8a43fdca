#include "refinement/histogram_mpi.hpp"

#include "collective/communicator.hpp"

#include <algorithm>
#include <limits>

namespace rrcb {

namespace {

/// MPI_User_function: each element is one histogram.
void join_elements(void* in, void* in_out, int* count, MPI_Datatype* type) {
    int bytes = 0;
    MPI_Type_size(*type, &bytes);
    const auto length = static_cast<std::size_t>(bytes) / sizeof(double);
    const double* from = static_cast<const double*>(in);
    double* to = static_cast<double*>(in_out);
    for (int k = 0; k < *count; ++k, from += length, to += length)
        join_histograms({from, length}, {to, length});
}

}  // namespace

Histograms::Histograms(const HistogramLayout& layout, std::size_t most, bool is_root)
    : layout_(layout),
      mine_(std::make_unique_for_overwrite<double[]>(most * layout.length())),
      joined_(is_root ? std::make_unique_for_overwrite<double[]>(most * layout.length()) : nullptr),
      type_(static_cast<int>(layout.length()), MPI_DOUBLE),
      op_(join_elements) {}

std::span<double> Histograms::add() {
    const std::span<double> histogram = mine(size_++);
    clear_histogram(histogram);
    return histogram;
}

void Histograms::join(int root, MPI_Comm comm) {
    mpi::check(MPI_Reduce(mine_.get(), joined_.get(), static_cast<int>(size_), type_.get(),
                          op_.get(), root, comm),
               "MPI_Reduce");
}

std::span<const double> Histograms::joined(std::size_t k) const {
    return {joined_.get() + k * layout_.length(), layout_.length()};
}

bool Histograms::any_failed() const {
    for (std::size_t k = 0; k < size_; ++k)
        if (is_marked_failed(joined(k))) return true;
    return false;
}

void Histograms::broadcast_samples(std::span<const std::size_t> samples, int root, MPI_Comm comm) {
    if (samples.empty()) return;
    if (joined_ != nullptr)
        for (std::size_t k = 0; k < samples.size(); ++k)
            std::ranges::copy(joined(samples[k]), mine(k).begin());
    mpi::broadcast(
        std::as_writable_bytes(std::span(mine_.get(), samples.size() * layout_.length())), root,
        comm);
}

std::span<const double> Histograms::sample(std::size_t k) const {
    return sample_in(mine(k));
}

}  // namespace rrcb
