#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace comparisons {

/// Particles in 2-D between walls at x = 0, x = 1 and y = 0.
struct Scene {
    bool is_fluid = false;  ///< SPH; otherwise grains that touch
    std::int64_t num_points = 0;
    double spacing = 0;
    double reach = 0;  ///< of two particles
};

/// splash or pile; throws Failure for another name.
Scene scene_of(const std::string& name, std::int64_t num_points);

/// Particles of this rank, and copies of others near them.
class Particles {
  public:
    /// Makes this rank's share. `comm` must outlive it.
    Particles(const Scene& scene, MPI_Comm comm);

    std::size_t size() const { return at_.size() / 2; }
    std::size_t num_ghosts() const { return values_.size() / 4 - size(); }
    double num_pairs() const;  ///< half of one with another local particle
    const std::vector<double>& positions() const { return at_; }

    /// 1, pairs and zeros of each particle. Not collective.
    std::vector<double> rows(std::size_t width) const;

    /// Moves each particle to its rank; returns how many leave this one. Collective.
    std::size_t move(const std::vector<int>& ranks);

    /// Finds ghosts and pairs that suffice for so many steps. Collective; throws Failure if
    /// particles are too fast for that.
    void make_lists(int num_steps);

    /// Returns the seconds of this rank's own work. Collective.
    double step();

  private:
    struct Pair {
        std::size_t i;  ///< local
        std::size_t j;
    };
    void find_ghosts();
    void find_pairs();
    void fetch(std::vector<double>& values, std::size_t width) const;
    void push(std::vector<double>& forces, const std::vector<double>& densities) const;
    void go_on(const std::vector<double>& forces);

    Scene scene_;
    MPI_Comm comm_;
    std::vector<double> at_{};
    std::vector<double> velocities_{};
    std::vector<double> values_{};  ///< position and velocity, also of ghosts
    std::vector<std::size_t> sent_{};
    std::vector<int> send_{};  ///< numbers for each rank
    std::vector<int> receive_{};
    std::vector<Pair> pairs_{};
};

}  // namespace comparisons
