#pragma once

#include "scene/lattice.hpp"

#include <mpi.h>
#include <mpm/simulation.hpp>

#include <fstream>
#include <string>
#include <vector>

namespace mpm {

/// Position, displacement and stress of a scene's probes as a table, a row for each probe and call.
/// A probe follows a point by its number, which costs the points nothing. It ends when its point
/// leaves the domain.
class ProbeTable {
  public:
    /// Rank 0 opens the file. Collective; throws std::runtime_error on all ranks when it cannot.
    ProbeTable(const std::string& path, const Scene& scene, MPI_Comm comm);

    /// Appends the present state. Collective. Positions and displacements are in m, stresses in Pa
    /// (tension positive).
    void write(const Simulation& simulation);

  private:
    std::vector<std::string> names_;
    std::vector<NearestPoint> points_;  ///< that the probes follow
    MPI_Comm comm_;
    std::ofstream file_;  ///< on rank 0
};

}  // namespace mpm
