#include "program.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace rrcb::zoltan_test {
namespace {

/// A path through the objects of each rank, for GRAPH.
void use_graph(Program& program) {
    ZOLTAN_NUM_EDGES_FN* count = [](void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR lid,
                                    int* code) {
        *code = ZOLTAN_OK;
        const int last = static_cast<Program*>(data)->size() - 1;
        const int i = static_cast<int>(*lid);
        return (i > 0 ? 1 : 0) + (i < last ? 1 : 0);
    };
    ZOLTAN_EDGE_LIST_FN* list = [](void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR lid,
                                   ZOLTAN_ID_PTR neighbours, int* ranks, int, float*, int* code) {
        *code = ZOLTAN_OK;
        const Program& self = *static_cast<Program*>(data);
        const int i = static_cast<int>(*lid);
        for (const int j : {i - 1, i + 1}) {
            if (j < 0 || j >= self.size()) continue;
            *neighbours++ = self.gid_word(j, 0);
            *ranks++ = self.rank;
        }
    };
    Zoltan_Set_Num_Edges_Fn(program.zz, count, &program);
    Zoltan_Set_Edge_List_Fn(program.zz, list, &program);
}

struct AllMethods : Program {
    AllMethods() {
        scatter_points(*this, 300);
        use_hier(*this, "RRCB");
        use_graph(*this);
        set({{"RETURN_LISTS", "EXPORT"}, {"OBJ_WEIGHT_DIM", "1"}});
        // Zoltan's numbers depend on those of the call before.
        set("REMAP", "0");
    }
    ListCopy exports(const char* method) {
        EXPECT_EQ(set("LB_METHOD", method), ZOLTAN_OK) << method;
        const Outcome outcome = partition();
        EXPECT_EQ(outcome.code, ZOLTAN_OK) << method;
        return outcome.exports;
    }
};

TEST(Methods, give_the_same_alone_and_after_each_other) {
    const std::vector<const char*> methods = {"RCB", "RRCB", "HSFC", "HIER", "GRAPH", "RIB"};
    std::vector<ListCopy> alone;
    for (const char* method : methods) alone.push_back(AllMethods().exports(method));
    AllMethods program;
    for (int round = 0; round < 2; ++round) {
        for (std::size_t m = 0; m < methods.size(); ++m) {
            SCOPED_TRACE(methods[m]);
            const ListCopy exports = program.exports(methods[m]);
            EXPECT_EQ(exports.local_ids, alone[m].local_ids);
            EXPECT_EQ(exports.parts, alone[m].parts);
        }
    }
}

TEST(Methods, hier_with_rrcb_inside_balances_as_rrcb_does) {
    for (const char* inner : {"RCB", "RRCB"}) {
        AllMethods program;
        use_hier(program, inner);
        program.set("RETURN_LISTS", "PARTS");
        EXPECT_LT(imbalance(program, program.partition(), program.num_ranks), 1.05) << inner;
    }
}

TEST(Methods, look_ups_need_a_partition_of_the_method_that_is_set) {
    for (const char* method : {"RCB", "RRCB"}) {
        Scattered program(100, {{"KEEP_CUTS", "1"}, {"LB_METHOD", method}});
        program.partition();
        program.set({{"LB_METHOD", "RIB"}, {"LB_METHOD", method}});
        EXPECT_EQ(program.place_of(program.coordinates.data()).code, ZOLTAN_FATAL) << method;
    }
}

}  // namespace
}  // namespace rrcb::zoltan_test
