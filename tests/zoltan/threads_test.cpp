// Threads that balance at the same time, each over a communicator of its own. Ends with 77, which
// skips the test, where MPI lets only one thread at a time in.
#include "program.hpp"

#include <dlfcn.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <thread>

namespace {

std::atomic<int> num_yields = 0;  ///< of the plug-in; those of MPI are not counted

}  // namespace

// In place of the function of the system, for all libraries.
extern "C" int sched_yield() noexcept {
    Dl_info info{};
    const bool is_known = dladdr(__builtin_return_address(0), &info) != 0;
    if (is_known && std::strstr(info.dli_fname, "librrcb_zoltan") != nullptr) ++num_yields;
    return static_cast<int>(syscall(SYS_sched_yield));
}

namespace rrcb::zoltan_test {
namespace {

constexpr int num_threads = 3;
constexpr int num_rounds = 8;

std::array<MPI_Comm, num_threads> make_communicators() {
    std::array<MPI_Comm, num_threads> all{};
    for (MPI_Comm& comm : all) MPI_Comm_dup(MPI_COMM_WORLD, &comm);
    return all;
}

void free_communicators(std::array<MPI_Comm, num_threads>& all) {
    for (MPI_Comm& comm : all) MPI_Comm_free(&comm);
}

/// A cloud of its own for each thread.
struct Cloud : Program {
    Cloud(int thread, MPI_Comm comm) : Program(2, comm) {
        scatter_points(*this, 100 + 40 * thread);
        set({{"LB_METHOD", "RRCB"}, {"KEEP_CUTS", "1"}, {"RETURN_LISTS", "PARTS"}});
        set("NUM_GLOBAL_PARTS", std::to_string(5 + thread));
    }
    std::vector<int> parts(Zoltan_Struct* handle) {
        const Outcome outcome = partition(handle);
        return outcome.code == ZOLTAN_OK ? parts_by_object(outcome) : std::vector<int>{};
    }
};

/// How many look-ups on a handle answer something else than the partition.
int wrong_look_ups(Cloud& cloud, Zoltan_Struct* handle, const std::vector<int>& parts) {
    int wrong = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        int rank = -1, part = -1;
        const int code = Zoltan_LB_Point_PP_Assign(handle, &cloud.coordinates[2 * i], &rank, &part);
        if (code != ZOLTAN_OK || part != parts[i]) ++wrong;
    }
    return wrong;
}

/// One life of a handle and of a copy of it; the number of answers that are not as expected.
int live(int thread, MPI_Comm comm, const std::vector<int>& expected) {
    Cloud cloud(thread, comm);
    int wrong = cloud.parts(cloud.zz) == expected ? 0 : 1;
    Zoltan_Struct* copy = Zoltan_Copy(cloud.zz);
    wrong += wrong_look_ups(cloud, cloud.zz, expected) + wrong_look_ups(cloud, copy, expected);
    Zoltan_Destroy(&copy);
    return wrong;
}

TEST(Threads, have_handles_of_their_own) {
    auto comms = make_communicators();
    std::array<std::vector<int>, num_threads> expected;
    for (int t = 0; t < num_threads; ++t) {
        const auto i = static_cast<std::size_t>(t);
        Cloud cloud(t, comms[i]);
        expected[i] = cloud.parts(cloud.zz);
        ASSERT_EQ(static_cast<int>(expected[i].size()), cloud.size());
    }
    std::atomic<int> wrong = 0;
    std::vector<std::thread> threads;
    for (int t = 0; t < num_threads; ++t) {
        threads.emplace_back([&, t] {
            const auto i = static_cast<std::size_t>(t);
            for (int round = 0; round < num_rounds; ++round)
                wrong += live(t, comms[i], expected[i]);
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, 0);
    free_communicators(comms);
}

/// Makes handles, asks each of them what it was told, and destroys them; the number of wrong
/// answers.
int make_and_ask(MPI_Comm alone, std::size_t expected_size) {
    int wrong = 0;
    std::array<Zoltan_Struct*, 24> handles{};
    for (Zoltan_Struct*& handle : handles) {
        handle = Zoltan_Create(alone);
        if (Zoltan_Set_Param(handle, "LB_METHOD", "RRCB") != ZOLTAN_OK) ++wrong;
        for (int again = 0; again < 250; ++again)
            if (Zoltan_Serialize_Size(handle) != expected_size) ++wrong;
    }
    for (Zoltan_Struct*& handle : handles) Zoltan_Destroy(&handle);
    return wrong;
}

std::size_t size_of_a_fresh_handle() {
    Zoltan_Struct* handle = Zoltan_Create(MPI_COMM_SELF);
    Zoltan_Set_Param(handle, "LB_METHOD", "RRCB");
    const std::size_t size = Zoltan_Serialize_Size(handle);
    Zoltan_Destroy(&handle);
    return size;
}

TEST(Threads, find_their_handles_among_those_that_come_and_go) {
    const std::size_t expected_size = size_of_a_fresh_handle();
    std::atomic<int> wrong = 0;
    std::vector<std::thread> threads;
    std::array<MPI_Comm, num_threads> alone{};
    for (MPI_Comm& comm : alone) MPI_Comm_dup(MPI_COMM_SELF, &comm);
    for (MPI_Comm comm : alone) {
        threads.emplace_back([&wrong, expected_size, comm] {
            for (int round = 0; round < 40; ++round) wrong += make_and_ask(comm, expected_size);
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, 0);
    free_communicators(alone);
}

/// Looks up in two handles in turns; returns the number of wrong answers.
int look_up_in_turns(int times) {
    Cloud one(0, MPI_COMM_SELF), other(1, MPI_COMM_SELF);
    const std::vector<int> of_one = one.parts(one.zz), of_other = other.parts(other.zz);
    int wrong = 0;
    for (int time = 0; time < times; ++time) {
        for (std::size_t i = 0; i < of_one.size(); ++i) {
            int rank = -1, part = -1;
            Zoltan_LB_Point_PP_Assign(one.zz, &one.coordinates[2 * i], &rank, &part);
            wrong += part == of_one[i] ? 0 : 1;
            Zoltan_LB_Point_PP_Assign(other.zz, &other.coordinates[2 * i], &rank, &part);
            wrong += part == of_other[i] ? 0 : 1;
        }
    }
    return wrong;
}

TEST(Threads, look_up_while_another_makes_handles) {
    std::atomic<int> wrong = 0;
    std::vector<std::thread> others;
    for (int t = 0; t < 2; ++t) others.emplace_back([&] { wrong += look_up_in_turns(2000); });
    for (int i = 0; i < 40; ++i) {
        Zoltan_Struct* handle = Zoltan_Create(MPI_COMM_SELF);
        Zoltan_Destroy(&handle);
    }
    for (std::thread& thread : others) thread.join();
    EXPECT_EQ(wrong, 0);
}

// Beside busy threads each yield may take milliseconds.
TEST(Threads, make_handles_of_a_single_rank_without_yielding) {
    num_yields = 0;
    for (int i = 0; i < 100; ++i) {
        Zoltan_Struct* handle = Zoltan_Create(MPI_COMM_SELF);
        Zoltan_Destroy(&handle);
    }
    EXPECT_EQ(num_yields, 0);
}

// Zoltan gives every copy a communicator of its own.
TEST(Threads, may_share_out_the_copies_of_a_handle) {
    auto comms = make_communicators();
    std::array<std::unique_ptr<Cloud>, num_threads> clouds;
    for (std::size_t t = 0; t < clouds.size(); ++t)
        clouds[t] = std::make_unique<Cloud>(0, comms[t]);
    const std::vector<int> expected = clouds[0]->parts(clouds[0]->zz);
    std::array<Zoltan_Struct*, num_threads> copies{};
    for (std::size_t t = 0; t < copies.size(); ++t) {
        copies[t] = Zoltan_Copy(clouds[0]->zz);
        clouds[t]->register_callbacks(copies[t]);
    }
    std::atomic<int> wrong = 0;
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < copies.size(); ++t) {
        threads.emplace_back([&, t] {
            for (int round = 0; round < num_rounds; ++round)
                if (clouds[t]->parts(copies[t]) != expected) ++wrong;
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, 0);
    for (Zoltan_Struct*& copy : copies) Zoltan_Destroy(&copy);
    clouds = {};
    free_communicators(comms);
}

}  // namespace
}  // namespace rrcb::zoltan_test

int main(int argc, char** argv) {
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_MULTIPLE, &provided);
    testing::InitGoogleTest(&argc, argv);
    int result = 77;
    if (provided == MPI_THREAD_MULTIPLE) {
        result = RUN_ALL_TESTS();
        MPI_Allreduce(MPI_IN_PLACE, &result, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    } else {
        std::printf("Skipped: this MPI has no MPI_THREAD_MULTIPLE.\n");
    }
    MPI_Finalize();
    return result;
}
