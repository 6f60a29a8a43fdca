#pragma once

#include "../support/common.hpp"
#include "clouds.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/experimental/kokkos/passes.hpp>

namespace rrcb::test {

using Device = Kokkos::DefaultExecutionSpace;
using Memory = Device::memory_space;
using WeightView = Kokkos::View<double*, Memory>;

}  // namespace rrcb::test

#ifdef RRCB_TEST_AS_DEVICE
// The host does what a GPU does: its teams add up in halves of words, rows in registers.
template <>
inline constexpr bool rrcb::detail::runs_on_host<rrcb::test::Device> = false;
#endif

namespace rrcb::test {

/// Runs Kokkos around the tests of a program.
struct KokkosRuns : testing::Environment {
    void SetUp() override { Kokkos::initialize(); }
    void TearDown() override { Kokkos::finalize(); }
};
inline testing::Environment* const kokkos_runs =
    testing::AddGlobalTestEnvironment(new KokkosRuns);  // NOLINT: the test owns it

/// Points of a test on the host, and what they become on the device.
struct Cloud {
    int dimension = 0;
    std::vector<double> x{};
    std::vector<double> weights{};

    LocalIndex count() const { return x.size() / static_cast<std::size_t>(dimension); }
    Points points() const { return Points(x, dimension, weights); }
};

/// Points in the unit cube whose coordinates floats hold; some are coincident, many are aligned.
inline Cloud lattice_cloud(std::size_t count, int dimension, unsigned seed, bool is_weighted) {
    Cloud cloud{dimension, uniform_cloud(count, dimension, seed)};
    for (double& x : cloud.x) x = std::floor(x * 32) / 32 - 0.25;
    std::mt19937_64 engine(seed + 1);
    for (std::size_t i = 0; is_weighted && i < count; ++i)
        cloud.weights.push_back(std::floor(uniform(engine, 0, 5)) / 4);
    return cloud;
}

inline Cloud smooth_cloud(std::size_t count, int dimension, unsigned seed, bool is_weighted) {
    Cloud cloud = lattice_cloud(count, dimension, seed, is_weighted);
    cloud.x = uniform_cloud(count, dimension, seed);
    for (double& x : cloud.x) x = static_cast<float>(x * x + 3);
    return cloud;
}

template <class T>
Kokkos::View<T*, Memory> on_device(const std::vector<T>& values) {
    const Kokkos::View<T*, Memory> view("values", values.size());
    const auto host = Kokkos::create_mirror_view(view);
    std::copy(values.begin(), values.end(), host.data());
    Kokkos::deep_copy(view, host);
    return view;
}

/// Returns a copy on the host.
template <class View>
auto on_host(const View& view) {
    const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
    return std::vector<typename View::non_const_value_type>(host.data(),
                                                            host.data() + host.extent(0));
}

/// Returns the points as a view of a layout; a strided one is a part of another view.
template <class T, class Layout>
auto view_of(const Cloud& cloud) {
    const auto dimension = static_cast<std::size_t>(cloud.dimension);
    constexpr bool is_strided = std::is_same_v<Layout, Kokkos::LayoutStride>;
    using Base = std::conditional_t<is_strided, Kokkos::LayoutRight, Layout>;
    const Kokkos::View<T***, Base, Memory> all("x", cloud.count(), dimension, 2);
    const auto host = Kokkos::create_mirror_view(all);
    for (std::size_t i = 0; i < cloud.count(); ++i)
        for (std::size_t a = 0; a < dimension; ++a)
            host(i, a, 1) = static_cast<T>(cloud.x[i * dimension + a]);
    Kokkos::deep_copy(all, host);
    const auto part = Kokkos::subview(all, Kokkos::ALL, Kokkos::ALL, 1);
    if constexpr (is_strided) {
        return Kokkos::View<const T**, Layout, Memory>(part);
    } else {
        const Kokkos::View<T**, Layout, Memory> view("x", cloud.count(), dimension);
        Kokkos::deep_copy(view, part);
        return view;
    }
}

template <class T, class Layout>
auto passes_of(const Cloud& cloud) {
    const auto view = view_of<T, Layout>(cloud);
    return detail::KokkosPasses<Device, std::remove_const_t<decltype(view)>, WeightView>(
        Device(), view, on_device(cloud.weights));
}

/// Returns cuts through positions of the cloud, which break ties, or through planes.
inline Cuts cuts_through(const Cloud& cloud, int num_parts, unsigned seed) {
    std::mt19937_64 engine(seed);
    Cuts cuts{.dimension = cloud.dimension, .num_parts = num_parts, .tree = {}};
    for (int k = 0; k + 1 < num_parts; ++k) {
        Cut cut{
            static_cast<std::int32_t>(engine() % static_cast<unsigned>(cloud.dimension)), 0, {}};
        cut.at = cloud.points().position(engine() % cloud.count());
        if (k % 3 == 2)
            for (std::size_t a = 0; a < max_dimension; ++a)
                if (a != static_cast<std::size_t>(cut.axis))
                    cut.at[a] = -std::numeric_limits<double>::infinity();
        cuts.tree.push_back(cut);
    }
    return cuts;
}

/// Returns the text of the Error that a call throws.
template <class Call>
std::string error_of(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace rrcb::test
