#include "histogram_mpi.hpp"

#include "mpi/communicator.hpp"

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
    for (int k = 0; k < *count; ++k, from += length, to += length) {
        for (std::size_t i = 0; i < HistogramLayout::num_extents; ++i)
            to[i] = std::max(to[i], from[i]);
        for (std::size_t i = HistogramLayout::num_extents; i < length; ++i) to[i] += from[i];
    }
}

}  // namespace

Histograms::Histograms(const HistogramLayout& layout, std::size_t most, bool is_root)
    : layout_(layout),
      mine_(std::make_unique_for_overwrite<double[]>(most * layout.length())),
      joined_(is_root ? std::make_unique_for_overwrite<double[]>(most * layout.length()) : nullptr),
      type_(static_cast<int>(layout.length()), MPI_DOUBLE),
      op_(join_elements) {}

std::span<double> Histograms::add() {
    const std::size_t length = layout_.length();
    const std::span<double> histogram(mine_.get() + size_++ * length, length);
    std::ranges::fill(histogram, 0.0);
    std::ranges::fill(histogram.first(HistogramLayout::failed),
                      -std::numeric_limits<double>::infinity());
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
    return size_ > 0 && joined(0)[HistogramLayout::failed] > 0;
}

}  // namespace rrcb
