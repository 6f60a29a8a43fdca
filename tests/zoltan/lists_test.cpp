#include "program.hpp"

namespace rrcb::zoltan_test {
namespace {

/// What Zoltan promises of a call beside the partition itself.
std::string shape_of(const ListCopy& list) {
    std::string shape = list.count < 0 ? "not asked" : list.count == 0 ? "empty" : "filled";
    if (list.has_global_ids) shape += " gids";
    if (list.has_local_ids) shape += " lids";
    if (list.has_ranks) shape += " ranks";
    if (list.has_parts) shape += " parts";
    return shape;
}

void expect_same_shape(const Outcome& ours, const Outcome& zoltans) {
    EXPECT_EQ(ours.changes, zoltans.changes);
    EXPECT_EQ(ours.num_gid, zoltans.num_gid);
    EXPECT_EQ(ours.num_lid, zoltans.num_lid);
    EXPECT_EQ(shape_of(ours.imports), shape_of(zoltans.imports));
    EXPECT_EQ(shape_of(ours.exports), shape_of(zoltans.exports));
}

Outcome partition_with(Program& program, const char* method) {
    EXPECT_EQ(program.set("LB_METHOD", method), ZOLTAN_OK);
    return program.partition();
}

/// Runs RCB and RRCB on the same handle. Without REMAP, part p of both lies on rank p.
void expect_shape_of_rcb(Program& program) {
    program.set("REMAP", "0");
    const Outcome zoltans = partition_with(program, "RCB");
    const Outcome ours = partition_with(program, "RRCB");
    EXPECT_EQ(ours.code, ZOLTAN_OK);
    expect_same_shape(ours, zoltans);
}

constexpr const char* words[] = {
    "ALL", "IMPORT", "EXPORT", "IMPORT AND EXPORT", "PARTS", "PARTITION ASSIGNMENTS", "NONE"};

TEST(Lists, have_the_shape_of_rcb_for_every_word_and_width_of_ids) {
    for (const char* word : words) {
        for (int gid = 1; gid <= 3; ++gid) {
            for (int lid = 0; lid <= 2; ++lid) {
                SCOPED_TRACE(std::string(word) + " " + std::to_string(gid) + std::to_string(lid));
                Scattered program(200);
                program.set({{"RETURN_LISTS", word}, {"NUM_GID_ENTRIES", std::to_string(gid)}});
                program.set("NUM_LID_ENTRIES", std::to_string(lid));
                expect_shape_of_rcb(program);
            }
        }
    }
}

TEST(Lists, have_the_shape_of_rcb_when_one_rank_holds_everything_or_nothing_changes) {
    for (const char* word : words) {
        SCOPED_TRACE(word);
        Program holder;
        holder.set("RETURN_LISTS", word);
        if (holder.rank == holder.num_ranks - 1) scatter_points(holder, 400);
        expect_shape_of_rcb(holder);
        Program program(1);
        program.set("RETURN_LISTS", word);
        for (int i = 0; i < 10; ++i) program.add({static_cast<double>(program.rank)});
        expect_shape_of_rcb(program);
    }
}

// RCB returns ZOLTAN_MEMERR.
TEST(Lists, are_empty_without_objects) {
    for (const char* word : {"ALL", "PARTS", "EXPORT"}) {
        SCOPED_TRACE(word);
        Program program;
        program.set("RETURN_LISTS", word);
        const Outcome outcome = partition_with(program, "RRCB");
        EXPECT_EQ(outcome.code, ZOLTAN_OK);
        EXPECT_EQ(outcome.changes, 0);
        EXPECT_EQ(shape_of(outcome.imports), "empty");
        EXPECT_EQ(shape_of(outcome.exports), "empty");
    }
}

TEST(Lists, of_balance_have_the_shape_of_rcb) {
    for (const char* word : words) {
        SCOPED_TRACE(word);
        Program program;
        program.set({{"RETURN_LISTS", word}, {"REMAP", "0"}});
        scatter_points(program, 100);
        program.set("LB_METHOD", "RCB");
        const Outcome zoltans = program.balance();
        program.set("LB_METHOD", "RRCB");
        const Outcome ours = program.balance();
        EXPECT_EQ(ours.code, zoltans.code);
        expect_same_shape(ours, zoltans);
    }
}

TEST(Lists, come_from_iterating_and_single_callbacks_as_well) {
    Program multi, single;
    scatter_points(multi, 100);
    scatter_points(single, 100);
    for (Program* program : {&multi, &single}) {
        program->set({{"OBJ_WEIGHT_DIM", "1"}, {"RETURN_LISTS", "PARTS"}});
    }
    ZOLTAN_FIRST_OBJ_FN* first = [](void* data, int, int, ZOLTAN_ID_PTR gid, ZOLTAN_ID_PTR lid, int,
                                    float* weight, int* code) {
        const auto& program = *static_cast<Program*>(data);
        *code = ZOLTAN_OK;
        *gid = program.gid_word(0, 0);
        *lid = 0;
        *weight = program.weights[0];
        return 1;
    };
    ZOLTAN_NEXT_OBJ_FN* next = [](void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR lid,
                                  ZOLTAN_ID_PTR next_gid, ZOLTAN_ID_PTR next_lid, int,
                                  float* weight, int* code) {
        const auto& program = *static_cast<Program*>(data);
        *code = ZOLTAN_OK;
        *next_lid = *lid + 1;
        *next_gid = program.gid_word(static_cast<int>(*next_lid), 0);
        *weight = program.weights[*next_lid];
        return 1;
    };
    ZOLTAN_GEOM_FN* geometry = [](void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR lid,
                                  double* position, int* code) {
        const auto& program = *static_cast<Program*>(data);
        *code = ZOLTAN_OK;
        position[0] = program.coordinates[2 * *lid];
        position[1] = program.coordinates[2 * *lid + 1];
    };
    Zoltan_Set_Obj_List_Fn(single.zz, nullptr, nullptr);
    Zoltan_Set_Geom_Multi_Fn(single.zz, nullptr, nullptr);
    Zoltan_Set_First_Obj_Fn(single.zz, first, &single);
    Zoltan_Set_Next_Obj_Fn(single.zz, next, &single);
    Zoltan_Set_Geom_Fn(single.zz, geometry, &single);
    const Outcome expected = partition_with(multi, "RRCB");
    const Outcome outcome = partition_with(single, "RRCB");
    EXPECT_EQ(outcome.exports.parts, expected.exports.parts);
    EXPECT_EQ(outcome.exports.global_ids, expected.exports.global_ids);
    EXPECT_LT(imbalance(single, outcome, single.num_ranks), 1.1);
}

TEST(Lists, feed_the_real_compute_destinations) {
    Scattered program(120, {{"RETURN_LISTS", "ALL"}, {"LB_METHOD", "RRCB"}});
    program.keep_lists = true;
    const Outcome outcome = program.partition();
    const Program::RawList& in = program.raw_imports;
    int count = 0;
    ZOLTAN_ID_PTR gids = nullptr, lids = nullptr;
    int* ranks = nullptr;
    ASSERT_EQ(Zoltan_Compute_Destinations(program.zz, in.count, in.global_ids, in.local_ids,
                                          in.ranks, &count, &gids, &lids, &ranks),
              ZOLTAN_OK);
    std::map<ZOLTAN_ID_TYPE, int> expected, destinations;
    for (std::size_t i = 0; i < outcome.exports.ranks.size(); ++i) {
        expected[outcome.exports.global_ids[i][0]] = outcome.exports.ranks[i];
    }
    for (int i = 0; i < count; ++i) destinations[gids[i]] = ranks[i];
    EXPECT_EQ(destinations, expected);
    Zoltan_LB_Free_Part(&gids, &lids, &ranks, nullptr);
}

}  // namespace
}  // namespace rrcb::zoltan_test
