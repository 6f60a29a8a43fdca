#pragma once

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <string>

namespace comparisons {

/// The folder results are written to, by rank 0; every function is collective and throws Failure
/// on every rank when the file system refuses.
class ResultsFolder {
  public:
    /// Makes the folder and, below it, data for the plots.
    ResultsFolder(const std::filesystem::path& path, MPI_Comm comm);

    /// Writes a file, which never holds half of it; `text` runs on rank 0 alone.
    void write(const std::string& name, const std::function<std::string()>& text) const;

  private:
    std::filesystem::path path_;
    MPI_Comm comm_;
};

}  // namespace comparisons
