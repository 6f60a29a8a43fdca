#pragma once

#include "row.hpp"

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace comparisons {

/// The folder results are written to, by rank 0; every function is collective and throws Failure
/// on every rank when the file system refuses.
class ResultsFolder {
  public:
    /// Makes the folder and, below it, data for the plots.
    ResultsFolder(const std::filesystem::path& path, MPI_Comm comm);

    /// Writes a file, which never holds half of it; `text` runs on rank 0 alone.
    void write(const std::string& name, const std::function<std::string()>& text) const;

    /// What `text` makes on rank 0 alone, on every rank.
    std::string from_root(const std::function<std::string()>& text) const;

    /// Contents of a file, on every rank; nothing when there is no such file.
    std::string read(const std::string& name) const;

    /// Adds the rows that `rows` makes on rank 0 alone to a table, the first ones under their
    /// header.
    void append(const std::string& name, const std::function<std::vector<Row>()>& rows) const;

  private:
    std::filesystem::path path_;
    MPI_Comm comm_;
};

}  // namespace comparisons
