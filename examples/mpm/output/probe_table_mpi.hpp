#pragma once

#include "scene/lattice.hpp"

#include <mpi.h>
#include <mpm/simulation.hpp>

#include <fstream>
#include <string>
#include <vector>

namespace mpm {

/// Writes position, displacement and stress of a scene's probes as a table, with a row for each
/// probe and call. A probe follows a point by its number, so points need no further column. A probe
/// ends when its point leaves the domain.
class ProbeTable {
  public:
    /// Opens the file on rank 0. Collective; throws std::runtime_error on all ranks if that fails.
    ProbeTable(const std::string& path, const Scene& scene, MPI_Comm comm);

    /// Appends the current state. Collective. Positions and displacements are in m, stresses in Pa
    /// (tension is positive).
    void write(const Simulation& simulation);

  private:
    std::vector<std::string> names_;
    std::vector<NearestPoint> points_;  ///< points that the probes follow
    MPI_Comm comm_;
    std::ofstream file_;  ///< open on rank 0 only
};

}  // namespace mpm
