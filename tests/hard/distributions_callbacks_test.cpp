#include "../support/ranks.hpp"
#include "../zoltan/program.hpp"
#include "checks_mpi.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace rrcb::hard_test {
namespace {

using test::rank;
using zoltan_test::ListCopy;
using zoltan_test::Outcome;
using zoltan_test::Program;

std::vector<std::uint64_t> hashes_of(const ListCopy& list) {
    std::vector<std::uint64_t> hashes;
    for (const auto& id : list.global_ids)
        hashes.push_back(journey(id[0], int(id[1]), 0, int(id[2])));
    return hashes;
}

TEST(CallbackDistributions, with_several_words_per_id_and_no_local_ids) {
    Program program(3);
    scatter_points(program, 100);
    program.set("LB_METHOD", "RRCB");
    program.set("NUM_GID_ENTRIES", "3");
    program.set("NUM_LID_ENTRIES", "0");
    program.set("RETURN_LISTS", "ALL");
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    EXPECT_EQ(outcome.num_gid, 3);
    EXPECT_FALSE(outcome.exports.has_local_ids || outcome.imports.has_local_ids);
    expect_same_in_all(hashes_of(outcome.exports), hashes_of(outcome.imports));
    for (const auto& id : outcome.exports.global_ids) {
        EXPECT_EQ(id[1], ZOLTAN_ID_TYPE(rank()));
        EXPECT_EQ(id[2], 7 * id[0] + ZOLTAN_ID_TYPE(rank()));
    }
}

TEST(CallbackDistributions, of_any_number_and_size_of_parts) {
    for (const std::vector<float>& sizes :
         {std::vector<float>{1}, {0, 1}, {1, 0, 0, 2, 1}, {5, 1, 1, 1, 0, 1, 1, 2, 2, 1, 1}}) {
        Program program;
        scatter_points(program, 100);
        const int num_parts = static_cast<int>(sizes.size());
        program.set("LB_METHOD", "RRCB");
        program.set("RRCB_REFINE", "EXACT");
        program.set("RETURN_LISTS", "PARTS");
        program.set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
        std::vector<int> parts(sizes.size());
        std::vector<int> weights(sizes.size());
        std::iota(parts.begin(), parts.end(), 0);
        std::vector<float> given = sizes;
        Zoltan_LB_Set_Part_Sizes(program.zz, 1, num_parts, parts.data(), weights.data(),
                                 given.data());
        const Outcome outcome = program.partition();
        EXPECT_EQ(outcome.code, ZOLTAN_OK);
        std::vector<int> counts(sizes.size());
        std::vector<int> found(100, rank() * num_parts / program.num_ranks);
        if (outcome.changes != 0) found = parts_by_object(outcome);
        for (const int part : found) ++counts[static_cast<std::size_t>(part)];
        MPI_Allreduce(MPI_IN_PLACE, counts.data(), num_parts, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
        const float all = std::accumulate(sizes.begin(), sizes.end(), 0.0F);
        for (std::size_t part = 0; part < sizes.size(); ++part)
            EXPECT_NEAR(counts[part],
                        100.0 * program.num_ranks * static_cast<double>(sizes[part] / all),
                        sizes[part] > 0 ? 2 : 0);
    }
}

}  // namespace
}  // namespace rrcb::hard_test
