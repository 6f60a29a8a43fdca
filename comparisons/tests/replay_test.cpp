#include "../../tests/support/ranks.hpp"
#include "cloud.hpp"
#include "failure.hpp"
#include "partitioner_mpi.hpp"
#include "workload_mpi.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>

namespace comparisons {
namespace {

/// A new folder for dumps, the same on all ranks; gone when the test ends.
struct Folder {
    Folder() {
        int id = static_cast<int>(getpid());
        MPI_Bcast(&id, 1, MPI_INT, 0, MPI_COMM_WORLD);
        static int number = 0;
        path = testing::TempDir() + "rrcb_replay_" + std::to_string(id) + '_' +
               std::to_string(++number);
    }
    ~Folder() {
        MPI_Barrier(MPI_COMM_WORLD);
        if (rrcb::test::rank() == 0) std::filesystem::remove_all(path);
    }
    std::string path;
};

/// Points of a cloud, more of them on higher ranks, that weigh 1, 2, 3, 1, ...
Workload uneven_workload() {
    const rrcb::GlobalCount first = 40 * rrcb::test::rank() * (rrcb::test::rank() + 1) / 2;
    Workload workload;
    workload.coordinates =
        cloud_points({"slope", 400, 2, 1}, first, first + 40 * (rrcb::test::rank() + 1));
    workload.weighted = true;
    for (std::size_t i = 0; i < workload.coordinates.size() / 2; ++i)
        workload.weights.push_back(1.0 + static_cast<double>(i % 3));
    return workload;
}

ZoltanParameters parameters_with(const std::string& folder, const std::string& when) {
    ZoltanParameters parameters = zoltan_parameters(read_method("rrcb"), Lists::parts);
    parameters.emplace_back("RRCB_DUMP", folder);
    parameters.emplace_back("RRCB_DUMP_WHEN", when);
    return parameters;
}

/// read_replay of what this program has dumped, once every rank has.
Replay replay_own(const std::string& folder, MPI_Comm comm = MPI_COMM_WORLD) {
    MPI_Barrier(MPI_COMM_WORLD);
    return read_replay(folder, comm);
}

std::vector<rrcb::Part> parts_of(const Workload& workload, const ZoltanParameters& parameters) {
    ZoltanPartitioner partitioner(parameters, workload, MPI_COMM_WORLD);
    EXPECT_EQ(partitioner.partition(), ZOLTAN_OK);
    return partitioner.parts();
}

TEST(Replay, of_a_call_that_succeeded_gives_its_parts_again) {
    const Folder folder;
    const Workload workload = uneven_workload();
    const auto parts = parts_of(workload, parameters_with(folder.path, "ALWAYS"));
    const Replay replay = replay_own(folder.path + "/call-1/");
    EXPECT_EQ(replay.workload.name, "call-1");
    EXPECT_EQ(replay.workload.layout, "dump");
    EXPECT_EQ(replay.workload.coordinates, workload.coordinates);
    EXPECT_EQ(replay.workload.weights, workload.weights);
    EXPECT_EQ(parts_of(replay.workload, zoltan_parameters(read_method("rrcb"), Lists::parts)),
              parts);
}

TEST(Replay, of_a_call_that_failed_holds_what_made_it_fail) {
    const Folder folder;
    Workload workload = uneven_workload();
    if (rrcb::test::rank() == rrcb::test::num_ranks() - 1)
        workload.coordinates[5] = std::numeric_limits<double>::quiet_NaN();
    {
        ZoltanPartitioner partitioner(parameters_with(folder.path, "FAILURE"), workload,
                                      MPI_COMM_WORLD);
        EXPECT_EQ(partitioner.partition(), ZOLTAN_FATAL);
    }
    const Replay replay = replay_own(folder.path + "/call-1");
    ASSERT_EQ(replay.workload.coordinates.size(), workload.coordinates.size());
    EXPECT_EQ(std::isnan(replay.workload.coordinates[5]),
              rrcb::test::rank() == rrcb::test::num_ranks() - 1);
    if (rrcb::test::rank() == 0) {
        EXPECT_TRUE(replay.note.starts_with("dump: Zoltan_LB_Partition on ")) << replay.note;
        EXPECT_NE(replay.note.find("code -1"), std::string::npos) << replay.note;
        EXPECT_NE(replay.note.find("dump: rank 0: "), std::string::npos) << replay.note;
    }
}

TEST(Replay, on_another_number_of_ranks_deals_the_points_out_in_order) {
    const Folder folder;
    const Workload workload = uneven_workload();
    parts_of(workload, parameters_with(folder.path, "ALWAYS"));
    const Replay replay = replay_own(folder.path + "/call-1", MPI_COMM_SELF);
    const auto total =
        static_cast<std::size_t>(40 * rrcb::test::num_ranks() * (rrcb::test::num_ranks() + 1) / 2);
    EXPECT_EQ(replay.workload.coordinates,
              cloud_points({"slope", 400, 2, 1}, 0, static_cast<rrcb::GlobalCount>(total)));
    EXPECT_EQ(replay.workload.weights.size(), total);
    EXPECT_EQ(replay.note.find("dealt out in order to 1") == std::string::npos,
              rrcb::test::num_ranks() == 1);
}

TEST(Replay, of_a_dump_that_is_not_whole_fails_on_every_rank) {
    const Folder folder;
    parts_of(uneven_workload(), parameters_with(folder.path, "ALWAYS"));
    MPI_Barrier(MPI_COMM_WORLD);
    const std::string last =
        folder.path + "/call-1/rank-" + std::to_string(rrcb::test::num_ranks() - 1) + ".txt";
    if (rrcb::test::rank() == 0)
        std::filesystem::resize_file(last, std::filesystem::file_size(last) - 30);
    MPI_Barrier(MPI_COMM_WORLD);
    for (const bool is_there : {true, false}) {
        try {
            read_replay(folder.path + "/call-1", MPI_COMM_WORLD);
            ADD_FAILURE() << "was read";
        } catch (const Failure& failure) {
            EXPECT_TRUE(std::string(failure.what()).starts_with(last)) << failure.what();
        }
        MPI_Barrier(MPI_COMM_WORLD);
        if (rrcb::test::rank() == 0 && is_there) std::filesystem::remove(last);
        MPI_Barrier(MPI_COMM_WORLD);
    }
}

}  // namespace
}  // namespace comparisons
