#include "../support/held_memory.hpp"
#include "communicators.hpp"
#include "same_lists.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace rrcb::zoltan_test {
namespace {

void expect_same(const Outcome& a, const Outcome& b) {
    EXPECT_EQ(a.code, b.code);
    EXPECT_EQ(a.changes, b.changes);
    expect_same(a.imports, b.imports);
    expect_same(a.exports, b.exports);
}

TEST(Forwarding, leaves_other_methods_as_they_are_on_a_handle_that_never_saw_rrcb) {
    for (const char* method : {"RCB", "RIB", "HSFC", "BLOCK"}) {
        SCOPED_TRACE(method);
        Program untouched, switched;
        scatter_points(untouched, 300);
        scatter_points(switched, 300);
        switched.set("LB_METHOD", "RRCB");
        switched.set("RRCB_DOMAIN", "SAMPLED");
        EXPECT_EQ(switched.partition().code, ZOLTAN_OK);
        for (Program* program : {&untouched, &switched}) {
            EXPECT_EQ(program->set("LB_METHOD", method), ZOLTAN_OK);
        }
        expect_same(switched.partition(), untouched.partition());
    }
}

TEST(Forwarding, leaves_look_ups_of_rcb_to_zoltan) {
    Program untouched, switched;
    scatter_points(untouched, 300);
    scatter_points(switched, 300);
    switched.set("KEEP_CUTS", "1");
    switched.set("NUM_GLOBAL_PARTS", "9");
    switched.set("LB_METHOD", "RRCB");
    switched.partition();
    switched.set("LB_METHOD", "RCB");
    untouched.set("KEEP_CUTS", "1");
    untouched.set("NUM_GLOBAL_PARTS", "9");
    switched.partition();
    untouched.partition();
    for (std::size_t i = 0; i < untouched.coordinates.size(); i += 2) {
        int expected = -1, found = -2;
        Zoltan_LB_Point_PP_Assign(untouched.zz, &untouched.coordinates[i], nullptr, &expected);
        Zoltan_LB_Point_PP_Assign(switched.zz, &untouched.coordinates[i], nullptr, &found);
        EXPECT_EQ(found, expected);
    }
}

TEST(Handles, give_the_same_when_asked_again_or_switched_back) {
    Program program;
    scatter_points(program, 300);
    program.set("LB_METHOD", "RRCB");
    const Outcome first = program.partition();
    expect_same(program.partition(), first);
    program.set("LB_METHOD", "RIB");
    program.partition();
    program.set("LB_METHOD", "RRCB");
    expect_same(program.partition(), first);
}

TEST(Handles, are_independent_of_each_other) {
    Program one, other;
    scatter_points(one, 300);
    scatter_points(other, 300);
    one.set("LB_METHOD", "RRCB");
    one.set("NUM_GLOBAL_PARTS", "3");
    other.set("LB_METHOD", "RCB");
    const Outcome zoltans = other.partition();
    one.partition();
    expect_same(other.partition(), zoltans);
}

TEST(Handles, copies_keep_method_parameters_sizes_and_cuts) {
    Program program;
    scatter_points(program, 300);
    program.set("LB_METHOD", "RRCB");
    program.set("RRCB_DOMAIN", "SAMPLED");
    program.set("NUM_GLOBAL_PARTS", "5");
    program.set("KEEP_CUTS", "1");
    int part = 1;
    float size = 2;
    Zoltan_LB_Set_Part_Sizes(program.zz, 1, 1, &part, nullptr, &size);
    const Outcome original = program.partition();

    Zoltan_Struct* copy = Zoltan_Copy(program.zz);
    Zoltan_Struct* assigned = Zoltan_Create(MPI_COMM_WORLD);
    ASSERT_EQ(Zoltan_Copy_To(assigned, program.zz), ZOLTAN_OK);
    for (Zoltan_Struct* handle : {copy, assigned}) {
        int expected = -1, found = -2;
        Zoltan_LB_Point_PP_Assign(program.zz, program.coordinates.data(), nullptr, &expected);
        EXPECT_EQ(Zoltan_LB_Point_PP_Assign(handle, program.coordinates.data(), nullptr, &found),
                  ZOLTAN_OK);
        EXPECT_EQ(found, expected);
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
    Program program;
    scatter_points(program, 200);
    program.set("LB_METHOD", "RRCB");
    program.set("OBJ_WEIGHT_DIM", "1");
    const Outcome before = program.partition();
    ZOLTAN_BALANCE_EVAL evaluation;
    EXPECT_EQ(Zoltan_LB_Eval(program.zz, 0, &evaluation, nullptr, nullptr), ZOLTAN_OK);
    EXPECT_EQ(evaluation.nobj[EVAL_GLOBAL_SUM], 200.0F * static_cast<float>(program.num_ranks));
    expect_same(program.partition(), before);
}

TEST(Handles, free_every_communicator_and_do_not_gather_more_by_repeated_calls) {
    const int at_start = num_communicators;
    {
        Program program;
        scatter_points(program, 500);
        program.set("LB_METHOD", "RRCB");
        program.set("KEEP_CUTS", "1");
        program.partition();
        Zoltan_Struct* copy = Zoltan_Copy(program.zz);
        program.partition(copy);
        const int after_first = num_communicators;
        repeat(program, 20);
        const test::HeldMemory before;
        EXPECT_GT(before.blocks, 0);
        EXPECT_GT(before.bytes_of_zoltan, 0);
        repeat(program, 200);
        EXPECT_EQ(num_communicators, after_first);
        test::expect_no_growth(before, 200);
        Zoltan_Destroy(&copy);
    }
    EXPECT_EQ(num_communicators, at_start);
}

TEST(Handles, keep_the_memory_for_each_object) {
    Program program;
    scatter_points(program, 150'000);
    program.set("LB_METHOD", "RRCB");
    program.set("RRCB_SUPPORT_MESH", "4");
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
        Program program;
        scatter_points(program, 100);
        static int num_packed, num_unpacked;
        num_packed = num_unpacked = 0;
        ZOLTAN_OBJ_SIZE_FN* size = [](void*, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR, int* code) {
            *code = ZOLTAN_OK;
            return static_cast<int>(sizeof(double));
        };
        ZOLTAN_PACK_OBJ_FN* pack = [](void*, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR, int, int,
                                      char*, int* code) {
            *code = ZOLTAN_OK;
            ++num_packed;
        };
        ZOLTAN_UNPACK_OBJ_FN* unpack = [](void*, int, ZOLTAN_ID_PTR, int, char*, int* code) {
            *code = ZOLTAN_OK;
            ++num_unpacked;
        };
        Zoltan_Set_Obj_Size_Fn(program.zz, size, nullptr);
        Zoltan_Set_Pack_Obj_Fn(program.zz, pack, nullptr);
        Zoltan_Set_Unpack_Obj_Fn(program.zz, unpack, nullptr);
        program.set("AUTO_MIGRATE", "1");
        program.set("LB_METHOD", method);
        const Outcome outcome = program.partition();
        EXPECT_EQ(num_packed, outcome.exports.count);
        EXPECT_EQ(num_unpacked, outcome.imports.count);
        EXPECT_EQ(num_packed > 0, program.num_ranks > 1);
    }
}

TEST(Handles, refuse_the_lists_that_zoltan_makes_for_itself) {
    Program program;
    scatter_points(program, 100);
    program.set("LB_METHOD", "RRCB");
    program.set("RETURN_LISTS", "CANDIDATE LISTS");
    EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
}

TEST(Handles, serialized_from_rcb_work_and_do_not_switch_to_rrcb) {
    Program program;
    scatter_points(program, 200);
    program.set("LB_METHOD", "RCB");
    program.set("KEEP_CUTS", "1");
    program.partition();
    const std::size_t size = Zoltan_Serialize_Size(program.zz);
    ASSERT_GT(size, 0U);
    std::vector<char> buffer(size);
    ASSERT_EQ(Zoltan_Serialize(program.zz, size, buffer.data()), ZOLTAN_OK);
    Zoltan_Struct* copy = Zoltan_Create(MPI_COMM_WORLD);
    ASSERT_EQ(Zoltan_Deserialize(copy, size, buffer.data()), ZOLTAN_OK);
    int expected = -1, found = -2;
    Zoltan_LB_Point_PP_Assign(program.zz, program.coordinates.data(), nullptr, &expected);
    Zoltan_LB_Point_PP_Assign(copy, program.coordinates.data(), nullptr, &found);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(Zoltan_Set_Param(copy, "LB_METHOD", "RRCB"), ZOLTAN_FATAL);
    Zoltan_Destroy(&copy);
}

TEST(Handles, work_on_a_part_of_the_ranks) {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm half = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, rank % 2, 0, &half);
    Program program;
    scatter_points(program, 200);
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
