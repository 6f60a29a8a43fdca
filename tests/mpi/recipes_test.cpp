// What docs/loop.md and docs/choosing.md advise: boxes that are tilted, points in half-open boxes,
// and a least number of points of a part.
#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/rrcb.hpp>

namespace rrcb {
namespace {

constexpr Box unit{{0, 0, 0}, {1, 1, 1}};

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
    const Balance made = balance(Points(scattered, 3), MPI_COMM_WORLD);
    const std::vector<double> here =
        transfer(plan(made, MPI_COMM_WORLD), column(scattered, 3), MPI_COMM_WORLD);
    const GhostPlan near = ghost_plan(made.cuts, Points(here, 3), MPI_COMM_WORLD,
                                      {.cutoff = reach * box.norm_of_inverse(), .periodic = unit});
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
    const double one = 0.3;
    EXPECT_NEAR((TiltedBox{one, 0, 0}.norm_of_inverse()), (one + std::hypot(one, 2)) / 2, 1e-12);
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
int num_outside(const std::vector<double>& x, const Balance& made) {
    int count = 0;
    for (std::size_t i = 0; i < made.parts.size(); ++i) {
        const Box box = box_of(made.cuts, made.parts[i]);
        bool is_inside = true;
        for (std::size_t a = 0; a < 2; ++a)
            is_inside = is_inside && x[2 * i + a] >= box.lower[a] && x[2 * i + a] < box.upper[a];
        count += is_inside ? 0 : 1;
    }
    MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    return count;
}

TEST(HalfOpenBoxes, contain_the_points_of_a_lattice_by_plain_cuts) {
    const std::vector<double> x = lattice();
    for (const bool plain : {false, true}) {
        Options options{.refine = Refine::exact, .expert = {.axes = {.plain = plain}}};
        const Balance made = balance(Points(x, 2), MPI_COMM_WORLD, options);
        EXPECT_EQ(num_outside(x, made) > 0, !plain && num_ranks() > 1);
    }
}

TEST(LeastNumberOfPoints, is_reached_by_parts_of_size_0) {
    constexpr int num_parts = 16, min_points = 10;
    for (const int n : {1, 9, 39, 40, 41, 200}) {
        const std::vector<double> all = test::uniform_cloud(static_cast<std::size_t>(n), 2, 7);
        std::vector<double> x;
        for (std::size_t i = 0; i < all.size(); i += 2)
            if (static_cast<int>(i / 2) % num_ranks() == rank())
                x.insert(x.end(), {all[i], all[i + 1]});
        Options options{.num_parts = num_parts, .refine = Refine::exact};
        options.part_sizes.assign(num_parts, 0);
        const int num_filled = std::clamp(n / min_points, 1, num_parts);
        std::fill_n(options.part_sizes.begin(), num_filled, 1);
        const Balance made = balance(Points(x, 2), MPI_COMM_WORLD, options);
        const std::vector<double>& counts = made.report.part_weights;
        EXPECT_EQ(std::reduce(counts.begin(), counts.begin() + num_filled), n);
        EXPECT_GE(*std::min_element(counts.begin(), counts.begin() + num_filled),
                  std::min(n, min_points));
    }
}

}  // namespace
}  // namespace rrcb
