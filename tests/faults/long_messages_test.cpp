// What exceeds MPI's counts, with a limit low enough to be exceeded here.
#include "clouds.hpp"
#include "collective/communicator.hpp"
#include "mpi_layer.hpp"
#include "ranks.hpp"

#include <rrcb/rrcb.hpp>

#include <gtest/gtest.h>

#include <numeric>

namespace rrcb {
namespace {

constexpr std::size_t limit = 64;

/// Lowers the limit in its scope, and sees to it that the messages keep to it.
class ShortMessages {
  public:
    ShortMessages() {
        mpi::longest_message = limit;
        mpi_layer::fail_call(0);
    }
    ~ShortMessages() {
        mpi::longest_message = before_;
        EXPECT_LE(mpi_layer::longest_message(), static_cast<std::int64_t>(limit));
    }
    ShortMessages(const ShortMessages&) = delete;
    ShortMessages& operator=(const ShortMessages&) = delete;

  private:
    std::size_t before_ = mpi::longest_message;
};

TEST(LongMessages, are_broadcast_in_pieces) {
    for (const std::size_t size : {std::size_t{0}, limit - 1, limit, 10 * limit + 1}) {
        std::vector<std::byte> expected(size);
        for (std::size_t i = 0; i < size; ++i) expected[i] = static_cast<std::byte>(i % 251);
        const bool sends = is_last_rank();
        std::vector<std::byte> bytes = sends ? expected : std::vector<std::byte>(size);
        const ShortMessages pieces;
        mpi::broadcast(bytes, num_ranks() - 1, MPI_COMM_WORLD);
        EXPECT_EQ(bytes, expected);
    }
}

TEST(LongMessages, give_the_same_plan_in_pieces) {
    const int num_ranks = test::num_ranks();
    std::vector<Part> parts(static_cast<std::size_t>(50 + 7 * rank()));
    std::iota(parts.begin(), parts.end(), rank());
    for (Part& part : parts) part %= num_ranks;
    const Plan expected = plan(parts, num_ranks, MPI_COMM_WORLD);
    const ShortMessages pieces;
    const Plan result = plan(parts, num_ranks, MPI_COMM_WORLD);
    EXPECT_EQ(result.export_indices, expected.export_indices);
    EXPECT_EQ(result.export_ranks, expected.export_ranks);
    EXPECT_EQ(result.import_ranks, expected.import_ranks);
    EXPECT_EQ(result.import_indices, expected.import_indices);
    EXPECT_EQ(result.import_parts, expected.import_parts);
}

TEST(LongMessages, move_the_same_columns_in_pieces) {
    std::vector<Part> parts(static_cast<std::size_t>(50 + 7 * rank()));
    for (std::size_t i = 0; i < parts.size(); ++i)
        parts[i] = (rank() + static_cast<Part>(i * i)) % num_ranks();
    const Plan lists = plan(parts, num_ranks(), MPI_COMM_WORLD);
    std::vector<double> positions(2 * parts.size());
    std::iota(positions.begin(), positions.end(), 1000 * rank());
    const auto both = columns(parts, column(positions, 2));
    const auto expected = transfer(lists, both, MPI_COMM_WORLD);
    const ShortMessages pieces;
    EXPECT_EQ(transfer(lists, both, MPI_COMM_WORLD), expected);
}

}  // namespace
}  // namespace rrcb
