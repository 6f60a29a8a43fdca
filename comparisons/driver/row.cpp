#include "row.hpp"

#include <iostream>
#include <utility>

namespace comparisons {

namespace {

/// Returns a text as a field of CSV, quoted if necessary.
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == text.npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
    quoted += '"';
    return quoted;
}

}  // namespace

Row& Row::add(std::string name, std::string value) {
    columns_.emplace_back(std::move(name), error_.empty() ? std::move(value) : std::string());
    return *this;
}

Row& Row::add_interval(const std::string& prefix, const std::optional<Interval>& interval) {
    add(prefix + "low", interval ? std::optional(interval->low) : std::nullopt);
    return add(prefix + "high", interval ? std::optional(interval->high) : std::nullopt);
}

Row& Row::end_key(const std::string& error) {
    error_ = error;
    return *this;
}

Row& Row::add_error() {
    columns_.emplace_back("error", error_);
    return *this;
}

std::string Row::header() const {
    std::string names;
    for (const auto& [name, value] : columns_) names.append(names.empty() ? "" : ",").append(name);
    return names;
}

std::string Row::text() const {
    std::string text;
    const char* separator = "";
    for (const auto& [name, value] : columns_) {
        text.append(separator).append(field(value));
        separator = ",";
    }
    return text;
}

std::string csv(const Row& columns, const std::vector<Row>& rows) {
    std::string text = columns.header() + '\n';
    for (const Row& row : rows) text += row.text() + '\n';
    return text;
}

void print(const Row& row) {
    static bool is_first = true;
    if (std::exchange(is_first, false)) std::cout << row.header() << '\n';
    std::cout << row.text() << std::endl;
}

}  // namespace comparisons
