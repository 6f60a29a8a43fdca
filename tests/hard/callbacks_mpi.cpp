#include "callbacks_mpi.hpp"

#include "../support/ranks.hpp"
#include "checks_mpi.hpp"
#include "methods.hpp"

namespace rrcb::hard_test {

namespace {

using zoltan_test::ListCopy;
using zoltan_test::Outcome;
using zoltan_test::parts_by_object;
using zoltan_test::Program;

void set_parameters(Program& program, const Cloud& cloud, const Method& method, int num_parts) {
    program.set({{"LB_METHOD", "RRCB"}, {"RRCB_DOMAIN", method.domain_name}});
    program.set("RRCB_REFINE", method.refine_name);
    program.set("IMBALANCE_TOL", std::to_string(asked_tolerance));
    program.set("OBJ_WEIGHT_DIM", cloud.weight == nullptr ? "0" : "1");
    program.set({{"NUM_GLOBAL_PARTS", std::to_string(num_parts)}, {"KEEP_CUTS", "1"}});
    // So that look-ups tell the part of every object.
    program.set("RRCB_COINCIDENT", "TOGETHER");
}

void expect_look_ups_agree(const Program& program, std::span<const int> parts, int num_parts) {
    std::vector<int> touched(static_cast<std::size_t>(num_parts));
    std::vector<int> ranks(static_cast<std::size_t>(num_ranks()));
    const auto stride = static_cast<std::size_t>(program.dimension);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        std::array<double, 3> x{};
        std::copy_n(&program.coordinates[i * stride], stride, x.begin());
        int found_rank = -1, found = -1, num_touched = 0, num_touched_ranks = 0;
        Zoltan_LB_Point_PP_Assign(program.zz, x.data(), &found_rank, &found);
        ASSERT_EQ(found, parts[i]);
        Zoltan_LB_Box_PP_Assign(program.zz, x[0], x[1], x[2], x[0], x[1], x[2], ranks.data(),
                                &num_touched_ranks, touched.data(), &num_touched);
        ASSERT_EQ(num_touched, 1);
        ASSERT_EQ(touched[0], parts[i]);
    }
}

std::vector<std::uint64_t> journeys(const ListCopy& list, bool leaving) {
    std::vector<std::uint64_t> all;
    for (std::size_t k = 0; k < list.ranks.size(); ++k)
        all.push_back(journey(list.global_ids[k][0], leaving ? rank() : list.ranks[k],
                              leaving ? list.ranks[k] : rank(), list.parts[k]));
    return all;
}

/// The lists of a second call with the same objects name the same parts, on both sides.
void expect_lists_conserve_objects(Program& program, std::span<const int> parts) {
    program.set("RETURN_LISTS", "ALL");
    const Outcome lists = program.partition();
    expect_same_in_all(journeys(lists.exports, true), journeys(lists.imports, false));
    for (std::size_t k = 0; k < lists.exports.parts.size(); ++k)
        ASSERT_EQ(lists.exports.parts[k], parts[lists.exports.local_ids[k][0]]);
}

/// Fills the program with the objects of this rank's parts; the next call then moves none.
void expect_nothing_moves_again(Program& program, const Cloud& cloud, std::span<const Part> all) {
    fill(program, share_of(cloud, all, rank()));
    program.set({{"RCB_REUSE", "1"}, {"RETURN_LISTS", "ALL"}});
    EXPECT_EQ(program.partition().changes, 0);
}

void check(const Cloud& cloud, const Method& method, int count, int num_parts) {
    const Share share =
        share_of(cloud, owners_of(cloud, count, Layout::sorted, num_ranks()), rank());
    Program program(cloud.dimension);
    set_parameters(program, cloud, method, num_parts);
    fill(program, share);
    program.set("RETURN_LISTS", "PARTS");
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK);

    const std::vector<int> parts = parts_of(program, outcome);
    const std::vector<Part> all = join_parts(share, parts, count, num_parts);
    if (method.balances()) expect_balanced(cloud, all, num_parts, method.tolerance());
    expect_look_ups_agree(program, parts, num_parts);
    expect_lists_conserve_objects(program, parts);
    const bool within = imbalance_of(cloud, all, num_parts) <= asked_tolerance;
    if (method.keeps_good_cuts() && within && num_parts == num_ranks())
        expect_nothing_moves_again(program, cloud, all);
}

}  // namespace

void fill(Program& program, const Share& share) {
    program.coordinates = share.coordinates;
    program.weights.assign(share.numbers.size(), 1);
    std::ranges::transform(share.weights, program.weights.begin(),
                           [](double weight) { return static_cast<float>(weight); });
}

std::vector<int> parts_of(const Program& program, const Outcome& outcome) {
    // Without any change there are no lists.
    if (outcome.changes == 0)
        return std::vector<int>(static_cast<std::size_t>(program.size()), program.rank);
    return parts_by_object(outcome);
}

void check_callbacks(const Cloud& cloud) {
    const int num_parts = parts_for(num_ranks());
    const int count = cloud.count(num_parts);
    for (const Method& method : methods) {
        SCOPED_TRACE(std::string(method.domain_name) + " " + method.refine_name);
        check(cloud, method, count, num_parts);
    }
}

}  // namespace rrcb::hard_test
