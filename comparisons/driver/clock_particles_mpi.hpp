#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace comparisons {

/// A two-dimensional scene of particles between walls at x = 0, x = 1 and y = 0.
struct Scene {
    bool is_fluid = false;  ///< SPH; otherwise grains in contact
    std::int64_t num_points = 0;
    double spacing = 0;
    double reach = 0;  ///< largest distance at which two particles interact
};

/// Returns the scene splash or pile. Throws Failure for another name.
Scene scene_of(const std::string& name, std::int64_t num_points);

/// The particles of this rank, and copies of nearby particles of other ranks.
class Particles {
  public:
    /// Creates this rank's share of the scene's particles. `comm` must outlive the object.
    Particles(const Scene& scene, MPI_Comm comm);

    std::size_t size() const { return at_.size() / 2; }
    std::size_t num_ghosts() const { return values_.size() / 4 - size(); }
    double num_pairs() const;  ///< a pair with a particle of another rank counts half
    const std::vector<double>& positions() const { return at_; }

    /// Returns a row of each particle: 1, its number of pairs, and zeros. Not collective.
    std::vector<double> rows(std::size_t width) const;

    /// Sends each particle to its rank. Returns how many leave this rank. Collective.
    std::size_t move(const std::vector<int>& ranks);

    /// Finds ghosts and pairs that remain valid for `num_steps` steps. Collective; throws Failure
    /// if the particles are too fast for that.
    void make_lists(int num_steps);

    /// Advances by a step. Returns the seconds of this rank's work without communication.
    /// Collective.
    double step();

  private:
    struct Pair {
        std::size_t i;  ///< a local particle
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
    std::vector<double> values_{};  ///< positions and velocities, also of ghosts
    std::vector<std::size_t> sent_{};
    std::vector<int> send_{};  ///< number of particles sent to each rank
    std::vector<int> receive_{};
    std::vector<Pair> pairs_{};
};

}  // namespace comparisons
