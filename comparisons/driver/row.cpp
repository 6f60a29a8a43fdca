#include "row.hpp"

#include <algorithm>

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

void print_columns(std::ostream& out, const Row& columns, const std::vector<Row>& rows) {
    std::vector<std::vector<std::string>> lines(1);
    for (const auto& [name, value] : columns.columns()) lines[0].push_back(name);
    for (const Row& row : rows) {
        lines.emplace_back();
        for (const auto& [name, value] : row.columns()) lines.back().push_back(value);
    }
    std::vector<std::size_t> widths(lines[0].size());
    for (const auto& line : lines)
        for (std::size_t c = 0; line.size() == widths.size() && c < widths.size(); ++c)
            widths[c] = std::max(widths[c], line[c].size());
    for (const auto& line : lines) {
        for (std::size_t c = 0; c < line.size(); ++c) {
            const std::string padding(widths[c] - std::min(widths[c], line[c].size()), ' ');
            out << (c == 0 ? line[c] + padding : "  " + padding + line[c]);
        }
        out << '\n';
    }
}

}  // namespace comparisons
