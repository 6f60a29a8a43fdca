#pragma once

#include <rrcb/experimental/kokkos/passes.hpp>
#include <rrcb/plan.hpp>

#include <mpi.h>

#include <span>
#include <utility>
#include <vector>

namespace rrcb::experimental {

/// Result of a call with views. Cuts and report are on the host, and are the same on every rank.
template <class MemorySpace>
struct KokkosBalance {
    Cuts cuts;                                   ///< between the parts, for look-ups
    Report report;                               ///< measured imbalance and statistics
    Kokkos::View<Part*, MemorySpace> parts{};    ///< parts of this rank's points, in the memory of
                                                 ///< the points
    detail::KokkosMemory<MemorySpace> memory{};  ///< reused by balance_into()
};

/// Replaces a result as balance() would, and reuses its memory on the device. Collective.
///
/// @param result   has no parts if the call throws. If there are at most as many points as before,
/// no memory is allocated for each. Copies of a result, and of its views, share the memory
/// @param exec     instance on whose device the points are; the call ends with a fence of it
/// @param x        View<T**> or View<T*[3]> of floats or doubles, points by axes, at any stride; or
///                 a std::array of one View<T*> for each axis
/// @param weights  a view of one float or double for each point; empty: every point weighs 1
/// @param comm     as for Points
/// @param options  the same on every rank
/// @param previous as for Points; may be `result.cuts`
/// Throws the same Error on every rank, as balance(const Points&), also if Kokkos is not
/// initialized on one rank. Cuts may differ from those of Points by rounding. Cost: see
/// docs/kokkos.md.
template <detail::KokkosSpace Execution, detail::KokkosPoints Views, class Weights>
void balance_into(KokkosBalance<detail::MemoryOf<Views>>& result, const Execution& exec,
                  const Views& x, const Weights& weights, MPI_Comm comm,
                  const Options& options = {}, const Cuts& previous = {}) {
    result.parts = {};
    detail::KokkosPasses<Execution, Views, Weights> passes(exec, x, weights, result.memory);
    Balance on_host = balance(static_cast<PointPasses&>(passes), comm, options, previous);
    result = {std::move(on_host.cuts), std::move(on_host.report), passes.device_parts(),
              passes.memory()};
}

/// Divides points in views, as the function with the same name for Points. Collective.
///
///     auto balance = rrcb::experimental::balance(exec, x, weights, comm, options);
///
/// @param exec     as for balance_into()
/// @param x        positions
/// @param weights  a view, empty if every point weighs 1
/// @param comm     as for Points
/// @param options  the same on every rank
/// @param previous as for Points
template <detail::KokkosSpace Execution, detail::KokkosPoints Views, detail::KokkosView Weights>
auto balance(const Execution& exec, const Views& x, const Weights& weights, MPI_Comm comm,
             const Options& options = {}, const Cuts& previous = {}) {
    KokkosBalance<detail::MemoryOf<Views>> result;
    balance_into(result, exec, x, weights, comm, options, previous);
    return result;
}

/// Divides points in views that all weigh 1. Collective.
///
/// @param exec     as for balance_into()
/// @param x        positions
/// @param comm     of the ranks with points
/// @param options  the same on every rank
/// @param previous cuts of an earlier call, or none
template <detail::KokkosSpace Execution, detail::KokkosPoints Views>
auto balance(const Execution& exec, const Views& x, MPI_Comm comm, const Options& options = {},
             const Cuts& previous = {}) {
    const Kokkos::View<double*, detail::MemoryOf<Views>> no_weights;
    return balance(exec, x, no_weights, comm, options, previous);
}

/// Writes the part of every point in a view. Not collective.
///
/// @param exec  as for balance(); the call ends with a fence of it
/// @param cuts  a complete tree
/// @param x     of the dimension of the cuts
/// @param parts a view in the memory of `x`, with an entry for each point
/// Throws Error if a coordinate is NaN or infinite, sizes differ, or the cuts are not a complete
/// tree.
template <detail::KokkosSpace Execution, detail::KokkosPoints Views>
void assign(const Execution& exec, const Cuts& cuts, const Views& x,
            const Kokkos::View<Part*, detail::MemoryOf<Views>>& parts) {
    assign(cuts, Points({}, cuts.dimension), std::span<Part>());  // checks the cuts
    using NoWeights = Kokkos::View<double*, detail::MemoryOf<Views>>;
    detail::KokkosPasses<Execution, Views, NoWeights> passes(exec, x, {}, {parts, {}});
    detail::require_on_device(passes.dimension() == cuts.dimension,
                              "positions must have the dimension of the cuts");
    detail::require_on_device(parts.extent(0) == passes.count(),
                              "parts must have one entry per point");
    passes.assign(cuts, false);
    if (cuts.is_numbered_in_order()) return;
    std::vector<Part> numbers;
    for (Part end = 0; end < cuts.num_parts; ++end) numbers.push_back(cuts.part_at(end));
    passes.renumber(numbers);
}

/// Returns for each point the rank that gets it, in the form that Cabana::Distributor takes. Not
/// collective.
///
/// @param exec      as for balance(); the call ends with a fence of it
/// @param balance   of the points of this rank
/// @param rank      this one, of the communicator of the balance
/// @param num_ranks size of that communicator
/// Throws Error if Kokkos is not initialized.
template <detail::KokkosSpace Execution, class MemorySpace>
Kokkos::View<int*, MemorySpace> destinations(const Execution& exec,
                                             const KokkosBalance<MemorySpace>& balance, int rank,
                                             int num_ranks) {
    detail::require_kokkos();
    std::vector<int> rank_of_part;
    for (Part part = 0; part < balance.cuts.num_parts; ++part) {
        const RankRange to = ranks_of_part(part, balance.cuts.num_parts, num_ranks);
        rank_of_part.push_back(to.contains(rank) ? rank : to.first_rank + rank % to.count);
    }
    detail::Device<Execution, MemorySpace> device(exec);
    const auto parts = balance.parts;
    const auto ranks = device.template allocate<int>(parts.extent(0));
    const auto table = device.copy_in(rank_of_part);
    Kokkos::parallel_for(
        "rrcb::ranks", device.range(parts.extent(0)),
        KOKKOS_LAMBDA(const std::int64_t i) { ranks(i) = table(parts(i)); });
    device.fence();
    return ranks;
}

}  // namespace rrcb::experimental
