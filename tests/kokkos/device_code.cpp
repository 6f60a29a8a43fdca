// The kernels of calls with views, which tests/kokkos/device_code compiles for a GPU.
#include <rrcb/experimental/kokkos.hpp>

using Device = Kokkos::DefaultExecutionSpace;
using Positions = Kokkos::View<double* [3], Device>;
using Weights = Kokkos::View<double*, Device>;
using Result = rrcb::experimental::KokkosBalance<Device::memory_space>;

template void rrcb::experimental::balance_into(Result&, const Device&, const Positions&,
                                               const Weights&, const rrcb::Options&,
                                               const rrcb::Cuts&, MPI_Comm);
template auto rrcb::experimental::plan(const Device&, const Result&, MPI_Comm)
    -> rrcb::experimental::KokkosPlan<Device::memory_space>;
