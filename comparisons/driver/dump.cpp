#include "dump.hpp"

#include "failure.hpp"
#include "text.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace comparisons {

namespace {

/// A file of a dump, line by line.
class DumpFile {
  public:
    DumpFile(const std::string& folder, const std::string& name)
        : path_((std::filesystem::path(folder) / name).string()), input_(path_) {
        if (!input_) throw Failure(path_ + ": cannot be opened: " + std::strerror(errno));
    }

    void next() {
        ++number_;
        if (!std::getline(input_, line_)) fail("the file is truncated; its last line is not 'end'");
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw Failure(path_ + ':' + std::to_string(number_) + ": " + what);
    }

    const std::string& line() const { return line_; }
    std::string_view key() const { return std::string_view(line_).substr(0, line_.find(' ')); }
    std::string_view value() const {
        const std::size_t blank = line_.find(' ');
        return blank == line_.npos ? std::string_view() : std::string_view(line_).substr(blank + 1);
    }

    void expect(std::string_view line) {
        next();
        if (line_ != line) fail("'" + line_ + "' instead of '" + std::string(line) + "'");
    }

    template <typename Number>
    Number number(Number minimum, Number maximum) const {
        const auto number = read_number<Number>(value());
        if (!number || *number < minimum || *number > maximum) {
            fail("'" + line_ + "': a whole number from " + std::to_string(minimum) + " to " +
                 std::to_string(maximum) + " must follow '" + std::string(key()) + "'");
        }
        return *number;
    }

  private:
    std::string path_;
    std::ifstream input_;
    std::string line_;
    std::size_t number_ = 0;
};

constexpr int most_ranks = 1'000'000;
constexpr int most_weights = 1'000;
constexpr std::size_t most_points = std::size_t{1} << 40;

std::string rank_file(int rank) {
    return "rank-" + std::to_string(rank) + ".txt";
}

/// Reads on to the line of the number of objects, which ends the head.
void read_head(DumpFile& file, int rank, DumpedRank& dumped) {
    file.expect("rrcb-dump-rank 1");
    file.expect("rank " + std::to_string(rank));
    do {
        file.next();
        if (file.key() == "message") dumped.message = file.value();
        if (file.key() == "dimension") dumped.dimension = file.number(0, 3);
        if (file.key() == "weights") dumped.num_weights = file.number(0, most_weights);
        if (file.key() == "objects") dumped.count = file.number(std::size_t{0}, most_points);
    } while (file.key() != "objects");
    if (dumped.count > 0 && dumped.dimension == 0)
        file.fail("objects without a dimension; a line 'dimension 1', 2 or 3 must precede");
}

/// Numbers as the C library writes them: hexadecimal, nan and inf among them.
void read_point(DumpFile& file, DumpedRank& dumped) {
    file.next();
    const char* text = file.line().c_str();
    const int width = dumped.dimension + dumped.num_weights;
    for (int column = 0; column < width; ++column) {
        char* end = nullptr;
        const double number = std::strtod(text, &end);
        if (end == text) {
            file.fail("'" + file.line() + "' holds " + std::to_string(column) +
                      " numbers; coordinates and weights of a point are " + std::to_string(width));
        }
        text = end;
        if (column < dumped.dimension) dumped.coordinates.push_back(number);
        if (column == dumped.dimension) dumped.weights.push_back(number);
    }
}

}  // namespace

DumpedCall read_dumped_call(const std::string& folder) {
    DumpFile file(folder, "call.txt");
    DumpedCall call;
    file.expect("rrcb-dump 1");
    for (file.next(); file.line() != "end"; file.next()) {
        const std::string value(file.value());
        if (file.key() == "function") call.function = value;
        if (file.key() == "code") call.code = file.number(-1000, 1000);
        if (file.key() == "ranks") call.num_ranks = file.number(1, most_ranks);
        if (file.key() == "parameter") {
            const std::size_t blank = std::min(value.find(' '), value.size());
            call.parameters.emplace_back(value.substr(0, blank),
                                         value.substr(std::min(blank + 1, value.size())));
        }
    }
    if (call.num_ranks == 0) file.fail("no number of ranks; a line 'ranks N' must precede");
    if (std::filesystem::exists(std::filesystem::path(folder) / rank_file(call.num_ranks))) {
        file.fail("'ranks " + std::to_string(call.num_ranks) + "', but there is " +
                  rank_file(call.num_ranks));
    }
    return call;
}

DumpedRank read_dumped_rank(const std::string& folder, int rank, bool with_points) {
    DumpFile file(folder, rank_file(rank));
    DumpedRank dumped;
    read_head(file, rank, dumped);
    if (!with_points) return dumped;
    for (std::size_t i = 0; i < dumped.count; ++i) read_point(file, dumped);
    file.expect("end");
    return dumped;
}

}  // namespace comparisons
