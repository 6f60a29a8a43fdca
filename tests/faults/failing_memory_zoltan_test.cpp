// Memory that runs short in a partitioning call of a Zoltan program.
#include "failing_memory.hpp"
#include "program.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <filesystem>
#include <string_view>

namespace {
long num_arrays = 0;  // that the plug-in asked Zoltan's allocator for
}

// Zoltan's allocator, as the plug-in reaches it for the arrays of lists; Zoltan's own calls of it
// are let alone, since Zoltan does not survive a shortage on one rank.
extern "C" double* Zoltan_Malloc(std::size_t size, char* file, int line) {
    using Function = double*(std::size_t, char*, int);
    static auto* const real = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, "Zoltan_Malloc"));
    const bool is_plug_in = std::strcmp(file, "zoltan_array.hpp") == 0;
    num_arrays += is_plug_in ? 1 : 0;
    return is_plug_in && memory_layer::next_fails() ? nullptr : real(size, file, line);
}

namespace rrcb {
namespace {

using test::FailingMemory;
using zoltan_test::ListCopy;
using zoltan_test::Outcome;
using zoltan_test::Program;

/// A program whose own memory is made before the call, and let alone in it.
struct ShortProgram : Program {
    ShortProgram() {
        zoltan_test::scatter_points(*this, 40);
        set("LB_METHOD", "RRCB");
        set("OBJ_WEIGHT_DIM", "1");
        first_otherwise = std::nextafter(coordinates[0], 2.0);
    }

    /// Code of a call of LB_Partition, with its lists in the program's raw ones.
    int call() {
        free_lists();
        // On one rank objects at rest would be recognized, which takes no memory.
        std::swap(coordinates[0], first_otherwise);
        RawList& in = raw_imports;
        RawList& out = raw_exports;
        int widths[2];
        return Zoltan_LB_Partition(zz, &changes, &widths[0], &widths[1], &in.count, &in.global_ids,
                                   &in.local_ids, &in.ranks, &in.parts, &out.count, &out.global_ids,
                                   &out.local_ids, &out.ranks, &out.parts);
    }

    std::vector<int> listed() const {
        std::vector<int> all{changes, raw_imports.count, raw_exports.count};
        for (const RawList* list : {&raw_imports, &raw_exports})
            for (int i = 0; i < list->count; ++i) all.push_back(list->parts[i]);
        return all;
    }

