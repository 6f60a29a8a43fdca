#include "moving.hpp"

namespace rrcb::zoltan_test {
namespace {

using Fill = void (*)(Moving&, std::mt19937&);

double uniform(std::mt19937& random) {
    return std::uniform_real_distribution<double>(0, 1)(random);
}

void fill_evenly(Moving& program, std::mt19937& random) {
    const int count = program.rank % 3 == 1 ? 37 : 1000;
    for (int i = 0; i < count; ++i) {
        std::vector<double> position;
        for (int a = 0; a < program.dimension; ++a) position.push_back(uniform(random));
        program.add(position);
    }
}

void fill_clusters(Moving& program, std::mt19937& random) {
    for (int i = 0; i < 600; ++i) {
        std::vector<double> position;
        for (int a = 0; a < program.dimension; ++a)
            position.push_back(i % 4 + 0.01 * std::pow(uniform(random), 3));
        program.add(position);
    }
}

void fill_with_weights(Moving& program, std::mt19937& random) {
    fill_evenly(program, random);
    for (float& weight : program.weights)
        weight = static_cast<float>(std::exp(4 * uniform(random)));
}

/// So few and so different that no tolerance is kept.
void fill_with_giants(Moving& program, std::mt19937& random) {
    for (int i = 0; i < 7; ++i) {
        std::vector<double> position;
        for (int a = 0; a < program.dimension; ++a) position.push_back(uniform(random));
        program.add(position, static_cast<float>(std::exp(9 * uniform(random))));
    }
}

void fill_lattice(Moving& program, std::mt19937&) {
    for (int i = 0; i < 900; ++i) {
        std::vector<double> position = {double(i % 30), double(i / 30), double(i % 7)};
        position.resize(static_cast<std::size_t>(program.dimension));
        program.add(position);
    }
}

void fill_one_place(Moving& program, std::mt19937&) {
    for (int i = 0; i < 100; ++i)
        program.add(std::vector<double>(static_cast<std::size_t>(program.dimension), 2.0));
}

void fill_few_places(Moving& program, std::mt19937& random) {
    for (int i = 0; i < 300; ++i) {
        const double place = std::floor(4 * uniform(random));
        program.add(std::vector<double>(static_cast<std::size_t>(program.dimension), place));
    }
}

void fill_one_rank(Moving& program, std::mt19937& random) {
    if (program.rank == program.num_ranks - 1) fill_evenly(program, random);
}

struct Cloud {
    const char* name;
    Fill fill;
    bool is_coincident = false;  ///< RCB exchanges such objects without end
};

constexpr Cloud clouds[] = {
    {"even", fill_evenly},
    {"clusters", fill_clusters},
    {"weights", fill_with_weights},
    {"giants", fill_with_giants},
    {"lattice", fill_lattice},
    {"one place", fill_one_place, true},
    {"few places", fill_few_places, true},
    {"one rank", fill_one_rank},
};

/// RRCB in the three ways it may be asked to start: from nothing, from the last cuts, and exactly.
struct Way {
    const char* method;
    const char* reuse;
    const char* refine;
};

constexpr Way ways[] = {{"RCB", "0", "TOLERANCE"},  {"RRCB", "0", "TOLERANCE"},
                        {"RRCB", "1", "TOLERANCE"}, {"RRCB", "0", "EXACT"},
                        {"RRCB", "1", "EXACT"},     {"RRCB", "0", "NONE"}};

void ask(Program& program, const Way& way) {
    program.set({{"LB_METHOD", way.method}, {"RCB_REUSE", way.reuse}, {"RRCB_REFINE", way.refine}});
}

TEST(KeptObjects, are_found_by_the_second_call) {
    for (const Cloud& cloud : clouds) {
        for (const Way& way : ways) {
            if (cloud.is_coincident && std::string(way.method) == "RCB") continue;
            for (const int dimension : {2, 3}) {
                SCOPED_TRACE(std::string(cloud.name) + " " + way.method + " " + way.reuse + " " +
                             way.refine);
                Moving program(dimension);
                std::mt19937 random(static_cast<unsigned>(3 + program.rank));
                cloud.fill(program, random);
                ask(program, way);
                EXPECT_LE(calls_until_rest(program, 30), 2);
            }
        }
    }
}

TEST(KeptObjects, are_found_by_parts_that_callbacks_name) {
    const int num_ranks = Program().num_ranks;
    for (const int num_parts : {(num_ranks + 1) / 2, num_ranks, 2 * num_ranks + 1, 200}) {
        for (const Way& way : ways) {
            SCOPED_TRACE(std::to_string(num_parts) + way.method + way.reuse + way.refine);
            Moving program(2);
            std::mt19937 random(static_cast<unsigned>(3 + program.rank));
            fill_with_weights(program, random);
            program.tell_parts();
            program.set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
            ask(program, way);
            EXPECT_LE(calls_until_rest(program, 30), 2);
        }
    }
}

struct AtRest : Moving {
    AtRest() : Moving(2) {
        std::mt19937 random(static_cast<unsigned>(5 + rank));
        fill_with_weights(*this, random);
        // Heavier above, so that parts of equal weight do not have equal numbers.
        for (std::size_t i = 0; i < weights.size(); ++i)
            weights[i] *= static_cast<float>(1 + coordinates[2 * i] + coordinates[2 * i + 1]);
        set({{"LB_METHOD", "RRCB"}, {"RRCB_REFINE", "EXACT"}, {"KEEP_CUTS", "1"}});
        calls_until_rest(*this, 3);
    }
};

TEST(KeptObjects, are_listed_every_object_in_its_part_where_parts_are_asked_for) {
    AtRest program;
    program.set("RETURN_LISTS", "PARTS");
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.changes, 0);
    EXPECT_EQ(outcome.exports.count, program.size());
    EXPECT_EQ(outcome.imports.count, 0);
    for (const int part : outcome.exports.parts) EXPECT_EQ(part, program.rank);
    for (const int rank : outcome.exports.ranks) EXPECT_EQ(rank, program.rank);
}

TEST(KeptObjects, keep_look_ups) {
    AtRest program;
    for (int i = 0; i < program.size(); ++i) {
        const Place expected{ZOLTAN_OK, program.rank, program.rank};
        ASSERT_EQ(program.place_of(&program.coordinates[static_cast<std::size_t>(2 * i)]),
                  expected);
    }
}

TEST(KeptObjects, end_on_all_ranks_when_one_changes_anything) {
    const int num_ranks = Program().num_ranks;
    if (num_ranks == 1) GTEST_SKIP() << "needs two ranks";
    using Change = void (*)(Program&);
    for (const Change change : {
             Change([](Program& p) { p.weights[1] *= 1000; }),
             Change([](Program& p) {
                 for (double& x : p.coordinates) x = 1 - x;
             }),
             Change([](Program& p) {
                 const int count = p.size() / 2;
                 p.weights.resize(static_cast<std::size_t>(count));
                 p.coordinates.resize(static_cast<std::size_t>(2 * count));
             }),
         }) {
        AtRest program;
        if (program.rank == num_ranks - 1) change(program);
        EXPECT_EQ(program.partition().changes, 1);
    }
}

TEST(KeptObjects, end_when_something_else_is_asked_for) {
    const int num_ranks = Program().num_ranks;
    if (num_ranks == 1) GTEST_SKIP() << "needs two ranks";
    constexpr std::array<std::array<const char*, 2>, 3> changes = {
        {{"OBJ_WEIGHT_DIM", "0"}, {"RRCB_DOMAIN", "SAMPLED"}, {"RETURN_LISTS", "NONE"}}};
    for (const auto& [name, value] : changes) {
        AtRest program;
        program.set(name, value);
        EXPECT_EQ(program.partition().changes, 1) << name;
    }
    AtRest program;
    program.set_size(0, 3);
    EXPECT_EQ(program.partition().changes, 1);
}

TEST(KeptObjects, do_not_hide_faults) {
    AtRest program;
    const bool last = program.rank == program.num_ranks - 1;
    const double good = program.coordinates[3];
    if (last) program.coordinates[3] = std::nan("");
    EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
    if (last) program.coordinates[3] = good;
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
}

TEST(KeptObjects, give_no_look_ups_without_keep_cuts) {
    Moving program(2);
    scatter_points(program, 100);
    program.set("LB_METHOD", "RRCB");
    EXPECT_LE(calls_until_rest(program, 5), 2);
    const double x[] = {0.5, 0.5};
    EXPECT_EQ(program.place_of(x), (Place{ZOLTAN_FATAL, -1, -1}));
    program.set("KEEP_CUTS", "1");
    EXPECT_EQ(program.partition().changes, 0);
    EXPECT_EQ(program.place_of(x).code, ZOLTAN_OK);
}

}  // namespace
}  // namespace rrcb::zoltan_test
