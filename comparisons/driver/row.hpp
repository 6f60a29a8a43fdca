#pragma once

#include "statistics.hpp"
#include "text.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace comparisons {

/// A row of a CSV file: an ordered list of columns, each with a name and a value. A missing value
/// is empty.
///
/// The columns of a file are listed once, in the function that makes its rows. The header follows
/// from any row, even from one made of a default-constructed item.
class Row {
  public:
    Row& add(std::string name, std::string value);

    /// Adds a number, as the shortest text that parses to the same number.
    template <typename Number>
    requires std::is_arithmetic_v<Number> Row& add(std::string name, Number value) {
        return add(std::move(name), write_number(value));
    }

    template <typename Number>
    Row& add(std::string name, const std::optional<Number>& value) {
        return add(std::move(name), value ? write_number(*value) : std::string());
    }

    /// Adds the columns `prefix`low and `prefix`high.
    Row& add_interval(const std::string& prefix, const std::optional<Interval>& interval);

    /// Ends the columns that identify the measurement. If `error` is not empty, later columns are
    /// left empty, except the column `error`.
    Row& end_key(const std::string& error);

    /// Adds the column `error`.
    Row& add_error();

    std::string header() const;
    std::string text() const;

  private:
    std::vector<std::pair<std::string, std::string>> columns_;
    std::string error_;
};

/// Returns a CSV file according to RFC 4180: a header with the names in `columns`, then the rows.
std::string csv(const Row& columns, const std::vector<Row>& rows);

/// Returns a CSV file with a row for each item. The header is that of a default-constructed item.
template <typename Items, typename RowOf>
std::string csv_of(const Items& items, RowOf&& row_of) {
    std::vector<Row> rows;
    for (const auto& item : items) rows.push_back(row_of(item));
    return csv(row_of(typename Items::value_type{}), rows);
}

/// Prints a row of the program's only table on standard output, and before the first row its
/// header.
void print(const Row& row);

}  // namespace comparisons
