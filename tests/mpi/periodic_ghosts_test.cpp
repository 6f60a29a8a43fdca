#include "../support/distance.hpp"
#include "held_points.hpp"
#include "slabs.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/experimental/verify.hpp>
#include <rrcb/ghosts.hpp>

namespace rrcb {
namespace {

using test::distance;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A cloud in [-1, 0.5] along each axis that every rank knows, and the points of this rank.
struct Scene {
    int dimension;
    Box box{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
    std::vector<double> positions{};
    Cuts cuts{};
    std::vector<int> mine{};
    std::vector<double> here{};

    int count() const { return static_cast<int>(positions.size()) / dimension; }

    Vector image(int i, const Shift& shift) const {
        Vector x = Points(positions, dimension).position(static_cast<LocalIndex>(i));
        for (std::size_t a = 0; a < 3; ++a)
            if (shift[a] != 0) x[a] += shift[a] * 1.5;
        return x;
    }

    /// The same, but never in the box along an axis that it is shifted along.
    Vector image_outside(int i, const Shift& shift) const {
        Vector x = image(i, shift);
        for (std::size_t a = 0; a < 3; ++a) {
            if (shift[a] > 0) x[a] = std::max(x[a], box.upper[a]);
            if (shift[a] < 0) x[a] = std::min(x[a], std::nextafter(box.lower[a], -infinity));
        }
        return x;
    }

    /// Shifts by up to three periods along the axes that have some.
    std::vector<Shift> shifts() const {
        std::vector<Shift> all{Shift{}};
        for (std::size_t a = 0; a < 3; ++a) {
            if (box.lower[a] == -infinity) continue;
            std::vector<Shift> more;
            for (const Shift& shift : all)
                for (int k = -3; k <= 3; ++k) {
                    more.push_back(shift);
                    more.back()[a] = k;
                }
            all = more;
        }
        return all;
    }
};

/// Bit a of `axes` is set for the periodic ones.
Scene make_scene(int dimension, unsigned axes, int num_parts) {
    Scene scene{dimension};
    scene.positions = test::uniform_cloud(50, dimension, 9);
    for (double& x : scene.positions) x = 1.5 * x - 1;
    // Some at the ends of the box, and in its corner.
    scene.positions[0] = -1;
    for (std::size_t k = 1; k <= static_cast<std::size_t>(dimension); ++k) scene.positions[k] = 0.5;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
        if ((axes >> a & 1) != 0)
            std::tie(scene.box.lower[a], scene.box.upper[a]) = std::pair(-1., .5);
    test::HeldPoints all{dimension, scene.positions};
    scene.cuts = test::divide_on_each_rank(all, num_parts).cuts;
    const test::Share mine(all);
    scene.mine.assign(mine.indices.begin(), mine.indices.end());
    scene.here = mine.coordinates;
    return scene;
}

/// Distance to the regions of this rank in the box.
long double distance_to_mine(const Scene& scene, const Vector& x) {
    long double least = infinity;
    for (Part part = 0; part < scene.cuts.num_parts; ++part) {
        const RankRange ranks = ranks_of_part(part, scene.cuts.num_parts, num_ranks());
        if (rank() < ranks.first_rank || rank() >= ranks.first_rank + ranks.count) continue;
        Box region = box_of(scene.cuts, part);
        for (std::size_t a = 0; a < 3; ++a) {
            region.lower[a] = std::max(region.lower[a], scene.box.lower[a]);
            region.upper[a] = std::min(region.upper[a], scene.box.upper[a]);
        }
        least = std::min(least, distance(x, region, scene.dimension));
    }
    return least;
}

/// Compares ghosts with the regions and with all pairs of points and images; counts neighbours on
/// their ghosts and adds them up.
void expect_ghosts(const Scene& scene, double radius) {
    const GhostOptions options{.cutoff = radius, .periodic = scene.box};
    const GhostPlan plan =
        ghost_plan(scene.cuts, Points(scene.here, scene.dimension), MPI_COMM_WORLD, options);
    auto [numbers, positions] = fetch(
        plan, columns(scene.mine, column(scene.here, static_cast<std::size_t>(scene.dimension))),
        MPI_COMM_WORLD);
    apply_shifts(plan, positions);
    EXPECT_EQ(experimental::verify(plan, Points(scene.here, scene.dimension), MPI_COMM_WORLD,
                                   {.sample = 20})
                  .num_faults,
              0);
    ASSERT_EQ(plan.shifts.size(), numbers.size());
    std::map<std::pair<int, Shift>, int> found;
    std::vector<int> near_ghosts(numbers.size());
    const Points moved(positions, scene.dimension);
    const auto is_pair = [&](const Vector& x, int i) {
        const Vector y = scene.image(i, {});
        return distance(x, Box{y, y}, scene.dimension) <= radius;
    };
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        ++found[{numbers[k], plan.shifts[k]}];
        const Vector x = moved.position(k);
        EXPECT_EQ(x, scene.image_outside(numbers[k], plan.shifts[k]));
        for (const int i : scene.mine) near_ghosts[k] += is_pair(x, i) ? 1 : 0;
    }
    std::vector<int> near(scene.mine.size());
    std::vector<int> expected(scene.mine.size());
    for (std::size_t k = 0; k < scene.mine.size(); ++k)
        for (const int i : scene.mine)
            near[k] += is_pair(scene.image(scene.mine[k], {}), i) ? 1 : 0;
    for (const Shift& shift : scene.shifts()) {
        for (int j = 0; j < scene.count(); ++j) {
            const Vector x = scene.image(j, shift);
            const bool is_mine = shift == Shift{} && std::ranges::count(scene.mine, j) > 0;
            const long double apart = distance_to_mine(scene, x);
            const auto entry = found.find({j, shift});
            const int count = entry == found.end() ? 0 : entry->second;
            if (is_mine || apart > radius * (1 + 4e-15L)) {
                EXPECT_EQ(count, 0);
            } else if (apart <= radius) {
                EXPECT_EQ(count, 1);
            }
            for (const int i : scene.mine)
                EXPECT_TRUE(is_mine || count == 1 || !is_pair(x, i)) << i << " " << j;
        }
        for (std::size_t k = 0; k < scene.mine.size(); ++k)
            for (int i = 0; i < scene.count(); ++i)
                expected[k] += is_pair(scene.image_outside(scene.mine[k], shift), i) ? 1 : 0;
    }
    EXPECT_EQ(accumulate(plan, near_ghosts, near, MPI_COMM_WORLD), expected);
}

TEST(PeriodicGhosts, are_all_images_near_a_region) {
    for (int dimension = 1; dimension <= 3; ++dimension)
        for (unsigned axes = 0; axes < 1u << dimension; ++axes) {
            const Scene scene = make_scene(dimension, axes, num_ranks());
            for (const double radius : {0.0, 0.2, 0.75, 0.9, 2.0}) expect_ghosts(scene, radius);
        }
}

TEST(PeriodicGhosts, go_to_ranks_with_several_parts_and_to_those_that_share_one) {
    for (const int num_parts : {2 * num_ranks() + 1, (num_ranks() + 1) / 2})
        expect_ghosts(make_scene(2, 3, num_parts), 0.8);
}

TEST(PeriodicGhosts, of_floats_are_moved_to_images) {
    const std::vector<float> x(1, 0.25f * static_cast<float>(rank() + 1));
    const float end = 0.25f * static_cast<float>(num_ranks() + 1);
    const Box box{{0}, {end}};
    const Balance all = balance(Points(x, 1), MPI_COMM_WORLD);
    const GhostPlan plan =
        ghost_plan(all.cuts, Points(x, 1), MPI_COMM_WORLD, {.cutoff = end, .periodic = box});
    const std::vector<float> fetched = fetch(plan, x, MPI_COMM_WORLD);
    std::vector<float> positions = fetched;
    apply_shifts(plan, positions);
    ASSERT_FALSE(positions.empty());
    for (std::size_t k = 0; k < positions.size(); ++k)
        EXPECT_EQ(positions[k], fetched[k] + static_cast<float>(plan.shifts[k][0]) * end);
}

/// Points at the ends of a box, just inside them, and between; each rank has some.
template <class T>
std::vector<T> at_the_ends_of(const Box& box) {
    const auto lower = static_cast<T>(box.lower[0]);
    const auto upper = static_cast<T>(box.upper[0]);
    const auto wrapped = static_cast<T>(lower - T(1e-9) + (upper - lower));
    std::vector<T> all{std::max(lower, std::nextafter(lower, upper)), std::nextafter(upper, lower),
                       wrapped};
    for (const T end : {lower, upper})
        if (end >= box.lower[0] && end <= box.upper[0]) all.push_back(end);
    for (int k = 1; k < 40; ++k)
        all.push_back(lower + (upper - lower) * static_cast<T>(k * k % 97) / 97);
    std::vector<T> mine;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i] <= box.upper[0] && static_cast<int>(i) % num_ranks() == rank())
            mine.push_back(all[i]);
    return mine;
}

