#include "ranks.hpp"
#include "same_error.hpp"

#include <rrcb/experimental/kokkos.hpp>

#include <gtest/gtest.h>

#include <array>

namespace rrcb::test {
namespace {

TEST(Uninitialized, is_an_error_on_all_ranks) {
    if (KOKKOS_VERSION >= 50000) GTEST_SKIP() << "this Kokkos ends a program that makes a space";
    if (rank() != 1) Kokkos::initialize();
    {
        std::array<double, 6> values{1, 2, 3, 4, 5, 6};
        const Kokkos::View<double* [2], Kokkos::LayoutRight, Kokkos::HostSpace,
                           Kokkos::MemoryTraits<Kokkos::Unmanaged>>
            x(values.data(), 3);
        expect_same_error(
            [&] { experimental::balance(Kokkos::DefaultHostExecutionSpace(), x, MPI_COMM_WORLD); },
            "Kokkos is not initialized; call Kokkos::initialize()");
    }
    if (rank() != 1) Kokkos::finalize();
}

}  // namespace
}  // namespace rrcb::test
