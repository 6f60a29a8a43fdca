#pragma once

#include <mpi.h>
#include <mpm/decomposition.hpp>

#include <cstdint>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace mpm {

/// What a written state holds for all ranks.
struct StateHead {
    std::vector<std::string> columns;  ///< of the points
    /// Dimension, grid, number and places of points, probes, which must agree.
    std::vector<double> scene;
    std::vector<double> numbers;  ///< time and such
    std::vector<double> effects;  ///< EffectState that is the same on all ranks
    std::vector<Box> boxes;       ///< of the ranks
};

/// Takes numbers from the front of a section. Throws std::runtime_error where it has no more.
class StateSection {
  public:
    explicit StateSection(std::span<const double> numbers) : numbers_(numbers) {}

    std::span<const double> take(std::size_t count) {
        if (count > numbers_.size())
            throw std::runtime_error("the state does not hold what the scene's effects need");
        const std::span<const double> taken = numbers_.first(count);
        numbers_ = numbers_.subspan(count);
        return taken;
    }
    double next() { return take(1).front(); }
    std::span<const double> rest() const { return numbers_; }

  private:
    std::span<const double> numbers_;
};

/// A file of a state: the head, and a section of doubles for each rank that wrote it.
///
/// All functions are collective; rank 0 alone reads and writes. Failures throw std::runtime_error
/// on all ranks.
void write_state_file(const std::string& path, const StateHead& head,
                      const std::vector<double>& section, MPI_Comm comm);

/// Reads a file from its start on.
class StateReader {
  public:
    StateReader(const std::string& path, MPI_Comm comm);

    const StateHead& head() const { return head_; }
    /// The section of the next rank, on every rank. As many as the head has boxes.
    std::vector<double> next_section();

  private:
    std::vector<double> shared(std::vector<double> values);

    std::string path_;
    MPI_Comm comm_;
    std::ifstream file_;  ///< on rank 0
    StateHead head_;
};

}  // namespace mpm
