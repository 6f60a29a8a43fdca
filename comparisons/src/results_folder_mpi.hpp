#pragma once

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace comparisons {

/// The folder results are written to, by rank 0; every function is collective and throws Failure
/// on every rank when the file system refuses.
class ResultsFolder {
  public:
    /// Makes the folder and, below it, data for the plots.
    ResultsFolder(const std::filesystem::path& path, MPI_Comm comm);

    /// Writes a file; `write` runs on rank 0 alone.
    void write(const std::string& name, const std::function<void(std::ostream&)>& write) const;

    /// What `write` writes on rank 0 alone, on every rank.
    std::string from_root(const std::function<void(std::ostream&)>& write) const;

    /// Lines of a file, on every rank; none when there is no such file.
    std::vector<std::string> read_lines(const std::string& name) const;

  private:
    std::filesystem::path path_;
    MPI_Comm comm_;
};

}  // namespace comparisons
