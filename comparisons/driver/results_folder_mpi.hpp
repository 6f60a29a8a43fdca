#pragma once

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <string>

namespace comparisons {

/// The folder into which rank 0 writes results. Every function is collective, and throws Failure on
/// every rank if the file system reports an error.
class ResultsFolder {
  public:
    /// Creates the folder, and in it the folder data for the plots.
    ResultsFolder(const std::filesystem::path& path, MPI_Comm comm);

    /// Writes a file, which is never visible incomplete. `text` is called on rank 0 only.
    void write(const std::string& name, const std::function<std::string()>& text) const;

  private:
    std::filesystem::path path_;
    MPI_Comm comm_;
};

}  // namespace comparisons
