#include "zoltan/norm/loads_mpi.hpp"

#include "collective/communicator.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rrcb::zoltan {

namespace {

/// Bits that a sum may take.
constexpr int sum_bits = 61;

std::size_t num_weights(const Criteria& criteria) {
    return std::min(criteria.stride, static_cast<std::size_t>(most_weights));
}

std::int64_t in_units(float weight, double per_weight) {
    return static_cast<std::int64_t>(static_cast<double>(weight) * per_weight + 0.5);
}

int bits_of(std::int64_t count) {
    return static_cast<int>(std::bit_width(static_cast<std::uint64_t>(count)));
}

/// Heaviest object of all ranks by each weight. Collective.
Factors heaviest_of(const Criteria& criteria, MPI_Comm comm) {
    Factors heaviest{};
    for (std::size_t i = 0; i < criteria.weights.size(); i += criteria.stride)
        for (std::size_t k = 0; k < num_weights(criteria); ++k)
            heaviest[k] = std::max(heaviest[k], static_cast<double>(criteria.weights[i + k]));
    mpi::check(
        MPI_Allreduce(MPI_IN_PLACE, heaviest.data(), most_weights, MPI_DOUBLE, MPI_MAX, comm),
        "MPI_Allreduce");
    return heaviest;
}

/// Sum of the loads of all ranks, in units. Collective.
Load sum_of(const Criteria& criteria, const Factors& per_weight, MPI_Comm comm) {
    Load sum{};
    for (std::size_t i = 0; i < criteria.weights.size(); i += criteria.stride)
        for (std::size_t k = 0; k < num_weights(criteria); ++k)
            sum[k] += in_units(criteria.weights[i + k], per_weight[k]);
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, sum.data(), most_weights, MPI_INT64_T, MPI_SUM, comm),
               "MPI_Allreduce");
    return sum;
}

}  // namespace

Units choose_units(const Criteria& criteria, GlobalCount num_objects, MPI_Comm comm) {
    Units units;
    const Factors heaviest = heaviest_of(criteria, comm);
    for (std::size_t k = 0; k < most_weights; ++k) {
        if (heaviest[k] == 0) continue;
        const int bits = std::ilogb(heaviest[k]) + 1 + bits_of(num_objects);
        units.per_weight[k] = std::ldexp(1.0, sum_bits - bits);
    }
    units.heaviest[most_weights] = 1;
    // The first units fit any sum. Beside a heavy object many are light, and their sum allows finer
    // units.
    const Load sum = sum_of(criteria, units.per_weight, comm);
    for (std::size_t k = 0; k < most_weights; ++k) {
        units.per_weight[k] =
            std::ldexp(units.per_weight[k], sum_bits - bits_of(sum[k] + num_objects));
        units.heaviest[k] = heaviest[k] * units.per_weight[k];
    }
    return units;
}

std::vector<Load> loads_of(const Criteria& criteria, const Units& units) {
    std::vector<Load> loads(criteria.weights.size() / criteria.stride);
    for (std::size_t i = 0; i < loads.size(); ++i) {
        for (std::size_t k = 0; k < num_weights(criteria); ++k)
            loads[i][k] = in_units(criteria.weights[i * criteria.stride + k], units.per_weight[k]);
        loads[i][most_weights] = 1;
    }
    return loads;
}

}  // namespace rrcb::zoltan
