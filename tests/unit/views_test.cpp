#include "../support/common.hpp"

#include <rrcb/error.hpp>
#include <rrcb/points.hpp>

#ifdef RRCB_WITH_KOKKOS
#include <Kokkos_Core.hpp>
#endif

namespace rrcb {
namespace {

struct Particle {
    double mass;
    std::array<double, 3> position;
    double x;
    double y;
    std::int64_t kind;  // so that the size is a multiple of that of doubles on every machine
};

struct FloatParticle {
    float position[2];
    float x;
    int kind;
};

TEST(Views, read_members_of_structs) {
    std::vector<Particle> particles;
    for (int i = 0; i < 4; ++i)
        particles.push_back({0.5, {i + 0.1, i + 0.2, i + 0.3}, 10.0 + i, 20.0 + i, i});
    const Points arrays(particles, &Particle::position);
    const Points members(particles, &Particle::x, &Particle::y);
    ASSERT_EQ(arrays.count, 4u);
    ASSERT_EQ(members.dimension, 2);
    for (LocalIndex i = 0; i < 4; ++i) {
        EXPECT_EQ(arrays.position(i), particles[i].position);
        EXPECT_EQ(members.position(i), (Vector{particles[i].x, particles[i].y, 0}));
    }
    EXPECT_EQ(bounding_box(arrays).upper, particles[3].position);
    particles.clear();
    EXPECT_EQ(Points(particles, &Particle::x).count, 0u);
    EXPECT_EQ(Points(particles, &Particle::position).dimension, 3);
}

TEST(Views, read_members_that_are_floats) {
    const std::vector<FloatParticle> particles{{{0.1f, 0.2f}, 0.3f, 1}, {{1.1f, 1.2f}, 1.3f, 2}};
    const Points arrays(particles, &FloatParticle::position);
    EXPECT_EQ(arrays.position(1), (Vector{1.1f, 1.2f, 0}));
    EXPECT_EQ(Points(particles, &FloatParticle::x).position(0), (Vector{0.3f, 0, 0}));
    EXPECT_EQ(bounding_box(arrays).lower[1], 0.2f);
}

/// As much of a std::mdspan with layout_stride as Points() uses; the library has none yet.
template <class T, std::size_t Rank>
struct Strided {
    using element_type = T;
    static constexpr std::size_t rank() { return Rank; }
    int extent(std::size_t k) const { return extents[k]; }
    int stride(std::size_t k) const { return strides[k]; }
    T* data_handle() const { return data; }

    T* data;
    std::array<int, Rank> extents;
    std::array<int, Rank> strides;
};

TEST(Views, read_views_of_points_and_axes_in_any_order) {
    const std::vector<float> values{1, 2, 3, 4, 5, 6};
    const Points rows(Strided<const float, 2>{values.data(), {3, 2}, {2, 1}});
    const Points columns(Strided<const float, 2>{values.data(), {3, 2}, {1, 3}});
    EXPECT_EQ(rows.position(1), (Vector{3, 4, 0}));
    EXPECT_EQ(columns.position(1), (Vector{2, 5, 0}));
    const Points padded(Strided<const float, 2>{values.data(), {2, 2}, {3, 1}});
    EXPECT_EQ(padded.position(1), (Vector{4, 5, 0}));
    EXPECT_EQ(bounding_box(padded).upper[1], 5);
}

TEST(Views, read_a_view_of_each_axis) {
    std::vector<double> values{1, 2, 3, 4, 5, 6};
    using Axis = Strided<double, 1>;
    const Points apart(Axis{values.data(), {3}, {1}}, Axis{&values[3], {3}, {1}});
    EXPECT_EQ(apart.position(2), (Vector{3, 6, 0}));
    const Points even(Axis{values.data(), {3}, {2}}, Axis{&values[1], {3}, {2}});
    EXPECT_EQ(even.position(2), (Vector{5, 6, 0}));
    const Axis first{values.data(), {3}, {1}};
    for (const Axis& other : {Axis{values.data(), {3}, {2}}, Axis{values.data(), {2}, {1}}})
        EXPECT_THROW(bounding_box(Points(first, other)), Error);
    EXPECT_THROW(bounding_box(Points(Axis{&values[5], {3}, {-1}})), Error);
}

#ifdef RRCB_WITH_KOKKOS
template <class Layout>
void expect_positions() {
    Kokkos::View<float* [3], Layout, Kokkos::HostSpace> view("positions", 5);
    for (int i = 0; i < 5; ++i)
        for (int a = 0; a < 3; ++a) view(i, a) = static_cast<float>(10 * i + a);
    const Points points(view);
    ASSERT_EQ(points.count, 5u);
    EXPECT_EQ(points.position(4), (Vector{40, 41, 42}));
    const auto x = Kokkos::subview(view, Kokkos::ALL, 0);
    const auto z = Kokkos::subview(view, Kokkos::ALL, 2);
    EXPECT_EQ(Points(x, z).position(3), (Vector{30, 32, 0}));
}

TEST(Views, read_views_of_kokkos) {
    const Kokkos::ScopeGuard guard;
    expect_positions<Kokkos::LayoutRight>();
    expect_positions<Kokkos::LayoutLeft>();
}
#endif

}  // namespace
}  // namespace rrcb
