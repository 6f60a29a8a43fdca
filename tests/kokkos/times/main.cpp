// Prints times of balances of 3-D points on the default device, and of a copy to the host with a
// call there.
#include <rrcb/balance.hpp>
#include <rrcb/experimental/kokkos.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace {

using Device = Kokkos::DefaultExecutionSpace;
using Positions = Kokkos::View<double* [3], Device>;
using NoWeights = Kokkos::View<double*, Device>;

std::uint64_t bytes_out = 0;

/// Counts copies from a device to the host.
void add_copy(Kokkos::Tools::SpaceHandle to, const char*, const void*,
              Kokkos::Tools::SpaceHandle from, const char* source, const void*,
              std::uint64_t size) {
    // Kokkos reports that memory is filled as a copy of "(none)".
    const bool is_out =
        std::string_view(to.name) == "Host" && std::string_view(source) != "(none)" &&
        (std::string_view(from.name) != "Host" || rrcb::detail::runs_on_host<Device>);
    if (is_out) bytes_out += size;
}

struct Place {
    Positions x;
    bool is_sorted;  ///< along the first axis
    KOKKOS_FUNCTION void operator()(std::int64_t i) const {
        // A Weyl sequence along each axis, denser towards 0.
        for (int a = 0; a < 3; ++a) {
            const double u = static_cast<double>(i) * (0.8191725 - 0.148 * a);
            const double fraction = u - static_cast<double>(static_cast<std::int64_t>(u));
            x(i, a) = fraction * fraction;
            if (a == 0 && is_sorted)
                x(i, a) = static_cast<double>(i) / static_cast<double>(x.extent(0));
        }
    }
};

/// Returns the least time of some calls, in ms.
template <class Call>
double least_time(const Call& call) {
    double least = 1e300;
    for (int k = 0; k < 5; ++k) {
        Device().fence();
        const auto start = std::chrono::steady_clock::now();
        call();
        Device().fence();
        const std::chrono::duration<double, std::milli> time =
            std::chrono::steady_clock::now() - start;
        least = std::min(least, time.count());
    }
    return least;
}

void print_row(std::int64_t count, bool is_sorted) {
    const Positions x("x", static_cast<std::size_t>(count));
    Kokkos::parallel_for(Kokkos::RangePolicy<Kokkos::IndexType<std::int64_t>>(0, count),
                         Place{x, is_sorted});
    const rrcb::Options options{.num_parts = 8};
    rrcb::Cuts cuts;
    bytes_out = 0;
    cuts = rrcb::experimental::balance(Device(), x, MPI_COMM_WORLD, options).cuts;
    const std::uint64_t bytes = bytes_out;
    const double cold =
        least_time([&] { rrcb::experimental::balance(Device(), x, MPI_COMM_WORLD, options); });
    const double again = least_time(
        [&] { rrcb::experimental::balance(Device(), x, MPI_COMM_WORLD, options, cuts); });
    const auto copy = Kokkos::create_mirror(x);
    const double copying = least_time([&] { Kokkos::deep_copy(copy, x); });
    const double host =
        least_time([&] { rrcb::balance(rrcb::Points(copy), MPI_COMM_WORLD, options); });
    auto result = rrcb::experimental::balance(Device(), x, MPI_COMM_WORLD, options);
    const double into = least_time([&] {
        rrcb::experimental::balance_into(result, Device(), x, NoWeights(), MPI_COMM_WORLD, options);
    });
    std::printf("| %lld | %s | %.2f | %.2f | %.2f | %.2f | %.2f | %llu |\n",
                static_cast<long long>(count), is_sorted ? "sorted" : "random", cold, into, again,
                copying, host, static_cast<unsigned long long>(bytes));
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    Kokkos::initialize();
    Kokkos::Tools::Experimental::set_begin_deep_copy_callback(add_copy);
    std::printf("3-D doubles, 8 parts to 1 %%, %s, ms:\n\n", Device::name());
    std::printf(
        "| points | order | device | in the same memory | from earlier cuts | copy to the host | "
        "call there | bytes to the host |\n|---|---|---|---|---|---|---|---|\n");
    for (int k = 1; k < argc; ++k)
        for (const bool is_sorted : {false, true}) print_row(std::atoll(argv[k]), is_sorted);
    Kokkos::finalize();
    MPI_Finalize();
}
