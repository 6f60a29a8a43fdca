#include "row.hpp"

#include <algorithm>

namespace comparisons {

namespace {

/// Quoted where it must be.
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == text.npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
    quoted += '"';
    return quoted;
}

}  // namespace

Row& Row::add(std::string name, std::string value) {
    columns_.emplace_back(std::move(name), std::move(value));
    return *this;
}

Row& Row::add_interval(const std::string& prefix, const std::optional<Interval>& interval) {
    add(prefix + "low", interval ? std::optional(interval->low) : std::nullopt);
    return add(prefix + "high", interval ? std::optional(interval->high) : std::nullopt);
}

Row& Row::end_key() {
    key_size_ = size();
    return *this;
}

Row& Row::add_error(const std::string& error) {
    for (std::size_t i = key_size_; !error.empty() && i < size(); ++i) columns_[i].second.clear();
    return add("error", error);
}

std::string Row::header() const {
    std::string names;
    for (const auto& [name, value] : columns_) names.append(names.empty() ? "" : ",").append(name);
    return names;
}

std::string Row::values(std::size_t count) const {
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
        text.append(i == 0 ? "" : ",").append(field(columns_[i].second));
    return text;
}

std::string Row::text() const {
    return values(size());
}

Row Row::with_values(const std::vector<std::string>& values) const {
    Row row = *this;
    for (std::size_t i = 0; i < size(); ++i) row.columns_[i].second = values[i];
    return row;
}

std::string csv(const Row& columns, const std::vector<Row>& rows) {
    std::string text = columns.header() + '\n';
    for (const Row& row : rows) text += row.text() + '\n';
    return text;
}

void print_columns(std::ostream& out, const Row& columns, const std::vector<Row>& rows) {
    std::vector<std::string> heading;
    for (const auto& [name, value] : columns.columns()) heading.push_back(name);
    std::vector<Row> lines = {columns.with_values(heading)};
    lines.insert(lines.end(), rows.begin(), rows.end());
    std::vector<std::size_t> widths(columns.size());
    for (const Row& line : lines) {
        for (std::size_t c = 0; line.size() == widths.size() && c < widths.size(); ++c)
            widths[c] = std::max(widths[c], line.columns()[c].second.size());
    }
    for (const Row& line : lines) {
        for (std::size_t c = 0; c < line.size(); ++c) {
            const std::string& cell = line.columns()[c].second;
            const std::string padding(widths[c] - std::min(widths[c], cell.size()), ' ');
            out << (c == 0 ? cell + padding : "  " + padding + cell);
        }
        out << '\n';
    }
}

}  // namespace comparisons
