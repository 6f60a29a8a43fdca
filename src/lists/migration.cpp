#include "lists/migration.hpp"

#include "lists/message_rows.hpp"
#include "options/rejection.hpp"

#include <algorithm>
#include <string>

namespace rrcb {

using detail::ByteColumn;

void Migration::find(const Points& points, const Territory& territory, std::span<const int> ranks) {
    leaving_.clear();
    neighbours_.clear();
    territory.for_each_outside(points, [&](LocalIndex i) {
        territory.check_position(points, i);
        const int owner = territory.owner_of(points.position(i));
        if (owner == territory.rank()) return;
        if (owner < 0)
            reject(territory.name_of(points, i) +
                   " is in none of the boxes; give boxes that contain every point, or remove it");
        const auto found = std::ranges::lower_bound(ranks, owner);
        if (found == ranks.end() || *found != owner)
            reject(territory.name_of(points, i) + " now belongs to rank " + std::to_string(owner) +
                   ", which is no neighbour: it moved farther than travel; balance, or give more "
                   "travel");
        leaving_.push_back(i);
        neighbours_.push_back(static_cast<std::size_t>(found - ranks.begin()));
    });
    sort(ranks.size());
}

void Migration::sort(std::size_t num_neighbours) {
    first_.assign(num_neighbours + 1, 0);
    for (const std::size_t neighbour : neighbours_) ++first_[neighbour];
    LocalIndex end = 0;
    for (LocalIndex& first : first_) first = end += first;
    by_neighbour_.resize(leaving_.size());
    for (std::size_t k = leaving_.size(); k-- > 0;)
        by_neighbour_[--first_[neighbours_[k]]] = leaving_[k];
}

/// Lists the rows to move into places that arriving points leave free. Returns the new number of
/// points.
LocalIndex Migration::place(LocalIndex num_points, LocalIndex num_arriving) {
    moves_.clear();
    if (num_arriving >= places_.size()) return num_points + num_arriving - places_.size();
    std::size_t last = places_.size();
    LocalIndex end = num_points;
    for (std::size_t k = num_arriving; k < last; ++k) {
        while (last > k && places_[last - 1] == end - 1) --last, --end;
        if (last > k) moves_.emplace_back(--end, places_[k]);
    }
    return end;
}

bool Migration::apply(std::span<const ByteColumn> columns, LocalIndex num_points,
                      const NeighbourExchange& exchange) {
    places_.clear();
    for (std::size_t k = 0; k < leaving_.size(); ++k)
        if (exchange.has_message(neighbours_[k])) places_.push_back(leaving_[k]);
    num_arrived_ = 0;
    for (std::size_t n = 0; n < exchange.ranks().size(); ++n) {
        if (!exchange.has_message(n)) continue;
        exchange.message_from(n, message_bytes(columns, exchange.rows_from(n)));
        num_arrived_ += exchange.rows_from(n);
    }
    const LocalIndex num_left = places_.size();
    if (num_left == 0 && num_arrived_ == 0) return false;
    const LocalIndex end = place(num_points, num_arrived_);
    for (LocalIndex i = num_points; i < end; ++i) places_.push_back(i);
    const auto resize = [&](const ByteColumn& column, LocalIndex number) {
        return column.resize(column.result, number * column.components);
    };
    // Columns grow first, because only growing may fail.
    std::size_t num_grown = 0;
    try {
        for (; end > num_points && num_grown < columns.size(); ++num_grown)
            resize(columns[num_grown], end);
    } catch (...) {
        for (const ByteColumn& column : columns.first(num_grown)) resize(column, num_points);
        throw;
    }
    std::size_t begin = 0;
    for (const ByteColumn& column : columns) {
        const std::size_t bytes = row_bytes(column);
        std::byte* const rows = resize(column, std::max(num_points, end));
        const LocalIndex* to = places_.data();
        for (std::size_t n = 0; n < exchange.ranks().size(); ++n) {
            if (!exchange.has_message(n)) continue;
            const std::size_t num_rows = exchange.rows_from(n);
            const std::byte* from = exchange.message_from(n, message_bytes(columns, num_rows));
            from += message_bytes(columns.first(begin), num_rows);
            for (std::size_t k = 0; k < num_rows; ++k, from += bytes, ++to)
                copy_bytes(from, bytes, rows + *to * bytes);
        }
        for (const auto& [source, place] : moves_)
            copy_bytes(rows + source * bytes, bytes, rows + place * bytes);
        resize(column, end);
        ++begin;
    }
    return true;
}

}  // namespace rrcb
