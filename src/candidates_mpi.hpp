#pragma once

#include "cut_search.hpp"
#include "mpi/handles.hpp"

#include <mpi.h>

#include <span>
#include <vector>

namespace rrcb {

/// The last points between which searches may still put their cuts, on their way to the root.
///
/// Lengths are made room for before the first round; the root makes room for the points when it
/// decides that they are to be gathered, before anybody else knows.
class Candidates {
  public:
    /// For `most` searches at once. Not collective. Throws Error or std::bad_alloc.
    Candidates(int dimension, std::size_t most);

    /// Makes room at the root for `num_lists` lists of all ranks, `num_points` points in all.
    void expect(std::size_t num_lists, GlobalCount num_points, int num_ranks);

    void clear();

    /// One more list: what is left to one search here. Throws std::bad_alloc; then lose() is due.
    void add(const LocalSearch& search);

    /// In place of `num_lists` lists that this rank can't make.
    void lose(std::size_t num_lists);

    std::size_t num_lists() const { return lengths_.size(); }

    /// Gathers the lists of all ranks, as many on each, at the root. Collective over `comm`.
    void gather(int root, MPI_Comm comm);

    /// True when a rank lost its lists; at the root only.
    bool any_failed() const;

    /// The records of each list in the order of the ranks; at the root only.
    std::vector<std::vector<double>> lists() const;

  private:
    static constexpr int lost = -1;

    std::size_t record_length_;
    mpi::ContiguousType record_;
    std::vector<int> lengths_;      ///< in records
    std::vector<double> records_;   ///< one list after the other
    std::vector<int> all_lengths_;  ///< of all ranks, as is all below; at the root only
    std::vector<double> all_records_;
    std::vector<int> counts_;
    std::vector<int> offsets_;
};

}  // namespace rrcb
