#include "program.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace rrcb::zoltan_test {
namespace {

namespace fs = std::filesystem;

/// A folder of this test's run alone, the same on all ranks; gone when the test ends.
class Folder {
  public:
    explicit Folder(const std::string& name) {
        std::string unique = (fs::temp_directory_path() / ("rrcb-" + name + "-XXXXXX")).string();
        if (rank() == 0 && mkdtemp(unique.data()) == nullptr) unique.clear();
        MPI_Bcast(unique.data(), static_cast<int>(unique.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
        path_ = unique;
    }
    ~Folder() {
        MPI_Barrier(MPI_COMM_WORLD);
        if (rank() == 0) fs::remove_all(path_);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    fs::path operator/(const std::string& name) const { return path_ / name; }
    std::string string() const { return path_.string(); }

    std::ptrdiff_t num_entries() const {
        MPI_Barrier(MPI_COMM_WORLD);
        return std::distance(fs::directory_iterator(path_), fs::directory_iterator());
    }

  private:
    static int rank() {
        int rank = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        return rank;
    }

    fs::path path_;
};

std::vector<std::string> lines_of(const fs::path& file) {
    MPI_Barrier(MPI_COMM_WORLD);
    std::ifstream input(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(input, line);) lines.push_back(line);
    return lines;
}

bool contains(const std::vector<std::string>& lines, const std::string& line) {
    return std::ranges::find(lines, line) != lines.end();
}

std::vector<std::string> lines_of_rank(const Program& program, const fs::path& call) {
    return lines_of(call / ("rank-" + std::to_string(program.rank) + ".txt"));
}

/// The numbers of all points, row by row, read back from the text.
std::vector<double> numbers_of(const std::vector<std::string>& lines) {
    auto line = std::ranges::find_if(
        lines, [](const std::string& text) { return text.starts_with("objects "); });
    std::vector<double> numbers;
    for (++line; *line != "end"; ++line) {
        std::istringstream words(*line);
        for (std::string word; words >> word;)
            numbers.push_back(std::strtod(word.c_str(), nullptr));
    }
    return numbers;
}

struct DumpingProgram : Program {
    explicit DumpingProgram(const std::string& folder) {
        scatter_points(*this, 40);
        set({{"LB_METHOD", "RRCB"}, {"OBJ_WEIGHT_DIM", "1"}, {"RRCB_DUMP", folder}});
    }
    bool is_last() const { return rank == num_ranks - 1; }
};

TEST(Dump, of_a_failing_call_holds_what_every_rank_gave_to_the_bit) {
    const Folder folder("dump");
    DumpingProgram program(folder.string());
    if (program.is_last()) program.coordinates[3] = std::numeric_limits<double>::quiet_NaN();
    if (program.is_last()) program.coordinates[4] = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
    ASSERT_EQ(folder.num_entries(), 1);

    const auto call = lines_of(folder / "call-1" / "call.txt");
    EXPECT_EQ(call.front(), "rrcb-dump 1");
    EXPECT_TRUE(contains(call, "function Zoltan_LB_Partition"));
    EXPECT_TRUE(contains(call, "code -1"));
    EXPECT_TRUE(contains(call, "ranks " + std::to_string(program.num_ranks)));
    EXPECT_TRUE(contains(call, "parameter OBJ_WEIGHT_DIM 1"));
    EXPECT_TRUE(contains(call, "parameter LB_METHOD RRCB"));
    EXPECT_EQ(call.back(), "end");

    const auto mine = lines_of_rank(program, folder / "call-1");
    EXPECT_TRUE(contains(mine, "objects 40"));
    EXPECT_TRUE(contains(mine, "dimension 2"));
    EXPECT_NE(mine[2].find("NaN"), std::string::npos) << mine[2];
    const std::vector<double> numbers = numbers_of(mine);
    ASSERT_EQ(numbers.size(), 120U);
    for (std::size_t i = 0; i < 40; ++i) {
        for (std::size_t a = 0; a < 2; ++a) {
            const double expected = program.coordinates[2 * i + a];
            if (std::isnan(expected)) {
                EXPECT_TRUE(std::isnan(numbers[3 * i + a]));
            } else {
                EXPECT_EQ(numbers[3 * i + a], expected);
            }
        }
        EXPECT_EQ(numbers[3 * i + 2], static_cast<double>(program.weights[i]));
    }
}

TEST(Dump, is_made_of_calls_that_succeed_only_when_asked_for) {
    const Folder folder("asked");
    DumpingProgram program(folder.string());
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    EXPECT_EQ(folder.num_entries(), 0);
    program.set("RRCB_DUMP_WHEN", "always");
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    EXPECT_EQ(program.balance().code, ZOLTAN_OK);
    EXPECT_EQ(folder.num_entries(), 2);
    EXPECT_TRUE(contains(lines_of(folder / "call-2" / "call.txt"), "function Zoltan_LB_Balance"));
    program.set("RRCB_DUMP_WHEN", "DEFAULT");
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    EXPECT_EQ(folder.num_entries(), 2);
    EXPECT_EQ(program.set("RRCB_DUMP_WHEN", "SOMETIMES"), ZOLTAN_WARN);
}

TEST(Dump, of_a_failing_callback_tells_its_error) {
    const Folder folder("callback");
    DumpingProgram program(folder.string());
    program.set("RRCB_DUMP_WHEN", "ALWAYS");
    if (program.is_last()) {
        program.fault = [](const std::string& name, int&) {
            if (name == "GEOM_MULTI") throw std::runtime_error("two\nlines");
        };
    }
    EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
    ASSERT_EQ(folder.num_entries(), 1);
    const auto last =
        lines_of(folder / "call-1" / ("rank-" + std::to_string(program.num_ranks - 1) + ".txt"));
    EXPECT_TRUE(contains(last, "message a callback threw: two lines"));
    EXPECT_TRUE(contains(last, "objects 0"));
}

TEST(Dump, holds_initial_parts_and_part_sizes) {
    const Folder folder("parts");
    DumpingProgram program(folder.string());
    program.set("RRCB_DUMP_WHEN", "ALWAYS");
    Zoltan_Set_Part_Multi_Fn(
        program.zz,
        [](void* data, int, int, int count, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR, int* parts, int* code) {
            *code = ZOLTAN_OK;
            std::fill_n(parts, count, static_cast<const Program*>(data)->rank);
        },
        &program);
    int part = 0;
    int weight_index = 0;
    float size = 0.5F;
    Zoltan_LB_Set_Part_Sizes(program.zz, 1, 1, &part, &weight_index, &size);
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    const auto mine = lines_of_rank(program, folder / "call-1");
    EXPECT_TRUE(contains(mine, "part_size global 0 0x1p-1"));
    const std::vector<double> numbers = numbers_of(mine);
    ASSERT_EQ(numbers.size(), 160U);
    for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(numbers[4 * i + 3], program.rank);
}

TEST(Dump, of_one_rank_that_asks_is_made_by_all) {
    const Folder folder("one");
    DumpingProgram program("");
    if (program.is_last()) program.set("RRCB_DUMP", folder.string());
    if (program.is_last()) program.set("RRCB_DUMP_WHEN", "ALWAYS");
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    EXPECT_EQ(lines_of_rank(program, folder / "call-1").back(), "end");
}

TEST(Dump, is_asked_for_by_the_environment_unless_a_parameter_says_otherwise) {
    const Folder folder("environment");
    setenv("RRCB_DUMP", folder.string().c_str(), 1);
    setenv("RRCB_DUMP_WHEN", "always", 1);
    Scattered program(10);
    unsetenv("RRCB_DUMP");
    unsetenv("RRCB_DUMP_WHEN");
    program.set("LB_METHOD", "RRCB");
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    EXPECT_EQ(folder.num_entries(), 1);
    program.set("RRCB_DUMP", "");
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    EXPECT_EQ(folder.num_entries(), 1);
}

TEST(Dump, that_cannot_be_written_leaves_the_call_as_it_is) {
    DumpingProgram program("/dev/null/nowhere");
    program.set({{"RRCB_DUMP_WHEN", "ALWAYS"}, {"RETURN_LISTS", "PARTS"}});
    testing::internal::CaptureStderr();
    for (int call = 0; call < 2; ++call) {
        const Outcome outcome = program.partition();
        EXPECT_EQ(outcome.code, ZOLTAN_OK);
        EXPECT_EQ(outcome.exports.count, 40);
    }
    const std::string printed = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::ranges::count(printed, '\n'), program.rank == 0 ? 1 : 0) << printed;
    if (program.rank == 0) {
        EXPECT_NE(printed.find("cannot write to RRCB_DUMP"), std::string::npos) << printed;
    }
}

}  // namespace
}  // namespace rrcb::zoltan_test
