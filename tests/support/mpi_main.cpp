// Runs every test on all ranks; rank 0 reports, other ranks speak only when they fail.
// Floating-point exceptions end a test, unless RRCB_TEST_TRAPS=OFF: some programs trap them.
#include "common.hpp"

#include <cfenv>
#include <cstdlib>

#ifdef __SANITIZE_ADDRESS__
// MPI's modules stay loaded to the end, when the sanitizer asks whose leaks are theirs.
extern "C" int dlclose(void*) {
    return 0;
}
#endif

namespace {

void trap_exceptions() {
#ifdef __GLIBC__
    const char* value = std::getenv("RRCB_TEST_TRAPS");
    if (value == nullptr || std::strcmp(value, "OFF") != 0)
        feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
#endif
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    trap_exceptions();
    testing::InitGoogleTest(&argc, argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank != 0) {
        testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
        delete listeners.Release(listeners.default_result_printer());
        struct FailurePrinter : testing::EmptyTestEventListener {
            void OnTestPartResult(const testing::TestPartResult& result) override {
                if (!result.failed()) return;
                MPI_Comm_rank(MPI_COMM_WORLD, &rank);
                std::fprintf(stderr, "[rank %d] %s:%d: %s\n", rank, result.file_name(),
                             result.line_number(), result.message());
            }
            int rank = 0;
        };
        listeners.Append(new FailurePrinter);
    }
    int failed = RUN_ALL_TESTS();
    MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    MPI_Finalize();
    return failed;
}
