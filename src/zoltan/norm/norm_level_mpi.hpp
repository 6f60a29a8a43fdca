#pragma once

#include "zoltan/norm/norm_objects.hpp"

#include <mpi.h>

#include <vector>

namespace rrcb::zoltan {

/// The search for the cut of one node across one axis, and this rank's objects that are left in it.
struct LevelSearch {
    NormSearch search;
    NormObjects::Range range;
    std::size_t length = 0;  ///< of the list of objects left
};

/// Messages of the searches of one level; all memory is made beforehand, so that no rank can run
/// out of it between two of them.
class LevelMessages {
  public:
    /// For up to `most_searches` at once. Throws std::bad_alloc.
    explicit LevelMessages(std::size_t most_searches);

    /// Ends all searches; returns the rounds it took. Collective over `comm`.
    int run(std::span<LevelSearch> searches, NormObjects& objects, MPI_Comm comm);

    /// Adds up loads over the ranks, in place. Collective over `comm`.
    static void add_up(std::span<Load> loads, MPI_Comm comm);

  private:
    void find_ranges(std::span<LevelSearch> searches, const NormObjects& objects, MPI_Comm comm);
    void count_slots(std::span<LevelSearch> searches, NormObjects& objects, MPI_Comm comm);

    std::vector<KeyRange> ranges_;
    std::vector<std::uint32_t> counting_;  ///< numbers of the searches that count next
    std::vector<Load> slots_;
};

}  // namespace rrcb::zoltan
