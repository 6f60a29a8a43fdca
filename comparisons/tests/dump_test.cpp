#include "dump.hpp"

#include "failure.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

namespace comparisons {
namespace {

const std::string good_call =
    "rrcb-dump 1\nversion 0.1.0\nfunction Zoltan_LB_Partition\ncode -1\nranks 2\n"
    "parameter LB_METHOD RRCB\nparameter RRCB_DUMP a b\nend\n";
const std::string good_rank =
    "rrcb-dump-rank 1\nrank 1\nmessage it failed\npart_size global 0 0x1p-1\ndimension 2\n"
    "weights 2\nparts 1\nobjects 2\n0x1.8p+0 nan 0x1p-1 0x1p+0 4\n-inf -0x1p-1074 0x0p+0 0x1p+0 "
    "0\nend\n";

/// A dump of two ranks, made of these texts; gone when the test ends.
struct Dump {
    explicit Dump(const std::string& call, const std::string& rank = good_rank)
        : folder(testing::TempDir() + "rrcb_dump_" + std::to_string(getpid())) {
        std::filesystem::create_directory(folder);
        write("call.txt", call);
        write("rank-1.txt", rank);
    }
    ~Dump() { std::filesystem::remove_all(folder); }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder + '/' + name) << text;
    }
    std::string folder;
};

std::string with(std::string text, const std::string& old, const std::string& replacement) {
    return text.replace(text.find(old), old.size(), replacement);
}

void expect_failure(const std::function<void()>& read, const std::string& message) {
    try {
        read();
        ADD_FAILURE() << "no failure: " << message;
    } catch (const Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find(message), std::string::npos) << failure.what();
    }
}

void expect_bad_call(const std::string& text, const std::string& message) {
    const Dump dump(text);
    expect_failure([&] { read_dumped_call(dump.folder); }, message);
}

void expect_bad_rank(const std::string& text, const std::string& message) {
    const Dump dump(good_call, text);
    expect_failure([&] { read_dumped_rank(dump.folder, 1, true); }, message);
}

TEST(Dump, tells_the_call) {
    const Dump dump(good_call);
    const DumpedCall call = read_dumped_call(dump.folder);
    EXPECT_EQ(call.function, "Zoltan_LB_Partition");
    EXPECT_EQ(call.code, -1);
    EXPECT_EQ(call.num_ranks, 2);
    const std::vector<std::pair<std::string, std::string>> parameters = {{"LB_METHOD", "RRCB"},
                                                                         {"RRCB_DUMP", "a b"}};
    EXPECT_EQ(call.parameters, parameters);
}

TEST(Dump, tells_the_points_of_a_rank_to_the_bit) {
    const Dump dump(good_call);
    const DumpedRank rank = read_dumped_rank(dump.folder, 1, true);
    EXPECT_EQ(rank.message, "it failed");
    EXPECT_EQ(rank.dimension, 2);
    EXPECT_EQ(rank.num_weights, 2);
    ASSERT_EQ(rank.coordinates.size(), 4U);
    EXPECT_EQ(rank.coordinates[0], 1.5);
    EXPECT_TRUE(std::isnan(rank.coordinates[1]));
    EXPECT_EQ(rank.coordinates[2], -std::numeric_limits<double>::infinity());
    EXPECT_EQ(rank.coordinates[3], -std::numeric_limits<double>::denorm_min());
    EXPECT_EQ(rank.weights, (std::vector<double>{0.5, 0}));
    EXPECT_TRUE(read_dumped_rank(dump.folder, 1, false).coordinates.empty());
}

TEST(Dump, names_what_is_wrong_with_the_call) {
    expect_failure([] { read_dumped_call("nowhere"); },
                   "nowhere/call.txt: cannot be opened: No such file");
    expect_bad_call("", "call.txt:1: the file is truncated");
    expect_bad_call(with(good_call, "rrcb-dump 1", "rrcb-dump 2"),
                    "call.txt:1: 'rrcb-dump 2' instead of 'rrcb-dump 1'");
    expect_bad_call(with(good_call, "end\n", ""), "call.txt:8: the file is truncated");
    expect_bad_call(with(good_call, "ranks 2\n", ""), "call.txt:7: no number of ranks");
    for (const char* ranks : {"ranks 0", "ranks -3", "ranks two", "ranks"})
        expect_bad_call(with(good_call, "ranks 2", ranks), "call.txt:5: '" + std::string(ranks));
    expect_bad_call(with(good_call, "ranks 2", "ranks 1"), "'ranks 1', but there is rank-1.txt");
}

TEST(Dump, names_what_is_wrong_with_a_rank) {
    const Dump dump(good_call);
    expect_failure([&] { read_dumped_rank(dump.folder, 0, false); },
                   "rank-0.txt: cannot be opened: No such file");
    expect_bad_rank(with(good_rank, "\nrank 1", "\nrank 0"),
                    "rank-1.txt:2: 'rank 0' instead of 'rank 1'");
    expect_bad_rank(with(good_rank, "dimension 2", "dimension 4"), "rank-1.txt:5: 'dimension 4'");
    expect_bad_rank(with(good_rank, "dimension 2\n", ""), "objects without a dimension");
    expect_bad_rank(with(good_rank, "objects 2", "objects -1"), "rank-1.txt:8: 'objects -1'");
    expect_bad_rank(with(good_rank, "objects 2", "objects 1"), "rank-1.txt:10: '-inf");
    expect_bad_rank(with(good_rank, "objects 2", "objects 3"), "rank-1.txt:11: 'end' holds 0");
    expect_bad_rank(with(good_rank, "end\n", ""), "rank-1.txt:11: the file is truncated");
    expect_bad_rank(with(good_rank, "nan 0x1p-1 0x1p+0 4", ""),
                    "rank-1.txt:9: '0x1.8p+0 ' holds 1 numbers; coordinates and weights of a "
                    "point are 4");
}

}  // namespace
}  // namespace comparisons
