#include "program.hpp"

#include <initializer_list>
#include <stdexcept>

namespace rrcb::zoltan_test {
namespace {

/// The last rank misbehaves; with one rank it is the only one.
bool is_faulty(const Program& program) {
    return program.rank == program.num_ranks - 1;
}

void expect_empty(const ListCopy& list) {
    EXPECT_EQ(list.count, 0);
    EXPECT_FALSE(list.has_global_ids || list.has_local_ids || list.has_ranks || list.has_parts);
}

struct FaultyProgram : Program {
    FaultyProgram() {
        scatter_points(*this, 50);
        set({{"LB_METHOD", "RRCB"}, {"OBJ_WEIGHT_DIM", "1"}});
    }

    void expect_failure_then_success(int code) {
        const Outcome failed = partition();
        EXPECT_EQ(failed.code, code);
        EXPECT_EQ(failed.changes, 0);
        expect_empty(failed.imports);
        expect_empty(failed.exports);
        fault = nullptr;
        count_offset = 0;
        reported_dimension = dimension;
        register_callbacks(zz);
        EXPECT_EQ(partition().code, ZOLTAN_OK);
    }
};

constexpr std::pair<const char*, const char*> methods[] = {{"ANALYTIC", "NONE"},
                                                           {"ANALYTIC", "TOLERANCE"},
                                                           {"ANALYTIC", "EXACT"},
                                                           {"SAMPLED", "NONE"},
                                                           {"POINTS", "NONE"}};
constexpr const char* callbacks[] = {"NUM_OBJ", "OBJ_LIST", "NUM_GEOM", "GEOM_MULTI"};

TEST(Faults, of_a_callback_on_one_rank_give_every_rank_the_same_code) {
    for (const char* faulty : callbacks) {
        for (const int code : {ZOLTAN_FATAL, ZOLTAN_MEMERR}) {
            SCOPED_TRACE(std::string(faulty) + " " + std::to_string(code));
            FaultyProgram program;
            if (is_faulty(program)) {
                program.fault = [=](const std::string& name, int& result) {
                    if (name == faulty) result = code;
                };
            }
            program.expect_failure_then_success(code);
        }
    }
}

TEST(Faults, out_of_memory_outranks_other_failures) {
    FaultyProgram program;
    program.fault = [&](const std::string&, int& code) {
        code = is_faulty(program) ? ZOLTAN_MEMERR : ZOLTAN_FATAL;
    };
    program.expect_failure_then_success(ZOLTAN_MEMERR);
}

TEST(Faults, a_warning_of_a_callback_is_passed_on_with_the_lists) {
    for (const char* faulty : callbacks) {
        SCOPED_TRACE(faulty);
        FaultyProgram program;
        if (is_faulty(program)) {
            program.fault = [=](const std::string& name, int& result) {
                if (name == faulty) result = ZOLTAN_WARN;
            };
        }
        program.set("RETURN_LISTS", "PARTS");
        const Outcome outcome = program.partition();
        EXPECT_EQ(outcome.code, ZOLTAN_WARN);
        EXPECT_EQ(outcome.exports.count, program.size());
    }
}

TEST(Faults, an_exception_of_a_callback_does_not_leave_the_call) {
    for (const char* faulty : callbacks) {
        SCOPED_TRACE(faulty);
        FaultyProgram program;
        if (is_faulty(program)) {
            program.fault = [=](const std::string& name, int&) {
                if (name == faulty) throw std::runtime_error("thrown by the test");
            };
        }
        program.expect_failure_then_success(ZOLTAN_FATAL);
        if (is_faulty(program)) {
            program.fault = [=](const std::string& name, int&) {
                if (name == faulty) throw 42;
            };
        }
        program.expect_failure_then_success(ZOLTAN_FATAL);
    }
}

TEST(Faults, a_negative_count_is_fatal) {
    FaultyProgram program;
    if (is_faulty(program)) program.count_offset = -1000;
    program.expect_failure_then_success(ZOLTAN_FATAL);
}

TEST(Faults, a_dimension_other_than_1_2_or_3_is_fatal) {
    for (const int dimension : {-1, 0, 4}) {
        SCOPED_TRACE(dimension);
        FaultyProgram program;
        if (is_faulty(program)) program.reported_dimension = dimension;
        program.expect_failure_then_success(ZOLTAN_FATAL);
    }
}

TEST(Faults, a_missing_callback_is_fatal) {
    using Remove = void (*)(Zoltan_Struct*);
    for (const Remove remove :
         {Remove([](Zoltan_Struct* zz) { Zoltan_Set_Num_Obj_Fn(zz, nullptr, nullptr); }),
          Remove([](Zoltan_Struct* zz) { Zoltan_Set_Obj_List_Fn(zz, nullptr, nullptr); }),
          Remove([](Zoltan_Struct* zz) { Zoltan_Set_Num_Geom_Fn(zz, nullptr, nullptr); }),
          Remove([](Zoltan_Struct* zz) { Zoltan_Set_Geom_Multi_Fn(zz, nullptr, nullptr); })}) {
        FaultyProgram program;
        if (is_faulty(program)) remove(program.zz);
        program.expect_failure_then_success(ZOLTAN_FATAL);
    }
}

/// Each of the bad values is fatal in an entry of one rank; the next call, without it, succeeds.
template <class Value>
void expect_fatal(std::vector<Value> Program::*values, std::size_t entry,
                  std::initializer_list<Value> all_bad) {
    for (const Value bad : all_bad)
        for (const auto& [domain, refine] : methods) {
            SCOPED_TRACE(std::string(domain) + " " + refine);
            FaultyProgram program;
            program.set({{"RRCB_DOMAIN", domain}, {"RRCB_REFINE", refine}});
            Value& value = (program.*values)[entry];
            const Value good = value;
            if (is_faulty(program)) value = bad;
            EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
            value = good;
            EXPECT_EQ(program.partition().code, ZOLTAN_OK);
        }
}

TEST(Faults, coordinates_that_are_not_finite_are_fatal) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    expect_fatal(&Program::coordinates, 31, {std::nan(""), infinity, -infinity});
}

TEST(Faults, weights_that_are_not_finite_or_negative_are_fatal) {
    expect_fatal(&Program::weights, 7,
                 {std::nanf(""), std::numeric_limits<float>::infinity(), -1e-30F});
}

TEST(Faults, of_weights_that_are_all_zero_balance_the_number) {
    FaultyProgram program;
    program.weights.assign(program.weights.size(), 0.0F);
    program.set("RETURN_LISTS", "PARTS");
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    program.weights.assign(program.weights.size(), 1.0F);
    EXPECT_LT(imbalance(program, outcome, program.num_ranks), 1.2);
}

}  // namespace
}  // namespace rrcb::zoltan_test
