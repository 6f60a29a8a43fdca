// Settings that Zoltan's RCB answers for RRCB: lists, look-ups, copies and buffers are RCB's.
#include "program.hpp"
#include "regions.hpp"
#include "same_lists.hpp"

#include <zoltan_partition_tree.h>

namespace rrcb::zoltan_test {
namespace {

struct Setting {
    const char* name;
    const char* value;
};

constexpr std::array settings = {Setting{"OBJ_WEIGHT_DIM", "2"}, Setting{"OBJ_WEIGHT_DIM", "4"},
                                 Setting{"REDUCE_DIMENSIONS", "1"}, Setting{"AVERAGE_CUTS", "1"}};

/// Objects in a flat slanted box, with weights that grow in different directions.
struct Cloud : Program {
    explicit Cloud(const char* method, int count = 200) : Program(3) {
        scatter_points(*this, count);
        for (std::size_t i = 0; i < coordinates.size(); i += 3)
            coordinates[i + 2] = 1e-4 * coordinates[i + 2] + coordinates[i];
        further_weight = [this](int object, int k) {
            return static_cast<float>(1 + coordinates[std::size_t(3 * object + k % 3)]);
        };
        set({{"LB_METHOD", method}, {"KEEP_CUTS", "1"}});
    }
};

/// Numbers by which a program tells two partitions apart, by all look-ups.
std::vector<double> look_ups(Zoltan_Struct* zz, int num_parts) {
    std::vector<double> found;
    std::vector<int> ranks(100), parts(100);
    for (int i = 0; i < 40; ++i) {
        std::array<double, 3> x = {i / 40.0, i * 7 % 40 / 40.0, i * 13 % 40 / 40.0};
        int rank = 0, part = 0, num_ranks = 0, num_found = 0;
        found.push_back(Zoltan_LB_Point_PP_Assign(zz, x.data(), &rank, &part));
        found.insert(found.end(), {double(rank), double(part)});
        found.push_back(Zoltan_LB_Box_PP_Assign(zz, x[0], x[1], x[2], x[0] + 0.2, x[1] + 0.2,
                                                x[2] + 0.2, ranks.data(), &num_ranks, parts.data(),
                                                &num_found));
        found.insert(found.end(), ranks.begin(), ranks.begin() + num_ranks);
        found.insert(found.end(), parts.begin(), parts.begin() + num_found);
    }
    for (int part = 0; part < num_parts; ++part) {
        const Region region = region_of(zz, part);
        found.insert(found.end(), {double(region.code), double(region.dimension)});
        found.insert(found.end(), region.lower.begin(), region.lower.end());
        found.insert(found.end(), region.upper.begin(), region.upper.end());
        int parent = 0, left = 0, right = 0;
        found.push_back(Zoltan_RCB_Partition_Tree(zz, part, &parent, &left, &right));
        found.insert(found.end(), {double(parent), double(left), double(right)});
    }
    return found;
}

bool has_cuts(Zoltan_Struct* zz) {
    std::array<double, 3> x{};
    int rank = 0, part = 0;
    const int code = Zoltan_LB_Point_PP_Assign(zz, x.data(), &rank, &part);
    EXPECT_EQ(part == -1, code == ZOLTAN_FATAL);
    return code == ZOLTAN_OK;
}

bool is_first_rank() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank == 0;
}

// The first test, as the notice comes once in a program.
TEST(Forwarding, is_noted_once_on_the_first_rank_unless_nothing_is_to_be_printed) {
    std::string printed;
    for (const char* level : {"0", "1", "1"}) {
        Cloud program("RRCB");
        program.set({{"DEBUG_LEVEL", level}, {"OBJ_WEIGHT_DIM", "2"}});
        testing::internal::CaptureStderr();
        program.partition();
        const std::string one = testing::internal::GetCapturedStderr();
        EXPECT_TRUE(level[0] == '1' || one.empty()) << one;
        printed += one;
    }
    const auto first = printed.find("Zoltan's RCB answers");
    EXPECT_EQ(first != printed.npos, is_first_rank()) << printed;
    EXPECT_EQ(printed.find("Zoltan's RCB answers", first + 1), printed.npos) << printed;
    EXPECT_EQ(printed.find("OBJ_WEIGHT_DIM is above 1") != printed.npos, is_first_rank());
}

TEST(Forwarding, gives_the_lists_and_look_ups_of_rcb) {
    for (const Setting& setting : settings) {
        for (const char* lists : {"ALL", "IMPORT", "EXPORT", "PARTS", "NONE"}) {
            SCOPED_TRACE(std::string(setting.name) + " " + lists);
            Cloud ours("RRCB"), zoltans("RCB");
            for (Cloud* program : {&ours, &zoltans}) {
                program->set(setting.name, setting.value);
                program->set("RETURN_LISTS", lists);
            }
            expect_same(ours.partition(), zoltans.partition());
            EXPECT_EQ(look_ups(ours.zz, ours.num_ranks), look_ups(zoltans.zz, ours.num_ranks));
            expect_same(ours.balance(), zoltans.balance());
        }
    }
}

TEST(Forwarding, keeps_parameters_and_part_sizes) {
    constexpr std::array parameters = {Setting{"NUM_GLOBAL_PARTS", "7"},
                                       Setting{"RCB_MULTICRITERIA_NORM", "3"},
                                       Setting{"RCB_MAX_ASPECT_RATIO", "2"},
                                       Setting{"OBJ_WEIGHTS_COMPARABLE", "1"},
                                       Setting{"RCB_SET_DIRECTIONS", "6"},
                                       Setting{"RCB_RECTILINEAR_BLOCKS", "1"},
                                       Setting{"REMAP", "0"},
                                       Setting{"RETURN_LISTS", "PARTS"}};
    for (const Setting& setting : settings) {
        SCOPED_TRACE(setting.name);
        Cloud ours("RCB"), zoltans("RCB");
        for (Cloud* program : {&ours, &zoltans}) {
            program->set(setting.name, setting.value);
            for (const Setting& parameter : parameters)
                program->set(parameter.name, parameter.value);
            std::array parts{0, 1, 6, 6}, weights{0, 0, 0, 1};
            std::array sizes{3.0F, 0.5F, 2.0F, 4.0F};
            Zoltan_LB_Set_Part_Sizes(program->zz, 1, 4, parts.data(), weights.data(), sizes.data());
        }
        // Given to another method first.
        ours.set({{"LB_METHOD", "HSFC"}, {"LB_METHOD", "RRCB"}});
        expect_same(ours.partition(), zoltans.partition());
        EXPECT_EQ(look_ups(ours.zz, 7), look_ups(zoltans.zz, 7));
    }
}

TEST(Forwarding, goes_back_and_forth_with_the_setting) {
    for (const Setting& setting : settings) {
        SCOPED_TRACE(setting.name);
        Cloud both("RRCB"), zoltans("RCB");
        zoltans.set(setting.name, setting.value);
        zoltans.set("RETURN_LISTS", "PARTS");
        both.set("RETURN_LISTS", "PARTS");
        const Outcome forwarded = zoltans.partition();
        const auto of_zoltan = look_ups(zoltans.zz, both.num_ranks);
        for (int time = 0; time < 3; ++time) {
            both.set(setting.name, setting.name[0] == 'O' ? "1" : "0");
            Cloud ours("RRCB");
            if (setting.name[0] == 'O') ours.set("OBJ_WEIGHT_DIM", "1");
            ours.set("RETURN_LISTS", "PARTS");
            expect_same(both.partition(), ours.partition());
            const auto of_rrcb = look_ups(ours.zz, both.num_ranks);
            EXPECT_EQ(look_ups(both.zz, both.num_ranks), of_rrcb);
            // The last partition answers until the next one.
            both.set(setting.name, setting.value);
            EXPECT_EQ(look_ups(both.zz, both.num_ranks), of_rrcb);
            expect_same(both.partition(), forwarded);
            EXPECT_EQ(look_ups(both.zz, both.num_ranks), of_zoltan);
            both.set("LB_METHOD", "RRCB");
            EXPECT_EQ(look_ups(both.zz, both.num_ranks), of_zoltan);
        }
    }
}

TEST(Forwarding, leaves_no_look_ups_without_kept_cuts_or_under_another_method) {
    Cloud program("RRCB");
    program.set({{"OBJ_WEIGHT_DIM", "2"}, {"KEEP_CUTS", "0"}});
    program.partition();
    EXPECT_FALSE(has_cuts(program.zz));
    program.set("KEEP_CUTS", "1");
    program.partition();
    EXPECT_TRUE(has_cuts(program.zz));
    program.set({{"LB_METHOD", "RIB"}, {"LB_METHOD", "RRCB"}});
    EXPECT_FALSE(has_cuts(program.zz));
}

/// A handle that Zoltan's RCB has divided, by its own name or by RRCB's.
struct Divided : Cloud {
    Divided(const char* method, const Setting& setting, int num_parts) : Cloud(method) {
        set(setting.name, setting.value);
        set({{"RRCB_REFINE", "EXACT"}, {"NUM_GLOBAL_PARTS", std::to_string(num_parts)}});
        set("RETURN_LISTS", "PARTS");
        set_size(num_parts / 2, 2);
        outcome = partition();
    }

