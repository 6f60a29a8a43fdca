#include "points_file.hpp"

#include "failure.hpp"
#include "text.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace comparisons {

namespace {

constexpr const char* expected_header = "the header must be x,y[,z][,weight]";

/// Where the reader stands, for messages.
struct Place {
    std::string file;
    std::size_t line = 0;

    [[noreturn]] void fail(const std::string& what) const {
        throw Failure(file + ":" + std::to_string(line) + ": " + what);
    }
};

std::vector<std::string_view> read_header(const Place& place, std::string_view line) {
    std::vector<std::string_view> names = split(line, ',');
    for (std::string_view& name : names) name = trim(name);
    std::size_t next = 0;
    for (const std::string_view expected : {"x", "y", "z", "weight"}) {
        if (next < names.size() && names[next] == expected) {
            ++next;
        } else if (expected == "x" || expected == "y") {
            place.fail("column '" + std::string(expected) + "' is missing; " + expected_header);
        }
    }
    if (next < names.size()) {
        place.fail("column " + std::to_string(next + 1) + " is '" + std::string(names[next]) +
                   "'; " + expected_header);
    }
    return names;
}

double read_field(const Place& place, std::string_view name, std::string_view text) {
    text = trim(text);
    const std::optional<double> number = read_number<double>(text);
    const std::string column = "column '" + std::string(name) + "': '" + std::string(text) + "' ";
    if (!number) place.fail(column + "is not a number; write it like -1.5e3");
    if (!std::isfinite(*number)) place.fail(column + "is not finite; remove or mend the point");
    if (name == "weight" && *number < 0) {
        place.fail(column + "is negative; a weight must be 0 or more");
    }
    return *number;
}

void read_point(Workload& workload, const Place& place, std::string_view line,
                const std::vector<std::string_view>& names) {
    const std::vector<std::string_view> fields = split(line, ',');
    if (fields.size() < names.size()) {
        place.fail("column '" + std::string(names[fields.size()]) +
                   "' is missing: " + std::to_string(fields.size()) + " fields instead of " +
                   std::to_string(names.size()) + "; complete or remove the line");
    }
    if (fields.size() > names.size()) {
        place.fail(std::to_string(fields.size()) + " fields instead of " +
                   std::to_string(names.size()) + "; remove what is too much");
    }
    for (std::size_t c = 0; c < names.size(); ++c) {
        const double value = read_field(place, names[c], fields[c]);
        (names[c] == "weight" ? workload.weights : workload.coordinates).push_back(value);
    }
}

}  // namespace

Workload read_points(std::istream& input, const std::string& file) {
    Place place{file, 1};
    std::string header;
    if (!std::getline(input, header))
        place.fail(std::string("the file is empty; ") + expected_header);
    const std::vector<std::string_view> names = read_header(place, header);
    Workload workload;
    workload.weighted = names.back() == "weight";
    workload.dimension = static_cast<int>(names.size()) - (workload.weighted ? 1 : 0);
    std::string line;
    while (std::getline(input, line)) {
        ++place.line;
        if (!trim(line).empty()) read_point(workload, place, line, names);
    }
    if (workload.coordinates.empty()) place.fail("no points after the header; add one a line");
    return workload;
}

Workload read_points_file(const std::string& file) {
    if (std::filesystem::is_directory(file)) {
        throw Failure(file + ": is a directory; give a file of points");
    }
    std::ifstream input(file);
    if (!input) throw Failure(file + ": cannot be opened: " + std::strerror(errno));
    return read_points(input, file);
}

}  // namespace comparisons
