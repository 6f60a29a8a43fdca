// The kernels of calls with views, which tests/kokkos/device_code compiles for a GPU.
#include <rrcb/experimental/kokkos.hpp>

using Device = Kokkos::DefaultExecutionSpace;
using Positions = Kokkos::View<double* [3], Device>;
using Weights = Kokkos::View<double*, Device>;
using Result = rrcb::experimental::KokkosBalance<Device::memory_space>;

template void rrcb::experimental::balance_into(Result&, const Device&, const Positions&,
                                               const Weights&, MPI_Comm, const rrcb::Options&,
                                               const rrcb::Cuts&);
template auto rrcb::experimental::destinations(const Device&, const Result&, int, int)
    -> Kokkos::View<int*, Device::memory_space>;
