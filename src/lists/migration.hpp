#pragma once

#include "collective/neighbour_exchange_mpi.hpp"
#include "lists/territory.hpp"

#include <rrcb/transfer.hpp>

#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Points that leave this rank for neighbours, and their places; keeps its memory.
class Migration {
  public:
    /// Finds the leaving points. Throws Error if the owner of one is none of `ranks`.
    void find(const Points& points, const Territory& territory, std::span<const int> ranks);

    /// Returns the points that leave for a neighbour, ascending.
    std::span<const LocalIndex> leaving_to(std::size_t neighbour) const {
        return std::span(by_neighbour_)
            .subspan(first_[neighbour], first_[neighbour + 1] - first_[neighbour]);
    }

    /// Removes the points that left for the neighbours of which has_message() is true, and adds
    /// theirs. Returns whether points moved. Throws Error or std::bad_alloc; then the columns have
    /// their old lengths.
    bool apply(std::span<const detail::ByteColumn> columns, LocalIndex num_points,
               const NeighbourExchange& exchange);

  private:
    void sort(std::size_t num_neighbours);
    LocalIndex place(LocalIndex num_points, LocalIndex num_arriving);

    std::vector<LocalIndex> leaving_;       ///< ascending
    std::vector<std::size_t> neighbours_;   ///< of these
    std::vector<LocalIndex> by_neighbour_;  ///< the same points
    std::vector<LocalIndex> first_;   ///< of each neighbour in by_neighbour_, and their number
    std::vector<LocalIndex> places_;  ///< free ones, ascending
    std::vector<std::pair<LocalIndex, LocalIndex>> moves_;  ///< from the end to free places
};

}  // namespace rrcb