TEST(PeriodicGhosts, move_as_members_of_structs) {
    struct Particle {
        float mass;
        std::array<float, 2> position;
        float x, y;
    };
    const Box box{{0, 0, 0}, {1, 1, 0}};
    const std::vector<double> cloud =
        test::uniform_cloud(100, 2, 3 + static_cast<unsigned>(rank()));
    const Balance made = balance(Points(cloud, 2), MPI_COMM_WORLD);
    const std::vector<double> here =
        transfer(plan(made, MPI_COMM_WORLD), column(cloud, 2), MPI_COMM_WORLD);
    const GhostPlan near =
        ghost_plan(made.cuts, Points(here, 2), MPI_COMM_WORLD, {.cutoff = 0.1, .periodic = box});
    std::vector<Particle> particles;
    std::vector<float> floats(here.begin(), here.end());
    for (std::size_t i = 0; i < floats.size(); i += 2)
        particles.push_back({1, {floats[i], floats[i + 1]}, floats[i], floats[i + 1]});
    std::vector<float> images = fetch(near, column(floats, 2), MPI_COMM_WORLD);
    std::vector<Particle> copies = fetch(near, particles, MPI_COMM_WORLD);
    apply_shifts(near, images);
    apply_shifts(near, copies, &Particle::position);
    apply_shifts(near, copies, &Particle::x, &Particle::y);
    for (std::size_t k = 0; k < copies.size(); ++k) {
        EXPECT_EQ(copies[k].position, (std::array{images[2 * k], images[2 * k + 1]}));
        EXPECT_EQ(copies[k].x, images[2 * k]);
        EXPECT_EQ(copies[k].y, images[2 * k + 1]);
        EXPECT_EQ(copies[k].mass, 1);
    }
    copies.emplace_back();
    EXPECT_THROW(apply_shifts(near, copies, &Particle::position), Error);
}