    Outcome outcome;
};

/// Divides with RRCB once more on two handles of the same contents.
void expect_same_without_settings(Program& program, Zoltan_Struct* handle) {
    for (const char* name : {"OBJ_WEIGHT_DIM", "REDUCE_DIMENSIONS", "AVERAGE_CUTS"}) {
        program.set(name, "0");
        Zoltan_Set_Param(handle, name, "0");
    }
    expect_same(program.partition(handle), program.partition());
    EXPECT_EQ(look_ups(handle, 1), look_ups(program.zz, 1));
}

TEST(Forwarding, survives_copies) {
    for (const Setting& setting : settings) {
        SCOPED_TRACE(setting.name);
        Divided program("RRCB", setting, 5);
        const auto found = look_ups(program.zz, 5);
        Zoltan_Struct* copy = Zoltan_Copy(program.zz);
        Cloud used("RRCB");
        used.partition();
        for (Zoltan_Struct* handle : {copy, used.zz}) {
            if (handle == used.zz) {
                EXPECT_EQ(Zoltan_Copy_To(used.zz, program.zz), ZOLTAN_OK);
            }
            EXPECT_EQ(look_ups(handle, 5), found);
            expect_same(program.partition(handle), program.outcome);
            EXPECT_EQ(look_ups(handle, 5), found);
        }
        expect_same_without_settings(program, copy);
        Zoltan_Destroy(&copy);
        // A copy of one that RRCB has divided is RRCB's.
        EXPECT_EQ(Zoltan_Copy_To(used.zz, program.zz), ZOLTAN_OK);
        EXPECT_EQ(look_ups(used.zz, 5), look_ups(program.zz, 5));
    }
}

TEST(Forwarding, survives_serialization_as_rcb_does) {
    for (const Setting& setting : settings) {
        SCOPED_TRACE(setting.name);
        // With other numbers of parts Zoltan loses their ranks.
        const int num_parts = Program().num_ranks;
        Divided ours("RRCB", setting, num_parts), zoltans("RCB", setting, num_parts);
        Program received(3), received_by_zoltan(3);
        EXPECT_EQ(unpack(received.zz, bytes_of(ours.zz)), ZOLTAN_OK);
        EXPECT_EQ(unpack(received_by_zoltan.zz, bytes_of(zoltans.zz)), ZOLTAN_OK);
        for (int time = 0; time < 2; ++time) {
            EXPECT_EQ(look_ups(received.zz, num_parts), look_ups(received_by_zoltan.zz, num_parts));
            ours.register_callbacks(received.zz);
            zoltans.register_callbacks(received_by_zoltan.zz);
            expect_same(ours.partition(received.zz), zoltans.partition(received_by_zoltan.zz));
        }
        expect_same_without_settings(ours, received.zz);
        // Cuts of RRCB for a handle that Zoltan has divided.
        Divided used("RRCB", setting, 5);
        EXPECT_EQ(unpack(used.zz, bytes_of(ours.zz)), ZOLTAN_OK);
        EXPECT_EQ(look_ups(used.zz, num_parts), look_ups(ours.zz, num_parts));
    }
}

TEST(Forwarding, of_cuts_that_are_not_kept_gives_a_buffer_without_cuts) {
    Cloud program("RRCB");
    program.set({{"KEEP_CUTS", "0"}, {"OBJ_WEIGHT_DIM", "2"}});
    program.partition();
    Program received(3);
    EXPECT_EQ(unpack(received.zz, bytes_of(program.zz)), ZOLTAN_OK);
    EXPECT_FALSE(has_cuts(received.zz));
    program.register_callbacks(received.zz);
    expect_same(program.partition(received.zz), program.partition());
}

TEST(Forwarding, is_agreed_on_by_all_ranks) {
    for (const Setting& setting : settings) {
        SCOPED_TRACE(setting.name);
        Cloud program("RRCB");
        if (program.num_ranks == 1) return;
        const bool last = program.rank == program.num_ranks - 1;
        if (last) program.set(setting.name, setting.value);
        const Outcome outcome = program.partition();
        EXPECT_EQ(outcome.code, ZOLTAN_FATAL);
        EXPECT_EQ(outcome.exports.count, 0);
        EXPECT_FALSE(has_cuts(program.zz));
        if (!last) program.set(setting.name, setting.value);
        EXPECT_EQ(program.partition().code, ZOLTAN_OK);
        EXPECT_TRUE(has_cuts(program.zz));
    }
}

TEST(Forwarding, moves_objects_where_zoltan_is_to_migrate_them) {
    Cloud program("RRCB");
    program.set({{"OBJ_WEIGHT_DIM", "2"}, {"AUTO_MIGRATE", "1"}});
    Migration migration;
    count_migration(program.zz, migration);
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    EXPECT_EQ(migration.packed, outcome.exports.count);
}

}  // namespace
}  // namespace rrcb::zoltan_test
