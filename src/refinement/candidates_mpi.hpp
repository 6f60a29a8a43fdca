#pragma once

#include "collective/handles.hpp"
#include "refinement/local_search.hpp"

#include <mpi.h>

#include <vector>

namespace rrcb {

/// Candidates on their way to the root: the last points between which searches may put their cuts.
///
/// Each carries the number of its search, so that a rank that has none sends one number, however
/// many searches there are. The root makes room for the points when it decides to gather them,
/// before any other rank knows.
class Candidates {
  public:
    /// Not collective. Throws Error or std::bad_alloc.
    explicit Candidates(int dimension);

    /// Makes room at the root for `num_points` points of all ranks.
    void expect(GlobalCount num_points, int num_ranks);

    void clear();

    /// Adds what is left to search number `list` here. Throws std::bad_alloc; then mark_failed() is
    /// due.
    void add(std::size_t list, const LocalSearch& search);

    /// Tells that this rank has failed, in place of its candidates.
    void mark_failed();

    /// Gathers the candidates of all ranks at the root. Collective over `comm`.
    void gather(int root, MPI_Comm comm);

    /// True when a rank has failed that took part in the last gather; at the root only.
    bool any_failed() const { return any_failed_; }

    /// The records of each search in the order of the ranks; at the root only.
    std::vector<std::vector<double>> lists(std::size_t num_lists) const;

  private:
    std::size_t record_length_;
    mpi::ContiguousType record_;
    bool failed_ = false;
    std::vector<double> records_;      ///< number of the search, position, weight
    std::vector<double> all_records_;  ///< of all ranks, as is all below; at the root only
    std::vector<int> counts_;
    std::vector<int> offsets_;
    bool any_failed_ = false;
};

}  // namespace rrcb
