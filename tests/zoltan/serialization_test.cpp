#include "program.hpp"
#include "regions.hpp"
#include "same_lists.hpp"

#include <zoltan_partition_tree.h>

namespace rrcb::zoltan_test {
namespace {

/// A handle with much to remember, partitioned.
struct Sender : Program {
    Sender() {
        scatter_points(*this, 400);
        set({{"LB_METHOD", "RRCB"}, {"RRCB_DOMAIN", "SAMPLED"}, {"KEEP_CUTS", "1"}});
        set({{"NUM_GLOBAL_PARTS", "7"}, {"RETURN_LISTS", "PARTS"}});
        Zoltan_Set_Param_Vec(zz, "IMBALANCE_TOL", "1.05", 0);
        set_size(2, 3);
        outcome = partition();
    }
    Outcome outcome;
};

void expect_same_look_ups(Sender& sender, Zoltan_Struct* handle) {
    const std::vector<int> parts = parts_by_object(sender.outcome);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Place place = sender.place_of(&sender.coordinates[2 * i], handle);
        ASSERT_EQ(place.code, ZOLTAN_OK);
        EXPECT_EQ(place.part, parts[i]);
    }
    for (int part = 0; part < 7; ++part) {
        const Region expected = region_of(sender.zz, part);
        const Region found = region_of(handle, part);
        EXPECT_EQ(found.lower, expected.lower);
        EXPECT_EQ(found.upper, expected.upper);
    }
}

TEST(Serialization, carries_parameters_sizes_and_cuts_to_communicators_of_any_size) {
    Sender sender;
    const std::vector<char> bytes = bytes_of(sender.zz);
    for (const MPI_Comm comm : {MPI_COMM_WORLD, MPI_COMM_SELF}) {
        Program received(2, comm);
        ASSERT_EQ(unpack(received.zz, bytes), ZOLTAN_OK);
        expect_same_look_ups(sender, received.zz);
        sender.register_callbacks(received.zz);
        const Outcome again = sender.partition(received.zz);
        EXPECT_EQ(again.code, ZOLTAN_OK);
        EXPECT_EQ(again.exports.count, 400);
        if (comm == MPI_COMM_SELF) continue;
        EXPECT_EQ(again.exports.parts, sender.outcome.exports.parts);
        EXPECT_EQ(bytes_of(received.zz), bytes);
    }
}

/// Global ids of the objects that Zoltan_Migrate brings, if every rank sends two to the next one.
std::vector<ZOLTAN_ID_TYPE> migrate(Zoltan_Struct* zz, int rank, int num_ranks) {
    ZOLTAN_OBJ_SIZE_FN* size = [](void*, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR, int*) {
        return 8;
    };
    ZOLTAN_PACK_OBJ_FN* pack = [](void*, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR, int, int, char*,
                                  int*) {};
    ZOLTAN_UNPACK_OBJ_FN* unpack = [](void* data, int, ZOLTAN_ID_PTR id, int, char*, int*) {
        static_cast<std::vector<ZOLTAN_ID_TYPE>*>(data)->push_back(*id);
    };
    std::vector<ZOLTAN_ID_TYPE> received;
    Zoltan_Set_Obj_Size_Fn(zz, size, nullptr);
    Zoltan_Set_Pack_Obj_Fn(zz, pack, nullptr);
    Zoltan_Set_Unpack_Obj_Fn(zz, unpack, &received);
    const int next = (rank + 1) % num_ranks;
    const auto first = static_cast<ZOLTAN_ID_TYPE>(2 * rank);
    // Longer than two ids of one word: a wrong width reads other numbers, not other memory.
    std::vector<ZOLTAN_ID_TYPE> ids = {first, first + 1, 900, 901, 902, 903, 904, 905};
    std::vector<int> ranks(2, next);
    EXPECT_EQ(Zoltan_Migrate(zz, -1, nullptr, nullptr, nullptr, nullptr, 2, ids.data(), ids.data(),
                             ranks.data(), ranks.data()),
              ZOLTAN_OK);
    return received;
}

TEST(Serialization, sets_the_widths_of_ids_for_zoltan_migrate) {
    Program sender, wide;
    sender.set("LB_METHOD", "RRCB");
    wide.set("LB_METHOD", "HSFC");
    const int from = (sender.rank + sender.num_ranks - 1) % sender.num_ranks;
    std::vector<ZOLTAN_ID_TYPE> expected;
    if (sender.num_ranks > 1)
        for (int i = 0; i < 2; ++i) expected.push_back(static_cast<ZOLTAN_ID_TYPE>(2 * from + i));
    wide.set({{"NUM_GID_ENTRIES", "3"}, {"NUM_LID_ENTRIES", "3"}});
    const std::vector<char> of_zoltan = bytes_of(wide.zz);
    for (const bool has_zoltans_parameters : {false, true}) {
        Program receiver;
        if (has_zoltans_parameters) {
            unpack(receiver.zz, of_zoltan);
        } else {
            receiver.set({{"NUM_GID_ENTRIES", "3"}, {"NUM_LID_ENTRIES", "3"}});
        }
        ASSERT_EQ(unpack(receiver.zz, bytes_of(sender.zz)), ZOLTAN_OK);
        EXPECT_EQ(migrate(receiver.zz, sender.rank, sender.num_ranks), expected);
    }
}

using Settings = std::vector<std::pair<const char*, const char*>>;

// A refused value, a later name of the same parameter and a value for all weights after one for
// the first.
TEST(Serialization, gives_the_parameters_that_are_in_force) {
    const std::vector<Settings> cases = {
        {{"RRCB_REFINE", "NONE"}, {"RRCB_SUPPORT_MESH", "2"}, {"RRCB_SUPPORT_MESH", "COARSE"}},
        {{"RRCB_REFINE", "NONE"}, {"RRCB_REFINE", "PERHAPS"}},
        {{"RETURN_LISTS", "EXPORT"}, {"RETURN_LISTS", "NO_SUCH_LIST"}},
        {{"KEEP_CUTS", "1"}, {"KEEP_CUTS", "PERHAPS"}},
        {{"NUM_GLOBAL_PARTS", "3"}, {"NUM_GLOBAL_PARTITIONS", "5"}},
        {{"IMBALANCE_TOL[0]", "1.5"}, {"IMBALANCE_TOL", "1.0001"}}};
    for (const Settings& settings : cases) {
        SCOPED_TRACE(settings.back().first);
        Scattered program(400);
        for (double& x : program.coordinates) x *= x;
        program.set("LB_METHOD", "RRCB");
        for (const auto& [name, value] : settings) {
            const std::string text(name);
            const auto bracket = text.find('[');
            Zoltan_Set_Param_Vec(program.zz, text.substr(0, bracket).c_str(), value,
                                 bracket == text.npos ? -1 : 0);
        }
        Program received, copied;
        EXPECT_EQ(unpack(received.zz, bytes_of(program.zz)), ZOLTAN_OK);
        EXPECT_EQ(Zoltan_Copy_To(copied.zz, program.zz), ZOLTAN_OK);
        const Outcome expected = program.partition();
        for (Zoltan_Struct* handle : {received.zz, copied.zz}) {
            program.register_callbacks(handle);
            const Outcome outcome = program.partition(handle);
            expect_same(outcome.imports, expected.imports);
            expect_same(outcome.exports, expected.exports);
            EXPECT_EQ(region_of(handle, 0).code, region_of(program.zz, 0).code);
        }
    }
}

/// Fills memory that the next handle gets.
void leave_dirty_memory() {
    std::vector<std::vector<char>> blocks;
    for (std::size_t size = 1000; size < 5000; size += 16) blocks.emplace_back(size, 'x');
}

// Plain Zoltan 13.2 aborts or refuses its own buffer.
TEST(Serialization, works_for_a_handle_without_a_method) {
    leave_dirty_memory();
    testing::internal::CaptureStdout();
    Zoltan_Struct* handle = Zoltan_Create(MPI_COMM_WORLD);
    Zoltan_Struct* other = Zoltan_Create(MPI_COMM_WORLD);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(unpack(other, bytes_of(handle)), ZOLTAN_OK);
    Zoltan_Destroy(&handle);
    Zoltan_Destroy(&other);
}

TEST(Serialization, works_before_the_first_partition) {
    Program program;
    program.set("LB_METHOD", "RRCB");
    Program received;
    ASSERT_EQ(unpack(received.zz, bytes_of(program.zz)), ZOLTAN_OK);
    const double position[] = {0, 0};
    EXPECT_EQ(received.place_of(position).code, ZOLTAN_FATAL);
}

TEST(Serialization, refuses_a_truncated_or_changed_buffer_and_leaves_the_handle_as_it_was) {
    Sender sender;
    const std::vector<char> bytes = bytes_of(sender.zz);
    Sender receiver;
    for (std::size_t size = 8; size < bytes.size(); size += 5) {
        ASSERT_EQ(unpack(receiver.zz, {bytes.begin(), bytes.begin() + static_cast<long>(size)}),
                  ZOLTAN_FATAL)
            << size;
    }
    for (std::size_t at = 8; at < bytes.size(); at += 3) {
        std::vector<char> changed = bytes;
        changed[at] = static_cast<char>(changed[at] ^ 0x41);
        ASSERT_EQ(unpack(receiver.zz, changed), ZOLTAN_FATAL) << at;
    }
    expect_same_look_ups(sender, receiver.zz);
}

TEST(Serialization, refuses_a_buffer_of_the_other_byte_order_by_name) {
    Program program;
    program.set("LB_METHOD", "RRCB");
    std::vector<char> bytes = bytes_of(program.zz);
    std::reverse(bytes.begin() + 8, bytes.begin() + 16);  // the size
    testing::internal::CaptureStderr();
    EXPECT_EQ(unpack(program.zz, bytes), ZOLTAN_FATAL);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("the other byte order"),
              std::string::npos);
}