    int changes = 0;
    double first_otherwise = 0;  ///< the first coordinate in every other call
};

void fail_in_partition(ShortProgram& program, int success = ZOLTAN_OK) {
    ASSERT_EQ(program.call(), success);
    const std::vector<int> expected = program.listed();
    FailingMemory(
        {success, ZOLTAN_MEMERR}, [&] { return program.call(); },
        [&] { EXPECT_EQ(program.listed(), expected); })
        .run();
}

TEST(FailingMemoryInZoltan, whatever_lists_are_asked_for) {
    for (const char* lists : {"ALL", "EXPORT", "IMPORT", "PARTS", "NONE"}) {
        SCOPED_TRACE(lists);
        ShortProgram program;
        program.set("RETURN_LISTS", lists);
        num_arrays = 0;
        fail_in_partition(program);
        // Room for a list that no agreement follows is made before it is known whether any object
        // moves.
        const std::string_view asked = lists;
        const bool makes_room = asked == "EXPORT" || asked == "PARTS";
        EXPECT_EQ(num_arrays > 0, makes_room || (asked != "NONE" && program.num_ranks > 1));
    }
}

TEST(FailingMemoryInZoltan, with_all_that_takes_memory) {
    ShortProgram program;
    program.set("RETURN_LISTS", "EXPORT");
    program.set("RRCB_REFINE", "EXACT");
    program.set("KEEP_CUTS", "1");
    program.set("RCB_SET_DIRECTIONS", "2");
    program.set("OBJ_WEIGHT_DIM", "1");
    program.set("NUM_LOCAL_PARTS", "2");
    fail_in_partition(program);
}

TEST(FailingMemoryInZoltan, with_cuts_that_are_spread_over_the_ranks) {
    for (const bool keeps_cuts : {true, false}) {
        ShortProgram program;
        // On fewer every allocation would be tried, which takes long.
        if (program.num_ranks <= 3) return;
        program.set("RRCB_CENTRAL_PARTS", "2");
        program.set("RRCB_COINCIDENT", "TOGETHER");
        program.set("NUM_GLOBAL_PARTS", "9");
        program.set("KEEP_CUTS", keeps_cuts ? "1" : "0");
        if (!keeps_cuts) program.set("RETURN_LISTS", "NONE");
        fail_in_partition(program);
    }
}

TEST(FailingMemoryInZoltan, with_parts_of_different_sizes) {
    ShortProgram program;
    program.set("RETURN_LISTS", "PARTS");
    int part = 0;
    float size = 2;
    Zoltan_LB_Set_Part_Sizes(program.zz, 1, 1, &part, nullptr, &size);
    fail_in_partition(program);
}

int num_packed = 0;

void let_objects_migrate(Program& program) {
    ZOLTAN_OBJ_SIZE_FN* size = [](void*, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR, int* code) {
        *code = ZOLTAN_OK;
        return 8;
    };
    ZOLTAN_PACK_OBJ_FN* pack = [](void*, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR, int, int, char*,
                                  int* code) {
        *code = ZOLTAN_OK;
        ++num_packed;
    };
    ZOLTAN_UNPACK_OBJ_FN* unpack = [](void*, int, ZOLTAN_ID_PTR, int, char*, int* code) {
        *code = ZOLTAN_OK;
    };
    Zoltan_Set_Obj_Size_Fn(program.zz, size, nullptr);
    Zoltan_Set_Pack_Obj_Fn(program.zz, pack, nullptr);
    Zoltan_Set_Unpack_Obj_Fn(program.zz, unpack, nullptr);
    program.set("AUTO_MIGRATE", "1");
}

TEST(FailingMemoryInZoltan, moves_all_objects_or_none) {
    ShortProgram program;
    let_objects_migrate(program);
    program.set("RRCB_REFINE", "NONE");
    FailingMemory(
        {ZOLTAN_OK, ZOLTAN_MEMERR},
        [&] {
            num_packed = 0;
            const int code = program.call();
            EXPECT_TRUE(code == ZOLTAN_OK || num_packed == 0) << num_packed;
            return code;
        },
        [&] { EXPECT_EQ(num_packed, program.raw_exports.count); })
        .run();
}

TEST(FailingMemoryInZoltan, while_inputs_of_failing_calls_are_written) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() /
        ("rrcb_failing_memory_" + std::to_string(getppid()) + "_" + std::to_string(rank()));
    {
        ShortProgram program;
        program.set("RETURN_LISTS", "NONE");
        program.set("RRCB_REFINE", "NONE");
        program.set("RRCB_DUMP", folder.string());
        program.set("RRCB_DUMP_WHEN", "ALWAYS");
        program.call();  // the folder is remembered
        program.set("RRCB_DUMP_WHEN", "FAILURE");
        fail_in_partition(program);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_TRUE(rank() != 0 || std::filesystem::exists(folder / "call-1" / "call.txt"));
    std::filesystem::remove_all(folder);
}

/// A handle's creation may fail as a whole; then RRCB can be chosen on no rank.
TEST(FailingMemoryInZoltan, while_a_handle_is_made) {
    Zoltan_Struct* zz = nullptr;
    FailingMemory(
        {ZOLTAN_OK, ZOLTAN_FATAL},
        [&] {
            zz = Zoltan_Create(MPI_COMM_WORLD);
            memory_layer::fail_allocation(0);
            Zoltan_Set_Param(zz, "DEBUG_LEVEL", "0");
            const int code = Zoltan_Set_Param(zz, "LB_METHOD", "RRCB");
            Zoltan_Destroy(&zz);
            return code;
        },
        [] {})
        .run();
}

}  // namespace
}  // namespace rrcb
