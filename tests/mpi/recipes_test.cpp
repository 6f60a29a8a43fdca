// What docs/loop.md advises: boxes that are tilted, and points in half-open boxes. In C++ and C.
#include "../support/clouds.hpp"
#include "../support/ranks.hpp"

#include <rrcb/rrcb.h>
#include <rrcb/rrcb.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace rrcb {
namespace {

using test::num_ranks;
using test::rank;

constexpr Box unit{{0, 0, 0}, {1, 1, 1}};
constexpr double tilt = 0.3;
constexpr double radius = 0.1;

/// Greatest ratio of the distances of two points without the tilt and with it.
const double stretch = (tilt + std::sqrt(tilt * tilt + 4)) / 2;

/// Every rank knows 200 points without their tilt, and has each n-th one.
std::vector<double> points_of(int from_rank) {
    const std::vector<double> all = test::uniform_cloud(200, 2, 3);
    std::vector<double> mine;
    for (std::size_t i = 0; i < 200; ++i)
        if (from_rank < 0 || static_cast<int>(i) % num_ranks() == from_rank)
            mine.insert(mine.end(), {all[2 * i], all[2 * i + 1]});
    return mine;
}

/// Counts the points, with the images given, nearer to a point than the radius; all are tilted
/// here.
int num_near(double u, double v, const std::vector<double>& others, int most_periods) {
    int count = 0;
    for (std::size_t j = 0; j < others.size(); j += 2)
        for (int k = -most_periods; k <= most_periods; ++k)
            for (int l = -most_periods; l <= most_periods; ++l) {
                const double du = others[j] + k - u;
                const double dv = others[j + 1] + l - v;
                count += std::hypot(du + tilt * dv, dv) <= radius ? 1 : 0;
            }
    return count;
}

void expect_all_pairs(const std::vector<double>& here, std::vector<double> images) {
    const std::vector<double> all = points_of(-1);
    images.insert(images.end(), here.begin(), here.end());
    for (std::size_t i = 0; i < here.size(); i += 2)
        EXPECT_EQ(num_near(here[i], here[i + 1], images, 0),
                  num_near(here[i], here[i + 1], all, 1));
}

TEST(TiltedBox, gives_all_pairs_without_the_tilt_and_with_a_greater_radius) {
    const std::vector<double> scattered = points_of(rank());
    const Balance made = balance(interleaved_points(scattered, 2), {}, {}, MPI_COMM_WORLD);
    const std::vector<double> here =
        transfer(plan(made, MPI_COMM_WORLD), column(scattered, 2), MPI_COMM_WORLD);
    const GhostPlan near = ghosts(made.cuts, interleaved_points(here, 2),
                                  {.radius = radius * stretch, .periodic = unit}, MPI_COMM_WORLD);
    std::vector<double> images = fetch(near, column(here, 2), MPI_COMM_WORLD);
    apply_shifts(near, images);
    expect_all_pairs(here, images);
}

/// Edges of a box with the tilts xy, xz and yz, as columns; and the norm of its inverse, the
/// greatest ratio of distances without the tilts and with them.
struct TiltedBox {
    double xy = 0.3;
    double xz = -0.5;
    double yz = 0.4;

