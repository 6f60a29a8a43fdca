#include "points_files.hpp"

#include "failure.hpp"
#include "text.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace comparisons {

namespace {

constexpr const char* expected_header = "the header must be x,y[,z][,weight]";

std::ifstream open(const std::string& path) {
    if (std::filesystem::is_directory(path))
        throw Failure(path + ": is a directory; give a file of points");
    std::ifstream input(path);
    if (!input) throw Failure(path + ": cannot be opened: " + std::strerror(errno));
    return input;
}

/// Reads a text line by line.
class LineReader {
  public:
    LineReader(std::istream& input, std::string path) : input_(input), path_(std::move(path)) {}

    bool next() {
        ++number_;
        return static_cast<bool>(std::getline(input_, line_));
    }

    const std::string& line() const { return line_; }

    [[noreturn]] void fail(const std::string& what) const {
        throw Failure(path_ + ':' + std::to_string(number_) + ": " + what);
    }

  private:
    std::istream& input_;
    std::string path_;
    std::string line_;
    std::size_t number_ = 0;
};

std::vector<std::string> read_header(LineReader& reader) {
    if (!reader.next()) reader.fail(std::string("the file is empty; ") + expected_header);
    std::vector<std::string> names;
    for (const std::string_view name : split(reader.line(), ',')) names.emplace_back(trim(name));
    std::size_t next = 0;
    for (const std::string expected : {"x", "y", "z", "weight"}) {
        if (next < names.size() && names[next] == expected) {
            ++next;
        } else if (expected == "x" || expected == "y") {
            reader.fail("column " + std::to_string(next + 1) + " must be '" + expected + "'; " +
                        expected_header);
        }
    }
    if (next < names.size())
        reader.fail("column " + std::to_string(next + 1) + " is '" + names[next] + "'; " +
                    expected_header);
    return names;
}

double read_field(const LineReader& reader, const std::string& name, std::string_view text) {
    text = trim(text);
    const std::optional<double> number = read_number<double>(text);
    const std::string column = "column '" + name + "': '" + std::string(text) + "' ";
    if (!number) reader.fail(column + "is not a number; write it like -1.5e3");
    if (!std::isfinite(*number)) reader.fail(column + "is not finite; remove or mend the point");
    if (name == "weight" && *number < 0)
        reader.fail(column + "is negative; a weight must be 0 or more");
    return *number;
}

void read_point(Workload& workload, const LineReader& reader,
                const std::vector<std::string>& names) {
    const std::vector<std::string_view> fields = split(reader.line(), ',');
    const std::string found =
        std::to_string(fields.size()) + " fields instead of " + std::to_string(names.size()) + "; ";
    if (fields.size() < names.size())
        reader.fail("column '" + names[fields.size()] + "' is missing: " + found +
                    "complete or remove the line");
    if (fields.size() > names.size()) reader.fail(found + "remove what is too much");
    for (std::size_t c = 0; c < names.size(); ++c) {
        const double value = read_field(reader, names[c], fields[c]);
        (names[c] == "weight" ? workload.weights : workload.coordinates).push_back(value);
    }
}

/// Reads a file of a dump, whose lines contain a key and a value.
class DumpFile : public LineReader {
  public:
    DumpFile(std::ifstream& input, const std::string& path) : LineReader(input, path) {}

    /// Reads the next line and returns its key.
    std::string next_key() {
        if (!next()) fail("the file is truncated; its last line is not 'end'");
        return line().substr(0, line().find(' '));
    }

    std::string value() const {
        const std::size_t blank = line().find(' ');
        return blank == line().npos ? std::string() : line().substr(blank + 1);
    }

    void expect(const std::string& text) {
        next_key();
        if (line() != text) fail("'" + line() + "' instead of '" + text + "'");
    }

