#include "saved_rows_mpi.hpp"

#include "text.hpp"

#include <sstream>

namespace comparisons {

namespace {

std::string key_of(std::string_view row, std::size_t num_fields) {
    const std::vector<std::string_view> fields = split(row, ',');
    std::string key(fields.front());
    for (std::size_t i = 1; i < num_fields; ++i) key += ',' + std::string(fields[i]);
    return key;
}

bool is_complete(std::string_view row, std::string_view header) {
    return row.ends_with(',') && split(row, ',').size() == split(header, ',').size();
}

}  // namespace

SavedRows::SavedRows(const ResultsFolder& folder, std::string name, std::string header,
                     std::size_t num_key_fields)
    : folder_(folder),
      name_(std::move(name)),
      header_(std::move(header)),
      num_key_fields_(num_key_fields) {
    const std::vector<std::string> lines = folder.read_lines(name_);
    if (!lines.empty() && lines.front() == header_) {
        for (std::size_t i = 1; i < lines.size(); ++i) {
            if (is_complete(lines[i], header_)) add_row(lines[i]);
        }
    }
    save();
}

bool SavedRows::add(const std::function<void(std::ostream&)>& write) {
    std::istringstream rows(folder_.from_root(write));
    bool failed = false;
    for (std::string row; std::getline(rows, row);) {
        failed = failed || !row.ends_with(',');
        add_row(row);
    }
    save();
    return failed;
}

void SavedRows::add_row(const std::string& row) {
    if (keys_.insert(key_of(row, num_key_fields_)).second) rows_.push_back(row);
}

void SavedRows::save() const {
    folder_.write(name_, [&](std::ostream& out) {
        out << header_ << '\n';
        for (const std::string& row : rows_) out << row << '\n';
    });
}

}  // namespace comparisons
