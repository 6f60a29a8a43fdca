#pragma once

#include <mpi.h>
#include <mpm/decomposition.hpp>
#include <mpm/particles.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace comparisons {

/// Points that move step by step and go to the rank that a balancer gives them to.
///
/// All functions but those that are const are collective over the communicator they were made with,
/// which must outlive them. The points lie in slabs of equal width at first.
class MovingPoints {
  public:
    virtual ~MovingPoints() = default;
    virtual void step() = 0;
    virtual void rebalance(const mpm::Balancer& balancer) = 0;
    virtual int num_steps() const = 0;

    /// Of this rank, with a column "id": numbers from 0 on over all ranks.
    virtual const mpm::Particles& particles() const = 0;
    virtual mpm::Positions positions() const = 0;
    virtual const mpm::Decomposition& decomposition() const = 0;
};

/// A scene of the comparisons, or granular_column in cells half as large as its file's; coarse if
/// `quick`. Collective. Throws Failure and what the simulation throws.
std::unique_ptr<MovingPoints> scene_points(const std::string& scene, bool quick, MPI_Comm comm);

/// Half of the points stand still all over a square of 100 m, the others are a cluster, normal with
/// 4 m, that moves `speed` metres in a step on a circle of 30 m.
struct DriftingCloud {
    int num_points = 50'000;
    int num_steps = 1000;
    double speed = 0.1;
};

/// Such clouds at three speeds, and their names; small ones if `quick`.
std::vector<std::pair<std::string, DriftingCloud>> drifting_clouds(bool quick);

/// The points of the cloud, each with 24 columns. Collective.
std::unique_ptr<MovingPoints> cloud_points(const DriftingCloud& cloud, MPI_Comm comm);

}  // namespace comparisons
