#include "../support/held_memory.hpp"
#include "../support/mpi_handles.hpp"
#include "same_lists.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace rrcb::zoltan_test {
namespace {

TEST(Forwarding, leaves_look_ups_of_rcb_to_zoltan) {
    Program untouched, switched;
    for (Program* program : {&untouched, &switched}) {
        scatter_points(*program, 300);
        program->set({{"KEEP_CUTS", "1"}, {"NUM_GLOBAL_PARTS", "9"}});
    }
    switched.set("LB_METHOD", "RRCB");
    switched.partition();
    switched.set("LB_METHOD", "RCB");
    switched.partition();
    untouched.partition();
    for (std::size_t i = 0; i < untouched.coordinates.size(); i += 2) {
        const double* x = &untouched.coordinates[i];
        EXPECT_EQ(switched.place_of(x), untouched.place_of(x));
    }
}

TEST(Handles, copies_keep_method_parameters_sizes_and_cuts) {
    Scattered program(300);
    program.set({{"LB_METHOD", "RRCB"}, {"RRCB_DOMAIN", "SAMPLED"}, {"NUM_GLOBAL_PARTS", "5"}});
    program.set("KEEP_CUTS", "1");
    program.set_size(1, 2);
    const Outcome original = program.partition();

    Zoltan_Struct* copy = Zoltan_Copy(program.zz);
    Zoltan_Struct* assigned = Zoltan_Create(MPI_COMM_WORLD);
    ASSERT_EQ(Zoltan_Copy_To(assigned, program.zz), ZOLTAN_OK);
    for (Zoltan_Struct* handle : {copy, assigned}) {
        const Place found = program.place_of(program.coordinates.data(), handle);
        EXPECT_EQ(found.code, ZOLTAN_OK);
        EXPECT_EQ(found, program.place_of(program.coordinates.data()));
        expect_same(program.partition(handle), original);
    }
    // A copy goes its own way, and lives on when the original is gone.
    Zoltan_Set_Param(copy, "LB_METHOD", "RCB");
    expect_same(program.partition(), original);
    Zoltan_Destroy(&program.zz);
    expect_same(program.partition(assigned), original);
    Zoltan_Destroy(&copy);
    Zoltan_Destroy(&assigned);
    EXPECT_EQ(assigned, nullptr);
}

TEST(Handles, let_zoltan_evaluate_under_rrcb) {
    Scattered program(200, {{"LB_METHOD", "RRCB"}, {"OBJ_WEIGHT_DIM", "1"}});
    const Outcome before = program.partition();
    ZOLTAN_BALANCE_EVAL evaluation;
    EXPECT_EQ(Zoltan_LB_Eval(program.zz, 0, &evaluation, nullptr, nullptr), ZOLTAN_OK);
    EXPECT_EQ(evaluation.nobj[EVAL_GLOBAL_SUM], 200.0F * static_cast<float>(program.num_ranks));
    expect_same(program.partition(), before);
}

TEST(Handles, free_every_communicator_and_do_not_gather_more_by_repeated_calls) {
    const test::MpiHandles at_start = test::mpi_handles();
    {
        Scattered program(500, {{"LB_METHOD", "RRCB"}});
        for (const char* name : {"KEEP_CUTS", "RCB_REUSE", "RCB_LOCK_DIRECTIONS"})
            program.set(name, "1");
        program.partition();
        Zoltan_Struct* copy = Zoltan_Copy(program.zz);
        program.partition(copy);
        const test::MpiHandles after_first = test::mpi_handles();
        repeat(program, 20);
        const test::HeldMemory before;
        EXPECT_GT(before.blocks, 0);
        EXPECT_GT(before.bytes_of_zoltan, 0);
        repeat(program, 200);
        EXPECT_EQ(test::mpi_handles(), after_first);
        test::expect_no_growth(before, 200);
        Zoltan_Destroy(&copy);
    }
    EXPECT_EQ(test::mpi_handles().communicators, at_start.communicators);
}

TEST(Handles, keep_the_memory_for_each_object) {
    Scattered program(150'000, {{"LB_METHOD", "RRCB"}, {"RRCB_SUPPORT_MESH", "4"}});
    const auto call = [&] {
        int changes = 0, num_gid = 0, num_lid = 0;
        Program::RawList imports, exports;
        memory_layer::restart_peak();
        EXPECT_EQ(Zoltan_LB_Partition(program.zz, &changes, &num_gid, &num_lid, &imports.count,
                                      &imports.global_ids, &imports.local_ids, &imports.ranks,
                                      &imports.parts, &exports.count, &exports.global_ids,
                                      &exports.local_ids, &exports.ranks, &exports.parts),
                  ZOLTAN_OK);
        for (Program::RawList* list : {&imports, &exports})
            Zoltan_LB_Free_Part(&list->global_ids, &list->local_ids, &list->ranks, &list->parts);
        return memory_layer::peak_bytes();
    };
    EXPECT_GT(call(), 16L * program.size()) << "coordinates";
    for (int k = 0; k < 3; ++k) EXPECT_LT(call(), 2L * program.size()) << k;
#ifndef __SANITIZE_ADDRESS__
    if (program.num_ranks > 1) return;  // lists, which are handed out, and messages touch pages
    rusage before{}, after{};
    getrusage(RUSAGE_THREAD, &before);
    call();
    getrusage(RUSAGE_THREAD, &after);
    EXPECT_LE(after.ru_minflt - before.ru_minflt, 8);
#endif
}

TEST(Handles, migrate_automatically_as_with_rcb) {
    for (const char* method : {"RCB", "RRCB"}) {
        SCOPED_TRACE(method);
        Scattered program(100);
        Migration migration;
        count_migration(program.zz, migration);
        program.set({{"AUTO_MIGRATE", "1"}, {"LB_METHOD", method}});
        const Outcome outcome = program.partition();
        EXPECT_EQ(migration.packed, outcome.exports.count);
        EXPECT_EQ(migration.unpacked, outcome.imports.count);
        EXPECT_EQ(migration.packed > 0, program.num_ranks > 1);
    }
}

TEST(Handles, serialized_from_rcb_work_and_do_not_switch_to_rrcb) {
    Scattered program(200, {{"LB_METHOD", "RCB"}, {"KEEP_CUTS", "1"}});
    program.partition();
    Program copy;
    ASSERT_EQ(unpack(copy.zz, bytes_of(program.zz)), ZOLTAN_OK);
    EXPECT_EQ(program.place_of(program.coordinates.data(), copy.zz),
              program.place_of(program.coordinates.data()));
    EXPECT_EQ(copy.set("LB_METHOD", "RRCB"), ZOLTAN_FATAL);
}

TEST(Handles, work_on_a_part_of_the_ranks) {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm half = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, rank % 2, 0, &half);
    Scattered program(200);
    Zoltan_Struct* handle = Zoltan_Create(half);
    PMPI_Comm_free(&half);
    program.register_callbacks(handle);
    Zoltan_Set_Param(handle, "LB_METHOD", "RRCB");
    Zoltan_Set_Param(handle, "RETURN_LISTS", "PARTS");
    const Outcome outcome = program.partition(handle);
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    EXPECT_EQ(outcome.exports.count, 200);
    Zoltan_Destroy(&handle);
}

}  // namespace
}  // namespace rrcb::zoltan_test