/// Expects each pair within 0.03 over the faces of the box, and no image in it.
template <class T>
void expect_images_outside(const Box& box) {
    const std::vector<T> scattered = at_the_ends_of<T>(box);
    const Balance made = balance(Points(scattered, 1), MPI_COMM_WORLD);
    const std::vector<T> x = transfer(plan(made, MPI_COMM_WORLD), scattered, MPI_COMM_WORLD);
    const GhostPlan near =
        ghost_plan(made.cuts, Points(x, 1), MPI_COMM_WORLD, {.cutoff = 0.03, .periodic = box});
    EXPECT_EQ(experimental::verify(near, Points(x, 1), MPI_COMM_WORLD).num_faults, 0);
    std::vector<T> images = fetch(near, x, MPI_COMM_WORLD);
    apply_shifts(near, images);
    for (std::size_t k = 0; k < images.size(); ++k) {
        const bool is_in = images[k] >= box.lower[0] && images[k] < box.upper[0];
        EXPECT_FALSE(near.shifts[k] != Shift{} && is_in) << images[k];
    }
    const std::vector<T> all = [&] {
        const std::vector<Part> to_first(x.size(), 0);
        std::vector<T> gathered =
            transfer(plan(to_first, num_ranks(), MPI_COMM_WORLD), x, MPI_COMM_WORLD);
        std::size_t count = gathered.size();
        MPI_Bcast(&count, sizeof count, MPI_BYTE, 0, MPI_COMM_WORLD);
        gathered.resize(count);
        MPI_Bcast(gathered.data(), static_cast<int>(count * sizeof(T)), MPI_BYTE, 0,
                  MPI_COMM_WORLD);
        return gathered;
    }();
    images.insert(images.end(), x.begin(), x.end());
    const double period = box.upper[0] - box.lower[0];
    for (const T i : x) {
        const auto is_near = [&](T j) { return std::abs(double{j} - double{i}) <= 0.03; };
        const auto is_near_in_box = [&](T j) {
            const double apart = std::abs(double{j} - double{i});
            return std::min(apart, period - apart) <= 0.03;
        };
        EXPECT_EQ(std::ranges::count_if(images, is_near),
                  std::ranges::count_if(all, is_near_in_box))
            << i;
    }
}

TEST(PeriodicGhosts, follow_points_that_leave_the_box) {
    GhostPlan plan;
    plan.periodic = Box{{0}, {1}};
    plan.shifts = {Shift{-1, 0, 0}, Shift{1, 0, 0}, Shift{-1, 0, 0}};
    std::vector<double> positions{1.25, -0.25, 1};
    apply_shifts(plan, positions);
    EXPECT_EQ(positions, (std::vector{0.25, 0.75, std::nextafter(0, -1)}));
}

TEST(PeriodicGhosts, at_the_faces_of_the_box_are_met_once_and_never_inside) {
    for (const Box& box : {Box{{0}, {1}}, Box{{0.1}, {0.7}}, Box{{-0.1}, {0.2}}, Box{{-1}, {0}}}) {
        expect_images_outside<double>(box);
        expect_images_outside<float>(box);
    }
}

TEST(PeriodicGhosts, in_no_usable_box_are_refused_on_all_ranks) {
    const std::vector<double> x{0.25, 0};
    const Scene scene = make_scene(2, 1, 1);
    const auto refused = [&](const std::string& text, double radius, double lower, double upper) {
        GhostOptions options{.cutoff = radius, .periodic = scene.box};
        if (is_last_rank()) {
            options.periodic->lower[0] = lower;
            options.periodic->upper[0] = upper;
        }
        try {
            ghost_plan(test::slabs(), Points(x, 2), MPI_COMM_WORLD, options);
            EXPECT_TRUE(text.empty());
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
            EXPECT_FALSE(text.empty()) << error.what();
        }
    };
    refused("", 0.1, -1, 0.5);
    refused("two finite ends", 0.1, -1, infinity);
    refused("two finite ends", 0.1, -infinity, 0.5);
    refused("two finite ends", 0.1, 0.5, -1);
    refused("two finite ends", 0.1, -1e308, 1e308);
    refused("coordinate 0.25 of point 0 on axis 0 is outside the periodic box, -1 to 0", 0.1, -1,
            0);
    refused("a cutoff must be at most 100 periods", 151, -1, 0.5);
    if (num_ranks() > 1) refused("the periodic box differs between rank 0", 0.1, -1, 0.75);
}

}  // namespace
}  // namespace rrcb
