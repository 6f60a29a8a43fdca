// An MPI whose greatest tag is the least that the standard allows: the functions by which the
// library sends and receives refuse any other.
#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/experimental/join_keys.hpp>
#include <rrcb/rrcb.hpp>

namespace {

constexpr int least_tag_ub = 32767;
int greatest_tag = 0;

/// Returns the error of an MPI that has no such tag, else MPI_SUCCESS.
int code_of(int tag) {
    greatest_tag = std::max(greatest_tag, tag);
    return tag <= least_tag_ub && tag >= std::min(0, MPI_ANY_TAG) ? MPI_SUCCESS : MPI_ERR_TAG;
}

}  // namespace

extern "C" {

int MPI_Comm_get_attr(MPI_Comm comm, int key, void* value, int* flag) {
    static int least = least_tag_ub;
    const int code = PMPI_Comm_get_attr(comm, key, value, flag);
    if (key == MPI_TAG_UB && *flag != 0) *static_cast<void**>(value) = &least;
    return code;
}

int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request* request) {
    const int code = code_of(tag);
    return code != MPI_SUCCESS ? code : PMPI_Isend(data, count, type, to, tag, comm, request);
}

int MPI_Recv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
             MPI_Status* status) {
    const int code = code_of(tag);
    return code != MPI_SUCCESS ? code : PMPI_Recv(data, count, type, from, tag, comm, status);
}

int MPI_Irecv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
              MPI_Request* request) {
    const int code = code_of(tag);
    return code != MPI_SUCCESS ? code : PMPI_Irecv(data, count, type, from, tag, comm, request);
}

int MPI_Iprobe(int from, int tag, MPI_Comm comm, int* flag, MPI_Status* status) {
    const int code = code_of(tag);
    return code != MPI_SUCCESS ? code : PMPI_Iprobe(from, tag, comm, flag, status);
}
}

namespace rrcb {
namespace {

/// Calls all that sends between two ranks once.
void call_all(const std::vector<double>& cloud, const Options& options) {
    const Points points(cloud, 2);
    Balance made = balance(points, MPI_COMM_WORLD, options);
    balance_into(made, points, MPI_COMM_WORLD, options, made.cuts);
    made.parts = assign(made.cuts, points, MPI_COMM_WORLD);
    const Plan moves = plan(made, MPI_COMM_WORLD);
    const std::vector<double> mine = transfer(moves, column(cloud, 2), MPI_COMM_WORLD);
    const Points moved(mine, 2);
    const GhostPlan near = ghost_plan(made.cuts, moved, MPI_COMM_WORLD, {.cutoff = 0.1});
    const std::vector<double> others = fetch(near, column(mine, 2), MPI_COMM_WORLD);
    EXPECT_EQ(others.size() % 2, 0U);
    const std::vector<std::uint64_t> keys(2 * moved.count, 7);
    const Groups one =
        groups(moved, experimental::join_keys(keys, 2, MPI_COMM_WORLD), MPI_COMM_WORLD);
    EXPECT_EQ(to_points(one, std::vector<int>(one.weights.size(), 3), MPI_COMM_WORLD),
              std::vector<int>(moved.count, 3));
}

TEST(LeastTags, are_enough_for_any_number_of_calls) {
    const std::vector<double> cloud = test::uniform_cloud(50, 2, static_cast<unsigned>(rank()));
    Options by_root;
    const Options by_many{.expert = {.max_root_parts = 2}};
    // More calls than the numbers that tags distinguish, of every kind.
    for (int round = 0; round < 12; ++round) {
        call_all(cloud, by_root);
        call_all(cloud, by_many);
    }
    if (num_ranks() > 1) {
        EXPECT_GT(greatest_tag, 100) << "no tag of a meeting was seen";
    }
}

}  // namespace
}  // namespace rrcb
