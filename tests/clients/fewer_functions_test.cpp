// Linked with a Zoltan that lacks the functions that only some have.
#include "program.hpp"

#include <rrcb/zoltan/optional_functions.h>

#include <gtest/gtest.h>

#include <array>

namespace rrcb::zoltan_test {
namespace {

struct Cloud : Program {
    explicit Cloud(const char* method) {
        scatter_points(*this, 300);
        set("RETURN_LISTS", "PARTS");
        set("OBJ_WEIGHT_DIM", "1");
        set("KEEP_CUTS", "1");
        set("LB_METHOD", method);
    }
};

/// What a call printed on stderr; its result must be the expected one.
template <typename Call, typename Result>
std::string text_of(Call call, Result expected) {
    testing::internal::CaptureStderr();
    const Result result = call();
    std::string text = testing::internal::GetCapturedStderr();
    EXPECT_EQ(result, expected);
    return text;
}

void expect_one_line_naming(const char* function, const std::string& text) {
    EXPECT_NE(text.find(function), text.npos) << text;
    EXPECT_NE(text.find("has no such function"), text.npos) << text;
    EXPECT_EQ(text.find('\n') + 1, text.size()) << text;
}

TEST(FewerFunctions, leave_every_method_as_balanced_as_it_was) {
    for (const char* method : {"RCB", "RRCB"}) {
        Cloud program(method);
        const Outcome outcome = program.partition();
        ASSERT_EQ(outcome.code, ZOLTAN_OK);
        EXPECT_LT(imbalance(program, outcome, program.num_ranks), 1.1);
    }
}

TEST(FewerFunctions, are_all_answered_by_rrcb) {
    Cloud program("RRCB");
    const Outcome outcome = program.partition();
    int parent = 0, lower = 0, upper = 0;
    EXPECT_EQ(Zoltan_RCB_Partition_Tree(program.zz, 0, &parent, &lower, &upper), ZOLTAN_OK);
    std::vector<char> bytes(Zoltan_Serialize_Size(program.zz));
    ASSERT_EQ(Zoltan_Serialize(program.zz, bytes.size(), bytes.data()), ZOLTAN_OK);
    Zoltan_Struct* filled = Zoltan_Create(MPI_COMM_WORLD);
    ASSERT_EQ(Zoltan_Deserialize(filled, bytes.size(), bytes.data()), ZOLTAN_OK);
    const std::vector<int> parts = parts_by_object(outcome);
    for (int i = 0; i < program.size(); ++i) {
        int rank = -1, part = -1;
        double* position = program.coordinates.data() + 2 * i;
        EXPECT_EQ(Zoltan_LB_Point_PP_Assign(filled, position, &rank, &part), ZOLTAN_OK);
        EXPECT_EQ(part, parts[static_cast<std::size_t>(i)]);
    }
    Zoltan_Destroy(&filled);
}

TEST(FewerFunctions, are_reported_as_missing_when_a_method_of_zoltan_needs_them) {
    Cloud program("RCB");
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    int parent = 0, lower = 0, upper = 0;
    expect_one_line_naming(
        "Zoltan_RCB_Partition_Tree",
        text_of([&] { return Zoltan_RCB_Partition_Tree(program.zz, 0, &parent, &lower, &upper); },
                ZOLTAN_FATAL));
    expect_one_line_naming(
        "Zoltan_Serialize_Size",
        text_of([&] { return Zoltan_Serialize_Size(program.zz); }, std::size_t{0}));
    std::array<char, 64> buffer{};
    expect_one_line_naming(
        "Zoltan_Serialize",
        text_of([&] { return Zoltan_Serialize(program.zz, buffer.size(), buffer.data()); },
                ZOLTAN_FATAL));
}

TEST(FewerFunctions, leave_a_handle_as_it_was_when_one_to_fill_it_is_missing) {
    Cloud program("RRCB");
    std::array<char, 64> buffer{};
    expect_one_line_naming(
        "Zoltan_Deserialize",
        text_of([&] { return Zoltan_Deserialize(program.zz, buffer.size(), buffer.data()); },
                ZOLTAN_FATAL));
    EXPECT_EQ(program.set("LB_METHOD", "RRCB"), ZOLTAN_OK);
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
}

}  // namespace
}  // namespace rrcb::zoltan_test
