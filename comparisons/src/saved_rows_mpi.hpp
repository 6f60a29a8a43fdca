#pragma once

#include "results_folder_mpi.hpp"

#include <mpi.h>

#include <functional>
#include <ostream>
#include <set>
#include <string>
#include <vector>

namespace comparisons {

/// A CSV file that grows row by row and survives an interrupted run.
///
/// The first fields of a row, its key, tell what was measured; the last field is the reason why
/// that failed. Every rank holds the same rows; all functions but `has` are collective.
class SavedRows {
  public:
    /// Takes over the rows of an earlier file with the same header and writes them again; rows
    /// that failed or were cut short are left out, so that they are measured again.
    SavedRows(const ResultsFolder& folder, std::string name, std::string header,
              std::size_t num_key_fields);

    /// Whether there is a row with this key.
    bool has(const std::string& key) const { return keys_.contains(key); }

    /// Adds the rows that `write` writes on rank 0, but those whose key is there, and saves the
    /// file. True when one of them failed.
    bool add(const std::function<void(std::ostream&)>& write);

  private:
    void add_row(const std::string& row);
    void save() const;

    const ResultsFolder& folder_;
    std::string name_;
    std::string header_;
    std::size_t num_key_fields_;
    std::vector<std::string> rows_;
    std::set<std::string> keys_;
};

}  // namespace comparisons
