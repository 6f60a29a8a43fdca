#pragma once

#include <mpi.h>
#include <mpm/simulation.hpp>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace mpm {

/// The history of a simulation as a table: sums, energies and load, one row per call.
class History {
  public:
    /// Rank 0 opens the file. Collective; throws std::runtime_error on all ranks when it cannot.
    History(const std::string& path, const Scene& scene, MPI_Comm comm);

    /// Appends the present state, with the columns that README.md lists. Collective. While no point
    /// has moved by a cell, `front_x` is the lower side of the domain.
    void write(const Simulation& simulation);

  private:
    void write_head(const std::vector<std::pair<std::string, double>>& reports);

    double cell_size_;
    double lower_x_, upper_x_;
    MPI_Comm comm_;
    std::ofstream file_;  ///< on rank 0
    bool has_head_ = false;
    std::int64_t num_migrated_ = 0;
};

}  // namespace mpm
