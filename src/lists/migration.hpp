#pragma once

#include "collective/neighbour_exchange_mpi.hpp"
#include "lists/territory.hpp"

#include <rrcb/transfer.hpp>

#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// The points that leave this rank for neighbours, and their places in the columns. Its memory is
/// reused.
class Migration {
  public:
    /// Finds the leaving points. Throws Error if the owner of a point is not one of `ranks`.
    void find(const Points& points, const Territory& territory, std::span<const int> ranks);

    /// Returns the points that leave for a neighbour, in ascending order.
    std::span<const LocalIndex> leaving_to(std::size_t neighbour) const {
        return std::span(by_neighbour_)
            .subspan(first_[neighbour], first_[neighbour + 1] - first_[neighbour]);
    }

    /// Removes the points that went to neighbours of which has_message() is true, and adds the
    /// points from them. Returns whether any point has moved. If it throws Error or std::bad_alloc,
    /// the columns have their old lengths.
    bool apply(std::span<const detail::ByteColumn> columns, LocalIndex num_points,
               const NeighbourExchange& exchange);

    /// Returns the number of points that apply() has added.
    LocalIndex num_arrived() const { return num_arrived_; }

  private:
    void sort(std::size_t num_neighbours);
    LocalIndex place(LocalIndex num_points, LocalIndex num_arriving);

    std::vector<LocalIndex> leaving_;       ///< ascending
    std::vector<std::size_t> neighbours_;   ///< destination of each leaving point
    std::vector<LocalIndex> by_neighbour_;  ///< the leaving points, sorted by neighbour
    std::vector<LocalIndex> first_;  ///< begin of each neighbour in by_neighbour_; last, the number
                                     ///< of points
    LocalIndex num_arrived_ = 0;
    std::vector<LocalIndex> places_;  ///< places of the points that left, ascending
    /// rows to move from the end into free places
    std::vector<std::pair<LocalIndex, LocalIndex>> moves_;
};

}  // namespace rrcb
