#pragma once

#include <mpi.h>
#include <mpm/simulation.hpp>

#include <fstream>
#include <string>
#include <vector>

namespace mpm {

/// Position, displacement, stress and strain of a scene's probes as a table, a row for each probe
/// and call.
class ProbeTable {
  public:
    /// Rank 0 opens the file. Collective; throws std::runtime_error on all ranks when it cannot.
    ProbeTable(const std::string& path, const Scene& scene, MPI_Comm comm);

    /// Appends the present state. Collective. Positions and displacements are in m, stresses in Pa
    /// (tension positive), strains are those of add_probes; what two dimensions have not is 0.
    void write(const Simulation& simulation);

  private:
    std::vector<Probe> probes_;
    std::vector<Vector> starts_;  ///< of the points that they follow
    MPI_Comm comm_;
    std::ofstream file_;  ///< on rank 0
};

}  // namespace mpm
