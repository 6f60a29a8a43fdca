#pragma once

#include "zoltan/norm/norm_objects.hpp"

#include <mpi.h>

#include <vector>

namespace rrcb::zoltan {

/// Search for the cut of one node across one axis, with this rank's objects that are left in it.
struct LevelSearch {
    NormSearch search;
    NormObjects::Range range;
    std::size_t length = 0;  ///< of the list of objects left
};

/// Messages of the searches of one level. The constructor asks for all memory: no rank can run out
/// of it between two messages.
class LevelMessages {
  public:
    /// Makes room for up to `most_searches` at once. Throws std::bad_alloc.
    explicit LevelMessages(std::size_t most_searches);

    /// Runs all searches to their end. Returns the number of rounds. Collective over `comm`.
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
