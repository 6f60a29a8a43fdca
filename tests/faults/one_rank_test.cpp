// Calls of MPI, and allocations at the first call with a communicator, that fail on one rank alone
// where it can still tell the others.
#include "clouds.hpp"
#include "failing_memory.hpp"
#include "mpi_layer.hpp"

#include <rrcb/rrcb.hpp>

namespace rrcb {
namespace {

using test::largest;
using test::same_on_all_ranks;

constexpr int ok = -1;

/// A communicator that the library does not know yet, on which errors return.
class NewCommunicator {
  public:
    NewCommunicator() {
        PMPI_Comm_dup(MPI_COMM_WORLD, &comm_);
        PMPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN);
    }
    NewCommunicator(const NewCommunicator&) = delete;
    NewCommunicator& operator=(const NewCommunicator&) = delete;
    ~NewCommunicator() { MPI_Comm_free(&comm_); }

    MPI_Comm get() const { return comm_; }

  private:
    MPI_Comm comm_ = MPI_COMM_NULL;
};

/// Code of the Error of a first call with `comm`, ok when there is none.
int code_of_balance(MPI_Comm comm) {
    static const std::vector<double> coordinates =
        test::uniform_cloud(50, 2, static_cast<unsigned>(rank() + 1));
    try {
        Options options{.refine = Refine::exact};
        balance(Points(coordinates, 2), comm, options);
        return ok;
    } catch (const Error& error) {
        return static_cast<int>(error.code());
    }
}

/// `arm(number)` makes a call fail on the last rank, 0 none, and `counted` tells how many there
/// are.
void fail_each(const std::function<void(long)>& arm, const std::function<long()>& counted,
               ErrorCode expected, long most) {
    arm(0);
    EXPECT_EQ(code_of_balance(NewCommunicator().get()), ok);
    const int num_calls = largest(static_cast<int>(std::min(counted(), most)));
    ASSERT_GT(num_calls, 0);
    for (int number = 1; number <= num_calls; ++number) {
        SCOPED_TRACE(number);
        const NewCommunicator comm;
        arm(is_last_rank() ? number : 0);
        const int code = code_of_balance(comm.get());
        arm(0);
        EXPECT_TRUE(same_on_all_ranks(code)) << code;
        EXPECT_EQ(code, static_cast<int>(expected));
        EXPECT_EQ(code_of_balance(comm.get()), ok);
    }
}

TEST(OneRank, tells_of_a_type_reduction_or_attribute_that_it_could_not_make) {
    constexpr long all = 1000;
    fail_each(mpi_layer::fail_local_call, mpi_layer::counted_local_calls, ErrorCode::mpi, all);
}

TEST(OneRank, tells_of_a_communicator_that_it_could_not_duplicate) {
    fail_each(mpi_layer::fail_call, mpi_layer::counted_calls, ErrorCode::mpi, 1);
}

TEST(OneRank, tells_of_memory_that_it_lacks_to_keep_a_communicator) {
    constexpr long of_the_duplicate = 3;
    fail_each([](long number) { memory_layer::fail_allocation(number); },
              [] { return memory_layer::counted_allocations(); }, ErrorCode::out_of_memory,
              of_the_duplicate);
}

}  // namespace
}  // namespace rrcb
