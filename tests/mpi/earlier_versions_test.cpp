// What a version keeps from earlier ones: bytes that they saved, and the bits of exact cuts.
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/rrcb.hpp>

#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>

namespace rrcb {
namespace {

/// Bytes that version 0.2 (commit a297397d) saved on 2 ranks.
std::vector<std::byte> saved_bytes(const std::string& name) {
    std::ifstream file(RRCB_SAVED "/" + name, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_GT(text.size(), 100U) << name;
    std::vector<std::byte> bytes(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
}

// 60 points at whole numbers in 5 parts, groups of two with the larger half below.
TEST(EarlierVersions, have_saved_cuts_that_are_read) {
    const Cuts cuts = load<Cuts>(saved_bytes("cuts_0.2"));
    EXPECT_EQ(cuts.dimension, 2);
    EXPECT_EQ(cuts.num_parts, 5);
    EXPECT_EQ(cuts.shape, (TreeShape{2, true}));
    ASSERT_EQ(cuts.tree.size(), 4U);
    constexpr double none = -std::numeric_limits<double>::infinity();
    const std::array<Vector, 4> at{
        {{48.5, none, none}, {none, 28.5, none}, {19, 3.5, none}, {26, none, none}}};
    const std::array axes{0, 1, 0, 0};
    for (std::size_t k = 0; k < at.size(); ++k) {
        EXPECT_EQ(cuts.tree[k].axis, axes[k]);
        EXPECT_EQ(cuts.tree[k].divides, 0);
        EXPECT_EQ(cuts.tree[k].at, at[k]);
    }
    EXPECT_EQ(part_of(cuts, {19, 4}), part_of(cuts, {20, 0}));
    EXPECT_NE(part_of(cuts, {19, 3}), part_of(cuts, {20, 0}));
    EXPECT_TRUE(cuts.numbers.empty());
}

// 40 steps, then 40 more whose load grows by 1/16 of a step on rank 1 until the next rebalance.
TEST(EarlierVersions, have_saved_controllers_that_continue) {
    Controller controller = load<Controller>(saved_bytes("controller_0.2"), MPI_COMM_WORLD);
    if (num_ranks() != 2) return;  // begins anew
    Report report;
    report.details.num_points = 60;
    report.details.total_weight = 60;
    std::string due;
    int since_rebalance = 7;
    for (int step = 40; step < 80; ++step) {
        if (controller.due()) {
            controller.rebalanced({.cost = 2.0, .report = &report});
            since_rebalance = 0;
        }
        const double load = 1 + (rank() == 1 ? 0.0625 * since_rebalance : 0);
        ++since_rebalance;
        due += controller.step({.load = load, .weight = 16.0}) ? '1' : '0';
    }
    EXPECT_EQ(due, "0000000000000000000010000000000000000000");  // as version 0.2 itself went on
}

TEST(EarlierVersions, refuse_bytes_of_later_formats) {
    std::vector<std::byte> bytes = saved_bytes("cuts_0.2");
    const std::uint64_t format = 1000;
    std::memcpy(bytes.data() + sizeof format, &format, sizeof format);
    try {
        load<Cuts>(bytes);
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("saved by a newer RRCB (format 1000"),
                  std::string::npos);
    }
}

/// Cuts of points at whole numbers, whose axes do not depend on estimates.
struct Case {
    int dimension;
    int num_parts;
    bool has_weights;
    bool has_sizes;
    std::uint64_t bits;  ///< of the cuts, as version 0.2 made them
};

Cuts cuts_of(const Case& each) {
    std::vector<double> coordinates;
    std::vector<double> weights;
    for (std::uint32_t i = static_cast<std::uint32_t>(rank()); i < 3000;
         i += static_cast<std::uint32_t>(num_ranks())) {
        std::uint32_t number = i;
        for (int axis = 0; axis < each.dimension; ++axis) {
            number = number * 1664525U + 1013904223U;
            coordinates.push_back(number >> 18);
        }
        if (each.has_weights) weights.push_back(1 + i % 7);
    }
    Options options{.num_parts = each.num_parts, .refine = Refine::exact};
    if (each.has_sizes)
        for (int part = 0; part < each.num_parts; ++part)
            options.part_sizes.push_back(1 + part % 4);
    std::vector<int> axes;
    for (int cut = 0; cut + 1 < each.num_parts; ++cut) axes.push_back(cut % each.dimension);
    options.expert.axes.order = AxisOrder::given(axes);
    return balance(Points(coordinates, each.dimension, weights), MPI_COMM_WORLD, options).cuts;
}

std::uint64_t hash_of(const Cuts& cuts) {
    std::uint64_t hash = 14695981039346656037U;  // FNV-1a over words
    const auto add = [&](std::uint64_t word) { hash = (hash ^ word) * 1099511628211U; };
    for (const Cut& cut : cuts.tree) {
        add(static_cast<std::uint64_t>(cut.axis));
        add(static_cast<std::uint64_t>(cut.divides));
        for (const double at : cut.at) add(std::bit_cast<std::uint64_t>(at));
    }
    return hash;
}

TEST(EarlierVersions, made_exact_cuts_with_the_same_bits) {
    for (const Case& each : {
             Case{1, 7, false, false, 0x142134d0292eaa1d},
             Case{2, 16, false, false, 0xd46b7b312a841b76},
             Case{2, 13, true, false, 0xca06505e8a24a04d},
             Case{3, 12, false, true, 0x7b3dc496dc5edc79},
             Case{3, 31, true, true, 0x1bc214399b5e5183},
         }) {
        SCOPED_TRACE(testing::Message() << each.dimension << "-D, " << each.num_parts << " parts");
        EXPECT_EQ(hash_of(cuts_of(each)), each.bits);
    }
}

}  // namespace
}  // namespace rrcb
