// fault_case --list
// fault_case METHOD NAME
//
// A Zoltan program in which one thing is wrong. Every rank prints what its call returned, repairs
// the fault, and calls again when all have returned.
#include "program.hpp"

#include <cstdio>
#include <stdexcept>
#include <string_view>

namespace {

using rrcb::zoltan_test::Outcome;
using rrcb::zoltan_test::Program;

void answer(Program& program, const std::string& faulty, int code) {
    program.fault = [=](const std::string& name, int& result) {
        if (name == faulty) result = code;
    };
}

void fail_by_throwing(Program& program, const std::string& faulty) {
    program.fault = [=](const std::string& name, int&) {
        if (name == faulty) throw std::runtime_error("thrown by a callback");
    };
}

constexpr double infinity = std::numeric_limits<double>::infinity();

template <auto setter>
void unregister(Program& program) {
    setter(program.zz, nullptr, nullptr);
}

struct Case {
    const char* name;
    const char* description;
    int expected;  ///< code of RRCB on all ranks
    bool everywhere;
    void (*break_it)(Program&);
};

constexpr std::array cases = {
    Case{"num_obj_fatal", "NUM_OBJ returns FATAL", ZOLTAN_FATAL, false,
         [](Program& p) { answer(p, "NUM_OBJ", ZOLTAN_FATAL); }},
    Case{"obj_list_fatal", "OBJ_LIST returns FATAL", ZOLTAN_FATAL, false,
         [](Program& p) { answer(p, "OBJ_LIST", ZOLTAN_FATAL); }},
    Case{"num_geom_fatal", "NUM_GEOM returns FATAL", ZOLTAN_FATAL, false,
         [](Program& p) { answer(p, "NUM_GEOM", ZOLTAN_FATAL); }},
    Case{"geom_multi_fatal", "GEOM_MULTI returns FATAL", ZOLTAN_FATAL, false,
         [](Program& p) { answer(p, "GEOM_MULTI", ZOLTAN_FATAL); }},
    Case{"geom_multi_warn", "GEOM_MULTI returns WARN", ZOLTAN_WARN, false,
         [](Program& p) { answer(p, "GEOM_MULTI", ZOLTAN_WARN); }},
    Case{"geom_multi_memerr", "GEOM_MULTI returns MEMERR", ZOLTAN_MEMERR, false,
         [](Program& p) { answer(p, "GEOM_MULTI", ZOLTAN_MEMERR); }},
    Case{"obj_list_throws", "OBJ_LIST throws", ZOLTAN_FATAL, false,
         [](Program& p) { fail_by_throwing(p, "OBJ_LIST"); }},
    Case{"geom_multi_throws", "GEOM_MULTI throws", ZOLTAN_FATAL, false,
         [](Program& p) { fail_by_throwing(p, "GEOM_MULTI"); }},
    Case{"negative_count", "negative number of objects", ZOLTAN_FATAL, false,
         [](Program& p) { p.count_offset = -1000; }},
    Case{"no_num_obj", "no NUM_OBJ", ZOLTAN_FATAL, false, unregister<Zoltan_Set_Num_Obj_Fn>},
    Case{"no_obj_list", "no OBJ_LIST", ZOLTAN_FATAL, false, unregister<Zoltan_Set_Obj_List_Fn>},
    Case{"no_num_geom", "no NUM_GEOM", ZOLTAN_FATAL, false, unregister<Zoltan_Set_Num_Geom_Fn>},
    Case{"no_geom", "no GEOM_MULTI", ZOLTAN_FATAL, false, unregister<Zoltan_Set_Geom_Multi_Fn>},
    Case{"dimension_0", "dimension 0", ZOLTAN_FATAL, true,
         [](Program& p) { p.reported_dimension = 0; }},
    Case{"dimension_4", "dimension 4", ZOLTAN_FATAL, true,
         [](Program& p) { p.reported_dimension = 4; }},
    Case{"one_nan", "one coordinate is NaN", ZOLTAN_FATAL, false,
         [](Program& p) { p.coordinates[31] = std::nan(""); }},
    Case{"all_nan", "all coordinates are NaN", ZOLTAN_FATAL, true,
         [](Program& p) { p.coordinates.assign(p.coordinates.size(), std::nan("")); }},
    Case{"one_infinity", "one coordinate is infinite", ZOLTAN_FATAL, false,
         [](Program& p) { p.coordinates[31] = infinity; }},
    Case{"all_infinity", "all coordinates are infinite", ZOLTAN_FATAL, true,
         [](Program& p) { p.coordinates.assign(p.coordinates.size(), infinity); }},
    Case{"one_nan_weight", "one weight is NaN", ZOLTAN_FATAL, false,
         [](Program& p) { p.weights[7] = std::nanf(""); }},
    Case{"all_nan_weights", "all weights are NaN", ZOLTAN_FATAL, true,
         [](Program& p) { p.weights.assign(p.weights.size(), std::nanf("")); }},
    Case{"one_infinite_weight", "one weight is infinite", ZOLTAN_FATAL, false,
         [](Program& p) { p.weights[7] = static_cast<float>(infinity); }},
    Case{"one_negative_weight", "one weight is negative", ZOLTAN_FATAL, false,
         [](Program& p) { p.weights[7] = -1; }},
    Case{"weights_differ", "OBJ_WEIGHT_DIM differs", ZOLTAN_FATAL, false,
         [](Program& p) { p.set("OBJ_WEIGHT_DIM", "0"); }},
    Case{"ids_differ", "NUM_LID_ENTRIES differs", ZOLTAN_FATAL, false,
         [](Program& p) { p.set("NUM_LID_ENTRIES", "2"); }},
};

const char* name_of(int code) {
    switch (code) {
        case ZOLTAN_OK:
            return "OK";
        case ZOLTAN_WARN:
            return "WARN";
        case ZOLTAN_MEMERR:
            return "MEMERR";
        default:
            return "FATAL";
    }
}

void list_cases() {
    for (const Case& fault : cases) {
        std::printf("%s;%s;%s on %s\n", fault.name, name_of(fault.expected), fault.description,
                    fault.everywhere ? "all ranks" : "one rank");
    }
}

void set_parameters(Program& program) {
    program.set("OBJ_WEIGHT_DIM", "1");
    program.set("RETURN_LISTS", "ALL");
    program.set("NUM_LID_ENTRIES", "1");
}

void say(const char* when, const Outcome& outcome) {
    const int num_listed = outcome.imports.count + outcome.exports.count;
    std::printf("%s %s, %s\n", when, name_of(outcome.code), num_listed > 0 ? "lists" : "no lists");
    std::fflush(stdout);
}

void run(const Case& fault, Program& program) {
    const std::vector<double> coordinates = program.coordinates;
    const std::vector<float> weights = program.weights;
    set_parameters(program);
    if (fault.everywhere || program.rank == program.num_ranks - 1) fault.break_it(program);
    say("returned", program.partition());

    MPI_Barrier(MPI_COMM_WORLD);
    program.fault = nullptr;
    program.count_offset = 0;
    program.reported_dimension = program.dimension;
    program.coordinates = coordinates;
    program.weights = weights;
    program.register_callbacks(program.zz);
    set_parameters(program);
    say("next", program.partition());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 2 && std::string_view(argv[1]) == "--list") {
        list_cases();
        return 0;
    }
    MPI_Init(&argc, &argv);
    {
        Program program;
        rrcb::zoltan_test::scatter_points(program, 50);
        program.set("LB_METHOD", argv[1]);
        for (const Case& fault : cases) {
            if (std::string_view(argv[2]) == fault.name) run(fault, program);
        }
    }
    MPI_Finalize();
    return 0;
}
