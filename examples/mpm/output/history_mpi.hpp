#pragma once

#include <mpi.h>
#include <mpm/simulation.hpp>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace mpm {

/// Writes the history of a simulation as a table of sums, energies and load, one row per call.
class History {
  public:
    /// Opens the file on rank 0. Collective; throws std::runtime_error on all ranks if that fails.
    History(const std::string& path, const Scene& scene, MPI_Comm comm);

    /// Appends the current state. README.md describes the columns. Collective. `front_x` is the
    /// lower side of the domain until a point has moved by a cell.
    void write(const Simulation& simulation);

  private:
    void write_head(const std::vector<std::pair<std::string, double>>& reports);

    double cell_size_;
    double lower_x_, upper_x_;
    MPI_Comm comm_;
    std::ofstream file_;  ///< open on rank 0 only
    bool has_head_ = false;
    std::int64_t num_migrated_ = 0;
};

}  // namespace mpm
