#include "program.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

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
                Program program;
                scatter_points(program, 200);
                program.set("RETURN_LISTS", word);
                program.set("NUM_GID_ENTRIES", std::to_string(gid));
                program.set("NUM_LID_ENTRIES", std::to_string(lid));
                expect_shape_of_rcb(program);
            }
        }
    }
}

TEST(Lists, have_the_shape_of_rcb_when_one_rank_holds_everything) {
    for (const char* word : words) {
        SCOPED_TRACE(word);
        Program program;
        program.set("RETURN_LISTS", word);
        if (program.rank == program.num_ranks - 1) scatter_points(program, 400);
        expect_shape_of_rcb(program);
    }
}

TEST(Lists, have_the_shape_of_rcb_when_nothing_changes) {
    for (const char* word : words) {
        SCOPED_TRACE(word);
        Program program(1);
        program.set("RETURN_LISTS", word);
        for (int i = 0; i < 10; ++i) program.add({static_cast<double>(program.rank)});
        expect_shape_of_rcb(program);
    }
}

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
        program.set("RETURN_LISTS", word);
        program.set("REMAP", "0");
        scatter_points(program, 100);
        program.set("LB_METHOD", "RCB");
        const Outcome zoltans = program.balance();
        program.set("LB_METHOD", "RRCB");
        const Outcome ours = program.balance();
        EXPECT_EQ(ours.code, zoltans.code);
        expect_same_shape(ours, zoltans);
    }
}

TEST(Lists, of_exports_name_each_object_once_with_its_ids) {
    Program program;
    scatter_points(program, 300);
    program.set("NUM_GID_ENTRIES", "3");
    program.set("NUM_LID_ENTRIES", "2");
    program.set("OBJ_WEIGHT_DIM", "1");
    program.set("RETURN_LISTS", "PARTS");
    const Outcome outcome = partition_with(program, "RRCB");
    ASSERT_EQ(outcome.exports.count, program.size());
    for (int i = 0; i < program.size(); ++i) {
        const auto at = static_cast<std::size_t>(i);
        for (int w = 0; w < 3; ++w) {
            EXPECT_EQ(outcome.exports.global_ids[at][static_cast<std::size_t>(w)],
                      program.gid_word(i, w));
        }
        for (int w = 0; w < 2; ++w) {
            EXPECT_EQ(outcome.exports.local_ids[at][static_cast<std::size_t>(w)],
                      program.lid_word(i, w));
        }
        EXPECT_EQ(outcome.exports.ranks[at], outcome.exports.parts[at]);
    }
    EXPECT_LT(imbalance(program, outcome, program.num_ranks), 1.1);
}

TEST(Lists, of_exports_are_those_of_parts_that_leave) {
    Program program;
    scatter_points(program, 300);
    program.set("RETURN_LISTS", "PARTS");
    const Outcome all = partition_with(program, "RRCB");
    program.set("RETURN_LISTS", "EXPORT");
    const Outcome leaving = program.partition();
    std::vector<std::tuple<ZOLTAN_ID_TYPE, ZOLTAN_ID_TYPE, int, int>> expected, listed;
    for (std::size_t i = 0; i < all.exports.ranks.size(); ++i) {
        if (all.exports.ranks[i] == program.rank) continue;
        expected.emplace_back(all.exports.global_ids[i][0], all.exports.local_ids[i][0],
                              all.exports.ranks[i], all.exports.parts[i]);
    }
    for (std::size_t i = 0; i < leaving.exports.ranks.size(); ++i) {
        listed.emplace_back(leaving.exports.global_ids[i][0], leaving.exports.local_ids[i][0],
                            leaving.exports.ranks[i], leaving.exports.parts[i]);
    }
    EXPECT_EQ(listed, expected);
}

/// Every global id of `list` with the rank that holds it and the rank it goes to, from all ranks.
std::multiset<std::tuple<int, int, int, int>> gathered(const Program& program, const ListCopy& list,
                                                       bool imports) {
    std::vector<int> mine;
    for (std::size_t i = 0; i < list.ranks.size(); ++i) {
        const int from = imports ? list.ranks[i] : program.rank;
        const int to = imports ? program.rank : list.ranks[i];
        mine.insert(mine.end(), {static_cast<int>(list.global_ids[i][0]), from, to, list.parts[i]});
    }
    const auto ranks = static_cast<std::size_t>(program.num_ranks);
    std::vector<int> counts(ranks), offsets(ranks, 0);
    const int size = static_cast<int>(mine.size());
    MPI_Allgather(&size, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
    for (std::size_t r = 1; r < ranks; ++r) offsets[r] = offsets[r - 1] + counts[r - 1];
    std::vector<int> all(static_cast<std::size_t>(offsets.back() + counts.back()));
    MPI_Allgatherv(mine.data(), size, MPI_INT, all.data(), counts.data(), offsets.data(), MPI_INT,
                   MPI_COMM_WORLD);
    std::multiset<std::tuple<int, int, int, int>> moves;
    for (std::size_t i = 0; i < all.size(); i += 4) {
        moves.emplace(all[i], all[i + 1], all[i + 2], all[i + 3]);
    }
    return moves;
}

TEST(Lists, of_imports_answer_those_of_exports) {
    for (const char* word : {"ALL", "IMPORT"}) {
        SCOPED_TRACE(word);
        Program program;
        scatter_points(program, 150);
        program.set("RETURN_LISTS", "EXPORT");
        const Outcome exports = partition_with(program, "RRCB");
        program.set("RETURN_LISTS", word);
        const Outcome outcome = program.partition();
        EXPECT_EQ(gathered(program, outcome.imports, true),
                  gathered(program, exports.exports, false));
    }
}

TEST(Lists, come_from_iterating_and_single_callbacks_as_well) {
    Program multi, single;
    scatter_points(multi, 100);
    scatter_points(single, 100);
    for (Program* program : {&multi, &single}) {
        program->set("OBJ_WEIGHT_DIM", "1");
        program->set("RETURN_LISTS", "PARTS");
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
    Program program;
    scatter_points(program, 120);
    program.set("RETURN_LISTS", "ALL");
    program.set("LB_METHOD", "RRCB");
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
