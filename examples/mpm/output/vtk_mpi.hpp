#pragma once

#include <mpi.h>
#include <mpm/simulation.hpp>

#include <string>
#include <utility>
#include <vector>

namespace mpm {

/// Series of files that ParaView opens: points.pvd has the material points with all their columns,
/// displacement and rank, boxes.pvd the boxes of the ranks.
///
/// Every rank writes its points (VTP), rank 0 all else (VTU, PVD).
class VtkSeries {
  public:
    VtkSeries(std::string folder, const Scene& scene, MPI_Comm comm);

    /// Adds the present state. Collective; throws std::runtime_error on all ranks when a file
    /// cannot be written.
    void write(const Simulation& simulation);

  private:
    bool write_series(const std::string& name, const std::string& extension, int num_pieces) const;

    std::string folder_;
    GridShape grid_;
    int dimension_;
    MPI_Comm comm_;
    int rank_, num_ranks_;
    std::vector<std::pair<double, std::string>> frames_;  ///< time and number of each
};

}  // namespace mpm
