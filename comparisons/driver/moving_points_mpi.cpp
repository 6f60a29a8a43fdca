#include "moving_points_mpi.hpp"

#include "counter_random.hpp"
#include "parallel/ownership_mpi.hpp"
#include "scene_choice_mpi.hpp"
#include "scene_file/scene_file_mpi.hpp"
#include "simulation_mpi.hpp"

#include <mpm/simulation.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace comparisons {

namespace {

mpm::Scene choose(const std::string& name, bool quick, MPI_Comm comm) {
    if (name != "granular_column") return choose_scene(name, quick, comm);
    mpm::Scene scene = choose_scene(RRCB_SCENES "/granular_column.yaml", false, comm);
    // Its file has too few points to share out.
    if (!quick) mpm::resize_cells(scene, scene.grid.spacing / 2);
    return scene;
}

class ScenePoints : public MovingPoints {
  public:
    ScenePoints(const mpm::Scene& scene, MPI_Comm comm)
        : simulation_(scene, comm), num_steps_(steps_to_end(scene, comm)) {}

    void step() override { simulation_.step(); }
    void rebalance(const mpm::Balancer& balancer) override { simulation_.rebalance(balancer); }
    int num_steps() const override { return num_steps_; }
    const mpm::Particles& particles() const override { return simulation_.particles(); }
    mpm::Positions positions() const override { return simulation_.positions(); }
    const mpm::Decomposition& decomposition() const override { return simulation_.decomposition(); }

  private:
    mpm::Simulation simulation_;
    int num_steps_;
};

constexpr double side = 100;        // m
constexpr double path_radius = 30;  // m
constexpr double width = 4;         // m

/// They make 24 with those of the motion, about twice as many as a point of the slope has.
constexpr int num_other_columns = 14;

mpm::GridShape square() {
    return {{0, 0, 0}, side, {1, 1, 1}};
}

/// Where the cluster's middle is once it has moved so far.
std::array<double, 2> middle_after(double distance) {
    const double angle = distance / path_radius;
    return {side / 2 + path_radius * std::cos(angle), side / 2 + path_radius * std::sin(angle)};
}

/// From the middle of the cluster; Box and Muller's, and never farther than the square reaches.
std::array<double, 2> place_in_cluster(CounterRandom& random) {
    const double farthest = side / 2 - path_radius;
    const double radius = width * std::sqrt(-2 * std::log(1 - random.uniform()));
    const double angle = 2 * std::numbers::pi * random.uniform();
    const double kept = std::min(radius, 0.99 * farthest);
    return {kept * std::cos(angle), kept * std::sin(angle)};
}

class CloudPoints : public MovingPoints {
  public:
    CloudPoints(const DriftingCloud& cloud, MPI_Comm comm)
        : cloud_(cloud),
          comm_(comm),
          motion_(mpm::add_motion_columns(particles_, 2)),
          ownership_(square(), comm) {
        is_moving_ = particles_.add_column("is_moving");
        for (int i = 0; i < num_other_columns; ++i) {
            particles_.add_column("other_" + std::to_string(i));
        }
        int rank = 0;
        int num_ranks = 1;
        MPI_Comm_rank(comm, &rank);
        MPI_Comm_size(comm, &num_ranks);
        decomposition_ = mpm::slabs({{0, 0, 0}, {side, side, 0}}, num_ranks);
        for (int id = 0; id < cloud.num_points; ++id) place(id, rank);
    }

    void step() override {
        const std::array<double, 2> before = middle_after(cloud_.speed * steps_done_);
        const std::array<double, 2> after = middle_after(cloud_.speed * ++steps_done_);
        const std::span<const double> is_moving = particles_[is_moving_];
        for (std::size_t axis = 0; axis < 2; ++axis) {
            double* at = particles_.data(motion_.position[axis]);
            for (std::size_t i = 0; i < particles_.size(); ++i) {
                at[i] += is_moving[i] * (after[axis] - before[axis]);
            }
        }
        ownership_.find_leavers(decomposition_, positions(), particles_[motion_.id], steps_done_,
                                {});
        migrate();
    }

    void rebalance(const mpm::Balancer& balancer) override {
        decomposition_ = balancer(positions(), comm_);
        ownership_.find_reassigned(decomposition_, positions());
        migrate();
    }

    int num_steps() const override { return cloud_.num_steps; }
    const mpm::Particles& particles() const override { return particles_; }
    mpm::Positions positions() const override { return mpm::positions_of(particles_, motion_, 2); }
    const mpm::Decomposition& decomposition() const override { return decomposition_; }

  private:
    /// Appends the point where it is this rank's.
    void place(int id, int rank) {
        CounterRandom random(1, static_cast<std::uint64_t>(id));
        const bool is_moving = id % 2 == 1;
        std::array<double, 2> at = {random.uniform(0, side), random.uniform(0, side)};
        if (is_moving) {
            const std::array<double, 2> offset = place_in_cluster(random);
            const std::array<double, 2> middle = middle_after(0);
            at = {middle[0] + offset[0], middle[1] + offset[1]};
        }
        int owner = 0;
        decomposition_.owners({std::span(&at[0], 1), std::span(&at[1], 1)}, std::span(&owner, 1));
        if (owner != rank) return;
        std::vector<double> row = particles_.initial_row();
        row[motion_.position[0]] = at[0];
        row[motion_.position[1]] = at[1];
        row[motion_.id] = id;
        row[is_moving_] = is_moving ? 1 : 0;
        particles_.append(row);
    }

    void migrate() {
        const mpm::Agreement agreement = ownership_.agree(0);
        mpm::migrate(particles_, ownership_.leavers(), agreement.reach, {}, comm_);
    }

    DriftingCloud cloud_;
    MPI_Comm comm_;
    mpm::Particles particles_;
    mpm::MotionColumns motion_;
    mpm::Column is_moving_ = 0;
    mpm::Ownership ownership_;
    mpm::Decomposition decomposition_;
    int steps_done_ = 0;
};

}  // namespace

std::unique_ptr<MovingPoints> scene_points(const std::string& scene, bool quick, MPI_Comm comm) {
    return std::make_unique<ScenePoints>(choose(scene, quick, comm), comm);
}

std::vector<std::pair<std::string, DriftingCloud>> drifting_clouds(bool quick) {
    std::vector<std::pair<std::string, DriftingCloud>> clouds = {{"cloud, slow", {.speed = 0.002}},
                                                                 {"cloud, faster", {.speed = 0.02}},
                                                                 {"cloud, fast", {.speed = 0.2}}};
    for (auto& [name, cloud] : clouds)
        if (quick) cloud = {2000, 100, cloud.speed};
    return clouds;
}

std::unique_ptr<MovingPoints> cloud_points(const DriftingCloud& cloud, MPI_Comm comm) {
    return std::make_unique<CloudPoints>(cloud, comm);
}

}  // namespace comparisons
