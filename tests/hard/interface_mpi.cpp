#include "interface_mpi.hpp"

#include "../support/ranks.hpp"
#include "checks_mpi.hpp"
#include "methods.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/plan.hpp>

namespace rrcb::hard_test {

namespace {

Options options_for(int num_parts) {
    Options options{.num_parts = num_parts, .imbalance_tolerance = asked_tolerance};
    return options;
}

void expect_look_ups_agree(const Points& points, const Balance& result) {
    for (LocalIndex i = 0; i < points.count; ++i) {
        const Vector x = points.position(i);
        ASSERT_EQ(part_of(result.cuts, x), result.parts[i]);
        const std::vector<Part> touched = parts_touching(result.cuts, {x, x});
        ASSERT_EQ(touched, std::vector<Part>{result.parts[i]});
    }
}

void expect_lists_conserve_points(const Balance& result) {
    const Plan lists = plan(result, MPI_COMM_WORLD);
    std::vector<std::uint64_t> leaving;
    std::vector<std::uint64_t> arriving;
    for (std::size_t k = 0; k < lists.export_indices.size(); ++k)
        leaving.push_back(
            journey(lists.export_indices[k], rank(), lists.export_ranks[k], lists.export_parts[k]));
    for (std::size_t k = 0; k < lists.import_indices.size(); ++k)
        arriving.push_back(
            journey(lists.import_indices[k], lists.import_ranks[k], rank(), lists.import_parts[k]));
    expect_same_in_all(leaving, arriving);
    const auto stays = [&](Part part) {
        return ranks_of_part(part, result.cuts.num_parts, num_ranks()).first_rank == rank();
    };
    EXPECT_EQ(lists.export_indices.size() +
                  static_cast<std::size_t>(std::ranges::count_if(result.parts, stays)),
              result.parts.size());
}

void check(const Cloud& cloud, const Method& method, int count, int num_parts) {
    const auto owners = owners_of(cloud, count, Layout::scattered, num_ranks());
    const Share share = share_of(cloud, owners, rank());
    const Options options = options_for(num_parts);
    const Balance result = balance(share.points(), method, options, MPI_COMM_WORLD);
    const std::vector<double> numbers = numbers_of(result.cuts);
    expect_same_on_all_ranks(std::as_bytes(std::span(numbers)));
    expect_look_ups_agree(share.points(), result);
    expect_lists_conserve_points(result);
    const std::vector<Part> all = join_parts(share, result.parts, count, num_parts);
    if (method.balances()) expect_balanced(cloud, all, num_parts, method.tolerance());

    const double imbalance = imbalance_of(cloud, all, num_parts);
    const Report& report = result.report;
    EXPECT_EQ(report.details.num_points, count);
    EXPECT_EQ(report.details.num_empty_parts, std::max(0, num_parts - count));
    EXPECT_LE(report.details.least_imbalance, imbalance * (1 + 1e-12));
    if (!std::isnan(report.imbalance)) {
        EXPECT_NEAR(report.imbalance, imbalance, 1e-12 * imbalance);
    }
    if (!method.keeps_good_cuts() || imbalance > asked_tolerance) return;
    const Share settled = migrated(cloud, all, num_parts);
    const Balance kept = balance(settled.points(), MPI_COMM_WORLD, options, result.cuts);
    EXPECT_EQ(count_moves(settled, kept.parts, all), 0);
}

}  // namespace

void check_interface(const Cloud& cloud) {
    const int num_parts = parts_for(num_ranks());
    const int count = cloud.count(num_parts);
    for (const Method& method : methods) {
        SCOPED_TRACE(std::string(method.domain_name) + " " + method.refine_name);
        check(cloud, method, count, num_parts);
    }
}

}  // namespace rrcb::hard_test
