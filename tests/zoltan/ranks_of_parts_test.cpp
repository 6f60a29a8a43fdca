// Ranks of parts, as the lists have them: Zoltan_LB_Part_To_Proc, Zoltan_LB_Proc_To_Part and
// Zoltan_Help_Migrate.
#include "program.hpp"

// Exported by Zoltan and called by its users, but declared in no public header.
extern "C" {
int Zoltan_LB_Part_To_Proc(struct Zoltan_Struct* zz, int part, ZOLTAN_ID_PTR global_id);
int Zoltan_LB_Proc_To_Part(struct Zoltan_Struct* zz, int rank, int* num_parts, int* first_part);
}

namespace rrcb::zoltan_test {
namespace {

constexpr int unset = -1;

/// A number of parts on all ranks, and NUM_LOCAL_PARTS of the first and of the other ranks.
struct Layout {
    int num_parts;
    int on_first = unset;
    int on_others = unset;
};

std::vector<Layout> layouts_on(int num_ranks) {
    std::vector<Layout> layouts = {{num_ranks}, {num_ranks + 2}, {2 * num_ranks + 1}};
    if (num_ranks > 1) {
        layouts.push_back({num_ranks - 1});
        layouts.push_back({1});
        layouts.push_back({num_ranks - 1, 0, 1});
    }
    layouts.push_back({3 + 2 * (num_ranks - 1), 3, 2});
    return layouts;
}

struct Divided : Program {
    Divided(const char* method, const Layout& layout) {
        scatter_points(*this, 60);
        set({{"LB_METHOD", method}, {"RETURN_LISTS", "PARTS"}});
        set("NUM_GLOBAL_PARTS", std::to_string(layout.num_parts));
        const int here = rank == 0 ? layout.on_first : layout.on_others;
        if (here != unset) set("NUM_LOCAL_PARTS", std::to_string(here));
        outcome = partition();
    }
    Outcome outcome;
};

std::vector<int> ranks_of_parts(Zoltan_Struct* zz, int num_parts) {
    std::vector<int> ranks;
    for (int part = -1; part <= num_parts; ++part)
        ranks.push_back(Zoltan_LB_Part_To_Proc(zz, part, nullptr));
    return ranks;
}

std::vector<int> parts_of_ranks(Zoltan_Struct* zz, int num_ranks) {
    std::vector<int> parts;
    for (int rank = -1; rank <= num_ranks; ++rank) {
        int count = -7, first = -7;
        const int code = Zoltan_LB_Proc_To_Part(zz, rank, &count, &first);
        parts.insert(parts.end(), {code, count, first});
    }
    return parts;
}

TEST(RanksOfParts, are_those_of_rcb) {
    const int num_ranks = Program().num_ranks;
    for (const Layout& layout : layouts_on(num_ranks)) {
        SCOPED_TRACE(layout.num_parts);
        Divided ours("RRCB", layout), zoltans("RCB", layout);
        EXPECT_EQ(ranks_of_parts(ours.zz, layout.num_parts),
                  ranks_of_parts(zoltans.zz, layout.num_parts));
        EXPECT_EQ(parts_of_ranks(ours.zz, num_ranks), parts_of_ranks(zoltans.zz, num_ranks));
    }
}

TEST(RanksOfParts, are_those_of_the_lists) {
    for (const Layout& layout : layouts_on(Program().num_ranks)) {
        SCOPED_TRACE(layout.num_parts);
        Divided program("RRCB", layout);
        const ListCopy& list = program.outcome.exports;
        for (std::size_t i = 0; i < list.parts.size(); ++i) {
            ZOLTAN_ID_TYPE id = list.global_ids[i][0];
            const int part = list.parts[i];
            const int rank = Zoltan_LB_Part_To_Proc(program.zz, part, &id);
            const bool is_alone = layout.num_parts >= program.num_ranks || layout.on_first != unset;
            if (is_alone || list.ranks[i] == program.rank) {
                EXPECT_EQ(rank, list.ranks[i]);
            }
        }
    }
}

TEST(RanksOfParts, go_with_the_method_that_made_the_parts) {
    Divided program("RRCB", {2 * Program().num_ranks});
    const int last = 2 * program.num_ranks - 1;
    Zoltan_Struct* copy = Zoltan_Copy(program.zz);
    EXPECT_EQ(Zoltan_LB_Part_To_Proc(copy, last, nullptr), program.num_ranks - 1);
    Zoltan_Destroy(&copy);
    program.set("OBJ_WEIGHT_DIM", "2");  // answered by Zoltan
    program.set("NUM_GLOBAL_PARTS", std::to_string(3 * program.num_ranks));
    program.further_weight = [](int, int) { return 1.0F; };
    program.partition();
    EXPECT_EQ(Zoltan_LB_Part_To_Proc(program.zz, last, nullptr), last / 3);
}

/// Calls Zoltan_Help_Migrate with no objects.
int help_migrate(Zoltan_Struct* zz) {
    Migration migration;
    count_migration(zz, migration);
    return Zoltan_Help_Migrate(zz, 0, nullptr, nullptr, nullptr, 0, nullptr, nullptr, nullptr);
}

TEST(RanksOfParts, decide_whether_objects_migrate_without_parts) {
    for (const char* method : {"RCB", "RRCB"}) {
        SCOPED_TRACE(method);
        const int num_ranks = Program().num_ranks;
        Divided one_each(method, {num_ranks}), more(method, {num_ranks + 1});
        EXPECT_EQ(help_migrate(one_each.zz), ZOLTAN_OK);
        EXPECT_EQ(help_migrate(more.zz), ZOLTAN_FATAL);
    }
}

}  // namespace
}  // namespace rrcb::zoltan_test
