#pragma once

#include "statistics.hpp"
#include "text.hpp"

#include <cstddef>
#include <optional>
#include <ostream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace comparisons {

/// A row of a CSV file: its columns in their order, each a name and a value; a value that does not
/// exist is empty.
///
/// The columns of a file are listed once, where its rows are made; any row tells the header, also
/// one that is made of nothing.
class Row {
  public:
    Row& add(std::string name, std::string value);

    /// A number as the shortest text that reads back as the same.
    template <typename Number>
    requires std::is_arithmetic_v<Number> Row& add(std::string name, Number value) {
        return add(std::move(name), write_number(value));
    }

    template <typename Number>
    Row& add(std::string name, const std::optional<Number>& value) {
        return add(std::move(name), value ? write_number(*value) : std::string());
    }

    /// The columns `prefix`low and `prefix`high.
    Row& add_interval(const std::string& prefix, const std::optional<Interval>& interval);

    /// The columns so far tell what was measured; unless `error` is empty, later ones are but
    /// `error`.
    Row& end_key(const std::string& error);

    /// The column `error`.
    Row& add_error();

    std::string header() const;
    std::string text() const;

    /// Names and values.
    const std::vector<std::pair<std::string, std::string>>& columns() const { return columns_; }

  private:
    std::vector<std::pair<std::string, std::string>> columns_;
    std::string error_;
};

/// A CSV file by RFC 4180: the header that `columns` tells, then the rows.
std::string csv(const Row& columns, const std::vector<Row>& rows);

/// The same of items that `row_of` makes a row of, of a default one too.
template <typename Items, typename RowOf>
std::string csv_of(const Items& items, RowOf&& row_of) {
    std::vector<Row> rows;
    for (const auto& item : items) rows.push_back(row_of(item));
    return csv(row_of(typename Items::value_type{}), rows);
}

/// Rows for people, in columns under the names that `columns` tells: the first to the left, numbers
/// to the right. A shorter row ends with a text of any length.
void print_columns(std::ostream& out, const Row& columns, const std::vector<Row>& rows);

}  // namespace comparisons