    std::int64_t number(std::int64_t minimum, std::int64_t maximum) const {
        const auto number = read_number<std::int64_t>(value());
        if (!number || *number < minimum || *number > maximum)
            fail("'" + line() + "': a whole number from " + std::to_string(minimum) + " to " +
                 std::to_string(maximum) + " must follow '" + line().substr(0, line().find(' ')) +
                 "'");
        return *number;
    }
};

std::string rank_file(const std::string& folder, std::int64_t rank) {
    return (std::filesystem::path(folder) / ("rank-" + std::to_string(rank) + ".txt")).string();
}

/// Reads the description of the call into `note`. Returns the number of ranks.
std::int64_t read_call(const std::string& folder, std::string& note) {
    constexpr std::int64_t most_ranks = 1'000'000;
    const std::string path = (std::filesystem::path(folder) / "call.txt").string();
    std::ifstream input = open(path);
    DumpFile file(input, path);
    file.expect("rrcb-dump 1");
    std::string function;
    std::string parameters;
    std::int64_t code = 0;
    std::int64_t num_ranks = 0;
    for (std::string key = file.next_key(); file.line() != "end"; key = file.next_key()) {
        if (key == "function") function = file.value();
        if (key == "code") code = file.number(-1000, 1000);
        if (key == "ranks") num_ranks = file.number(1, most_ranks);
        if (key == "parameter") {
            const std::string parameter = file.value();
            const std::size_t blank = std::min(parameter.find(' '), parameter.size());
            parameters += ' ' + parameter.substr(0, blank) + '=';
            parameters += parameter.substr(std::min(blank + 1, parameter.size()));
        }
    }
    if (num_ranks == 0) file.fail("no number of ranks; a line 'ranks N' must precede");
    if (std::filesystem::exists(rank_file(folder, num_ranks)))
        file.fail("'ranks " + std::to_string(num_ranks) + "', but there is rank-" +
                  std::to_string(num_ranks) + ".txt");
    note = "dump: " + function + " on " + std::to_string(num_ranks) + " ranks, code " +
           std::to_string(code) + ", parameters:" + parameters + '\n';
    return num_ranks;
}

/// The values that precede the points of a rank.
struct RankHead {
    std::int64_t dimension = 0;
    std::int64_t num_weights = 0;  ///< per point
    std::int64_t count = 0;
};

RankHead read_head(DumpFile& file, std::int64_t rank, std::string& note) {
    constexpr std::int64_t most_weights = 1'000;
    constexpr std::int64_t most_points = std::int64_t{1} << 40;
    const std::string name = "rank " + std::to_string(rank);
    file.expect("rrcb-dump-rank 1");
    file.expect(name);
    RankHead head;
    std::string key;
    do {
        key = file.next_key();
        if (key == "message") note += "dump: " + name + ": " + file.value() + '\n';
        if (key == "dimension") head.dimension = file.number(0, 3);
        if (key == "weights") head.num_weights = file.number(0, most_weights);
        if (key == "objects") head.count = file.number(0, most_points);
    } while (key != "objects");
    if (head.count > 0 && head.dimension == 0)
        file.fail("objects without a dimension; a line 'dimension 1', 2 or 3 must precede");
    return head;
}

/// Reads a point. Its numbers are in the C library's format: hexadecimal, nan or inf.
void read_point(DumpFile& file, const RankHead& head, Workload& workload) {
    file.next_key();
    const char* text = file.line().c_str();
    const std::int64_t width = head.dimension + head.num_weights;
    for (std::int64_t column = 0; column < width; ++column) {
        char* end = nullptr;
        const double number = std::strtod(text, &end);
        if (end == text)
            file.fail("'" + file.line() + "' holds " + std::to_string(column) +
                      " numbers; coordinates and weights of a point are " + std::to_string(width));
        text = end;
        if (column < head.dimension) workload.coordinates.push_back(number);
        if (column == head.dimension) workload.weights.push_back(number);
    }
}

void read_rank(Dump& dump, const std::string& folder, std::int64_t rank, RankHead& shape) {
    const std::string path = rank_file(folder, rank);
    std::ifstream input = open(path);
    DumpFile file(input, path);
    const RankHead head = read_head(file, rank, dump.note);
    dump.counts.push_back(head.count);
    if (shape.count == 0) shape = head;
    if (head.count > 0 &&
        (head.dimension != shape.dimension || head.num_weights != shape.num_weights))
        throw Failure("the dump's rank " + std::to_string(rank) +
                      " has another dimension or number of weights than those before it; such "
                      "calls cannot be replayed");
    for (std::int64_t i = 0; i < head.count; ++i) read_point(file, head, dump.workload);
    file.expect("end");
}

}  // namespace

Workload read_points(std::istream& input, const std::string& file) {
    LineReader reader(input, file);
    const std::vector<std::string> names = read_header(reader);
    Workload workload;
    workload.weighted = names.back() == "weight";
    workload.dimension = static_cast<int>(names.size()) - (workload.weighted ? 1 : 0);
    while (reader.next())
        if (!trim(reader.line()).empty()) read_point(workload, reader, names);
    if (workload.coordinates.empty()) reader.fail("no points after the header; add one a line");
    return workload;
}

Workload read_points_file(const std::string& file) {
    std::ifstream input = open(file);
    return read_points(input, file);
}

Dump read_dump(const std::string& folder) {
    Dump dump;
    RankHead shape;
    const std::int64_t num_ranks = read_call(folder, dump.note);
    for (std::int64_t rank = 0; rank < num_ranks; ++rank) read_rank(dump, folder, rank, shape);
    Workload& workload = dump.workload;
    if (shape.count == 0) throw Failure(folder + ": the dump holds no points");
    workload.dimension = static_cast<int>(shape.dimension);
    workload.weighted = shape.num_weights > 0;
    if (shape.num_weights > 1) dump.note += "dump: only the first weight is balanced\n";
    const auto is_fault = [](double x) { return !std::isfinite(x); };
    const auto faults = std::ranges::count_if(workload.coordinates, is_fault) +
                        std::ranges::count_if(workload.weights, is_fault);
    if (faults > 0)
        dump.note += "dump: " + std::to_string(faults) +
                     " coordinates or weights are not finite; Zoltan's own methods may never "
                     "return\n";
    return dump;
}

}  // namespace comparisons
