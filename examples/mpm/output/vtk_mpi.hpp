#pragma once

#include <mpi.h>
#include <mpm/simulation.hpp>

#include <string>
#include <utility>
#include <vector>

namespace mpm {

/// Writes a series of files for ParaView. points.pvd refers to the material points with all their
/// columns, displacements and ranks, boxes.pvd to the boxes of the ranks.
///
/// Every rank writes its points (VTP). Rank 0 writes the other files (VTU, PVD).
class VtkSeries {
  public:
    VtkSeries(std::string folder, const Scene& scene, MPI_Comm comm);

    /// Adds the current state. Collective; throws std::runtime_error on all ranks if a file cannot
    /// be written.
    void write(const Simulation& simulation);

  private:
    bool write_series(const std::string& name, const std::string& extension, int num_pieces) const;

    std::string folder_;
    GridShape grid_;
    int dimension_;
    MPI_Comm comm_;
    int rank_, num_ranks_;
    /// time and number of each output
    std::vector<std::pair<double, std::string>> frames_;
};

}  // namespace mpm
