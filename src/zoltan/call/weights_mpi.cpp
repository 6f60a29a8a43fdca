#include "zoltan/call/weights_mpi.hpp"

#include "collective/communicator.hpp"

#include <algorithm>
#include <array>

namespace rrcb::zoltan {

namespace {

using Sums = std::array<double, most_weights>;

/// Factor of each weight. Collective over `comm`.
Sums scales(std::span<const float> weights, std::size_t stride, bool comparable, MPI_Comm comm) {
    Sums sums{};
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (i % stride < sums.size()) sums[i % stride] += static_cast<double>(weights[i]);
    }
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, sums.data(), most_weights, MPI_DOUBLE, MPI_SUM, comm),
               "MPI_Allreduce");
    for (double& sum : sums) sum = comparable || sum == 0 ? 1 : 1 / sum;
    return sums;
}

}  // namespace

void combine_weights(const Parameters& parameters, Workspace& workspace, MPI_Comm comm,
                     Objects& objects) {
    if (parameters.weight_dimension <= 1) return;
    const auto stride = static_cast<std::size_t>(parameters.weight_dimension);
    const auto count = static_cast<std::size_t>(objects.count);
    const std::span weights(workspace.callback_weights.get(count * stride), count * stride);
    const Sums scale = scales(weights, stride, parameters.weights_comparable != 0, comm);
    double* combined = workspace.weights.get(count);
    for (std::size_t i = 0; i < count; ++i) {
        combined[i] = 0;
        for (std::size_t k = 0; k < std::min(stride, scale.size()); ++k) {
            combined[i] += scale[k] * static_cast<double>(weights[i * stride + k]);
        }
    }
    objects.points.weights = {combined, count};
}

}  // namespace rrcb::zoltan