TEST(Serialization, refuses_a_buffer_that_is_too_small_to_write) {
    Sender sender;
    std::vector<char> bytes(Zoltan_Serialize_Size(sender.zz));
    EXPECT_EQ(Zoltan_Serialize(sender.zz, bytes.size() - 1, bytes.data()), ZOLTAN_FATAL);
}

/// The parts under a node, in order, found by the rules of zoltan_partition_tree.h.
void collect_parts(Zoltan_Struct* zz, int node, int expected_parent, std::vector<int>& parts) {
    int parent = 0, left = 0, right = 0;
    ASSERT_EQ(Zoltan_RCB_Partition_Tree(zz, node, &parent, &left, &right), ZOLTAN_OK);
    EXPECT_EQ(parent, expected_parent) << node;
    if (left > 0) {
        collect_parts(zz, left, node + 1, parts);
    } else {
        parts.push_back(-left);
    }
    if (right > 0) {
        collect_parts(zz, right, -(node + 1), parts);
    } else {
        parts.push_back(-right);
    }
}

TEST(PartitionTree, is_walked_by_the_rules_of_zoltan) {
    for (const char* method : {"RCB", "RRCB"}) {
        for (const int num_parts : {2, 3, 7, 16}) {
            SCOPED_TRACE(method + std::to_string(num_parts));
            Scattered program(400, {{"LB_METHOD", method}, {"KEEP_CUTS", "1"}});
            program.set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
            program.partition();
            int parent = 0, left = 0, root = 0;
            ASSERT_EQ(Zoltan_RCB_Partition_Tree(program.zz, 0, &parent, &left, &root), ZOLTAN_OK);
            std::vector<int> parts;
            collect_parts(program.zz, root, -1, parts);
            ASSERT_EQ(parts.size(), static_cast<std::size_t>(num_parts));
            for (int part = 0; part < num_parts; ++part) {
                EXPECT_EQ(parts[static_cast<std::size_t>(part)], part);
            }
        }
    }
}

TEST(PartitionTree, needs_kept_cuts_and_a_node_that_is_there) {
    Scattered program(100, {{"LB_METHOD", "RRCB"}, {"NUM_GLOBAL_PARTS", "3"}});
    program.partition();
    int parent = 0, left = 0, right = 0;
    EXPECT_EQ(Zoltan_RCB_Partition_Tree(program.zz, 1, &parent, &left, &right), ZOLTAN_FATAL);
    program.set("KEEP_CUTS", "1");
    program.partition();
    EXPECT_EQ(Zoltan_RCB_Partition_Tree(program.zz, 2, &parent, &left, &right), ZOLTAN_OK);
    EXPECT_EQ(Zoltan_RCB_Partition_Tree(program.zz, 3, &parent, &left, &right), ZOLTAN_FATAL);
    EXPECT_EQ(Zoltan_RCB_Partition_Tree(program.zz, -1, &parent, &left, &right), ZOLTAN_FATAL);
}

}  // namespace
}  // namespace rrcb::zoltan_test
