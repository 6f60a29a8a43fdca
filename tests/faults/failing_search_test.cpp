#include "../mpi/search_level.hpp"
#include "failing_memory.hpp"

namespace rrcb {
namespace {

TEST(FailingMemory, in_the_search_of_a_level_is_told_before_it_ends) {
    test::Level level;
    Participant agreeing{MPI_COMM_WORLD};
    level.run(agreeing);
    const Cut expected = level.search().cut;
    const auto run = [&] {
        Participant self{MPI_COMM_WORLD};
        try {
            level.run(self);
        } catch (const Error& error) {
            return static_cast<int>(error.code());
        }
        EXPECT_FALSE(self.failed()) << "no other rank knows";
        return -1;
    };
    test::FailingMemory({-1, static_cast<int>(ErrorCode::out_of_memory)}, run, [&] {
        EXPECT_EQ(level.search().cut.at, expected.at);
    }).run();
}

}  // namespace
}  // namespace rrcb