    Vector place(const Vector& u) const {
        return {u[0] + xy * u[1] + xz * u[2], u[1] + yz * u[2], u[2]};
    }
    Vector without_tilt(const Vector& x) const {
        const double v = x[1] - yz * x[2];
        return {x[0] - xy * v - xz * x[2], v, x[2]};
    }
    double norm_of_inverse() const {
        // By the power method, with the transpose of the inverse as the second factor.
        Vector x{1, 1, 1};
        double square = 1;
        for (int k = 0; k < 1000; ++k) {
            const Vector u = without_tilt(x);
            const double v = u[1] - xy * u[0];
            x = {u[0], v, u[2] - xz * u[0] - yz * v};
            square = std::hypot(x[0], x[1], x[2]);
            for (double& value : x) value /= square;
        }
        return std::sqrt(square);
    }
};

double distance(const Vector& a, const Vector& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(TiltedBox, gives_all_pairs_in_3d_with_the_norm_of_its_inverse) {
    const TiltedBox box;
    const double reach = 0.2;
    const std::vector<double> all = test::uniform_cloud(200, 3, 4);
    std::vector<double> scattered;
    for (std::size_t i = 0; i < 200; ++i)
        if (static_cast<int>(i) % num_ranks() == rank())
            scattered.insert(scattered.end(), {all[3 * i], all[3 * i + 1], all[3 * i + 2]});
    const Balance made = balance(interleaved_points(scattered, 3), {}, {}, MPI_COMM_WORLD);
    const std::vector<double> here =
        transfer(plan(made, MPI_COMM_WORLD), column(scattered, 3), MPI_COMM_WORLD);
    const GhostPlan near =
        ghosts(made.cuts, interleaved_points(here, 3),
               {.radius = reach * box.norm_of_inverse(), .periodic = unit}, MPI_COMM_WORLD);
    std::vector<double> images = fetch(near, column(here, 3), MPI_COMM_WORLD);
    apply_shifts(near, images);
    images.insert(images.end(), here.begin(), here.end());
    for (std::size_t i = 0; i < here.size(); i += 3) {
        const Vector at = box.place({here[i], here[i + 1], here[i + 2]});
        int found = 0, expected = 0;
        for (std::size_t j = 0; j < images.size(); j += 3)
            found += distance(at, box.place({images[j], images[j + 1], images[j + 2]})) <= reach;
        for (std::size_t j = 0; j < all.size(); j += 3)
            for (int k = 0; k < 27; ++k) {
                const Vector image{all[j] + k % 3 - 1, all[j + 1] + k / 3 % 3 - 1,
                                   all[j + 2] + k / 9 - 1};
                expected += distance(at, box.place(image)) <= reach;
            }
        EXPECT_EQ(found, expected);
    }
    // The bound is attained: a shorter reach without the tilts misses pairs.
    double longest = 0;
    for (std::size_t i = 0; i < all.size(); i += 3) {
        const Vector x{all[i] - 0.5, all[i + 1] - 0.5, all[i + 2] - 0.5};
        longest = std::max(longest, distance(box.without_tilt(x), {}) / distance(x, {}));
    }
    EXPECT_LE(longest, box.norm_of_inverse());
    EXPECT_GT(longest, 0.98 * box.norm_of_inverse());
}

/// A balancer in C.
struct Balancer {
    rrcb_balancer* handle = nullptr;

    Balancer() { EXPECT_EQ(rrcb_create(MPI_COMM_WORLD, &handle), RRCB_OK); }
    Balancer(const Balancer&) = delete;
    Balancer& operator=(const Balancer&) = delete;
    ~Balancer() { rrcb_destroy(handle); }

    std::vector<std::int32_t> balance(const std::vector<double>& x) {
        const rrcb_points points =
            rrcb_interleaved_points(RRCB_DOUBLE, 2, x.size() / 2, x.data(), nullptr);
        std::vector<std::int32_t> parts(points.count);
        EXPECT_EQ(rrcb_balance(handle, &points, parts.data()), RRCB_OK) << rrcb_last_error();
        return parts;
    }
};

TEST(TiltedBox, gives_all_pairs_in_c) {
    const std::vector<double> scattered = points_of(rank());
    Balancer balancer;
    const std::vector<std::int32_t> parts = balancer.balance(scattered);
    ASSERT_EQ(rrcb_plan(balancer.handle, parts.size(), parts.data()), RRCB_OK);
    rrcb_plan_lists moves;
    ASSERT_EQ(rrcb_get_plan(balancer.handle, &moves), RRCB_OK);
    std::vector<double> here(2 * moves.num_points_after);
    const rrcb_column moved{RRCB_DOUBLE, 2, scattered.data(), here.data()};
    ASSERT_EQ(rrcb_transfer(balancer.handle, 1, &moved, nullptr, nullptr), RRCB_OK);
    const rrcb_points points =
        rrcb_interleaved_points(RRCB_DOUBLE, 2, here.size() / 2, here.data(), nullptr);
    rrcb_ghost_options options{};
    options.radius = radius * stretch;
    options.lower = unit.lower.data();
    options.upper = unit.upper.data();
    rrcb_ghosts* near = nullptr;
    ASSERT_EQ(rrcb_ghosts_create(balancer.handle, &points, &options, &near), RRCB_OK);
    rrcb_ghost_plan lists;
    ASSERT_EQ(rrcb_ghosts_get_plan(near, &lists), RRCB_OK);
    std::vector<double> images(2 * lists.num_ghosts);
    const rrcb_column fetched{RRCB_DOUBLE, 2, here.data(), images.data()};
    ASSERT_EQ(rrcb_ghosts_fetch(near, 1, &fetched, nullptr, nullptr), RRCB_OK);
    const rrcb_points at =
        rrcb_interleaved_points(RRCB_DOUBLE, 2, lists.num_ghosts, images.data(), nullptr);
    ASSERT_EQ(rrcb_ghosts_apply_shifts(near, &at), RRCB_OK);
    expect_all_pairs(here, images);
    rrcb_ghosts_destroy(near);
}

TEST(PeriodicFaces, have_no_images_of_floats_inside_the_box_in_c) {
    const std::vector<float> x{0, 1, std::nextafter(1.F, 0.F), static_cast<float>(rank()) / 20};
    const Balance made = balance(interleaved_points(x, 1), {}, {}, MPI_COMM_WORLD);
    const std::vector<float> here = transfer(plan(made, MPI_COMM_WORLD), x, MPI_COMM_WORLD);
    Balancer balancer;
    std::vector<std::int32_t> parts(x.size());
    const rrcb_points all = rrcb_interleaved_points(RRCB_FLOAT, 1, x.size(), x.data(), nullptr);
    ASSERT_EQ(rrcb_balance(balancer.handle, &all, parts.data()), RRCB_OK);
    const rrcb_points points =
        rrcb_interleaved_points(RRCB_FLOAT, 1, here.size(), here.data(), nullptr);
    rrcb_ghost_options options{};
    options.radius = 0.1;
    options.lower = unit.lower.data();
    options.upper = unit.upper.data();
    rrcb_ghosts* near = nullptr;
    ASSERT_EQ(rrcb_ghosts_create(balancer.handle, &points, &options, &near), RRCB_OK)
        << rrcb_last_error();
    rrcb_ghost_plan lists;
    ASSERT_EQ(rrcb_ghosts_get_plan(near, &lists), RRCB_OK);
    std::vector<float> images(lists.num_ghosts);
    const rrcb_column fetched{RRCB_FLOAT, 1, here.data(), images.data()};
    ASSERT_EQ(rrcb_ghosts_fetch(near, 1, &fetched, nullptr, nullptr), RRCB_OK);
    const rrcb_points at =
        rrcb_interleaved_points(RRCB_FLOAT, 1, images.size(), images.data(), nullptr);
    ASSERT_EQ(rrcb_ghosts_apply_shifts(near, &at), RRCB_OK);
    for (std::size_t k = 0; k < images.size(); ++k)
        EXPECT_FALSE(lists.shifts[3 * k] != 0 && images[k] >= 0 && images[k] < 1) << images[k];
    rrcb_ghosts_destroy(near);
}

/// Nodes of a lattice, each n-th one on this rank.
std::vector<double> lattice() {
    std::vector<double> mine;
    for (int i = 0; i < 15 * 15; ++i)
        if (i % num_ranks() == rank())
            mine.insert(mine.end(), {static_cast<double>(i / 15), static_cast<double>(i % 15)});
    return mine;
}

/// Counts the points, over all ranks, outside the half-open box of their part.
template <class BoxOf>
int num_outside(const std::vector<double>& x, const std::vector<std::int32_t>& parts,
                BoxOf&& box_of_part) {
    int count = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Box box = box_of_part(parts[i]);
        for (std::size_t a = 0; a < 2; ++a) {
            const double at = x[2 * i + a];
            if (at < box.lower[a] || at >= box.upper[a]) {
                ++count;
                break;
            }
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    return count;
}

TEST(HalfOpenBoxes, contain_the_points_of_a_lattice_by_plain_cuts) {
    const std::vector<double> x = lattice();
    for (const bool plain : {false, true}) {
        Options options;
        options.axes.plain = plain;
        options.refine = Refine::exact;
        const Balance made = balance(interleaved_points(x, 2), options, {}, MPI_COMM_WORLD);
        const int outside =
            num_outside(x, made.parts, [&](Part part) { return box_of(made.cuts, part); });
        EXPECT_EQ(outside > 0, !plain && num_ranks() > 1);
    }
}

TEST(HalfOpenBoxes, contain_the_points_of_a_lattice_in_c) {
    const std::vector<double> x = lattice();
    Balancer balancer;
    ASSERT_EQ(rrcb_set(balancer.handle, "axes.plain", "ON"), RRCB_OK);
    EXPECT_EQ(num_outside(x, balancer.balance(x),
                          [&](Part part) {
                              Box box;
                              EXPECT_EQ(rrcb_box_of(balancer.handle, part, box.lower.data(),
                                                    box.upper.data()),
                                        RRCB_OK);
                              return box;
                          }),
              0);
}

}  // namespace
}  // namespace rrcb
