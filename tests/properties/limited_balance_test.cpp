// Cuts of limited places from balance() itself, whatever the points, options and ranks.
#include "../support/ranks.hpp"
#include "check_mpi.hpp"
#include "expectations.hpp"
#include "limit_reference.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>

#include <cstdio>

namespace rrcb::test {
namespace {

constexpr int num_cases = 150;

/// Limits along an axis of this extent, of sizes that leave room for a few parts or for many.
void add_limits(double lower, double upper, std::int32_t choice, Options& options) {
    const double half = upper / 2 - lower / 2;
    if (!(lower <= upper)) lower = upper = 0;
    const double unit = half > 0 && std::isfinite(half) ? half : 1;
    const bool has_width = choice % 3 != 1;
    const bool has_grid = choice % 3 != 0;
    if (has_width)
        options.expert.axes.min_width.push_back(std::max(unit / (1 + choice / 3 % 29), 5e-324));
    if (has_grid)
        options.expert.axes.grid.push_back({choice / 87 % 2 == 0 ? lower : lower / 3,
                                            std::max(unit / (1 + choice / 174 % 23), 5e-324)});
}

Options limited_options(const Case& input, const Box& box) {
    Options options = input.options();
    for (std::size_t a = 0; a < static_cast<std::size_t>(input.shape.dimension); ++a)
        add_limits(box.lower[a], box.upper[a], input.shape.choice, options);
    return options;
}

/// The answer, or nothing where there is no room; then all ranks are told so alike. Collective.
template <class Call>
std::optional<Balance> answer_of(Call&& call) {
    try {
        return call();
    } catch (const Error& error) {
        const std::string text = error.what();
        if (text.find(" room for ") == std::string::npos &&
            text.find("grid is finer") == std::string::npos)
            throw;
        return std::nullopt;
    }
}

/// All points of `cloud`, each on the rank of its part; parts beyond the ranks start over.
Cloud moved(Cloud cloud, const Cuts& cuts) {
    for (LocalIndex i = 0; i < cloud.size(); ++i)
        cloud.owners[i] = part_of(cuts, cloud.points().position(i)) % num_ranks();
    return cloud;
}

bool all_or_none(bool here) {
    int sum = here ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    return sum == 0 || sum == num_ranks();
}

TEST(LimitedBalance, keeps_widths_and_lines_whatever_the_points) {
    int num_answers = 0;
    expect_for_all_cases(
        [&](const Case& input) -> std::string {
            const Cloud cloud = cloud_of(input, num_ranks());
            const Box box = bounding_box(cloud.points());
            Options options = limited_options(input, box);
            if (input.shape.choice % 2 == 0 && input.part_sizes.empty())
                options.num_parts = num_ranks();
            const Cloud mine = cloud.of_rank(rank());
            const auto first =
                answer_of([&] { return balance(mine.points(), MPI_COMM_WORLD, options); });
            if (!all_or_none(first.has_value())) return "an answer on some ranks alone";
            if (!first || cloud.size() == 0) return {};
            ++num_answers;
            std::string fault = fault_of_limits(first->cuts, options, box);
            if (!fault.empty()) return "first call: " + fault;
            // Where the points lie now.
            const Cloud after = moved(cloud, first->cuts).of_rank(rank());
            const auto second =
                answer_of([&] { return balance(after.points(), MPI_COMM_WORLD, options); });
            if (!second) return "no second answer";
            fault = fault_of_limits(second->cuts, options, box);
            if (!fault.empty()) return "second call: " + fault;
            // From cuts that know no limits.
            Options free = options;
            free.expert.axes.min_width.clear();
            free.expert.axes.grid.clear();
            const Cuts previous = balance(mine.points(), MPI_COMM_WORLD, free).cuts;
            const auto third = answer_of(
                [&] { return balance(mine.points(), MPI_COMM_WORLD, options, previous); });
            if (!third) return "no third answer";
            fault = fault_of_limits(third->cuts, options, box);
            return fault.empty() ? fault : "from earlier cuts: " + fault;
        },
        num_cases);
    EXPECT_GT(num_answers, num_cases / 8);
}

/// The case with so few points, or places on lines, and parts that all bisections can be tried.
Case small(Case input, bool on_lines) {
    constexpr std::size_t most_points = 10;
    input.shape.copies = on_lines ? 30 : 1;
    if (on_lines)
        input.shape.choice = input.shape.choice / 3 * 3 % 1740 + 1 + input.shape.choice % 2;
    for (Space& space : input.shape.spaces)
        if (space != Space::lattice) space = Space::unit;
    if (input.shape.weights != Weights::few_values) input.shape.weights = Weights::none;
    if (!on_lines && input.seeds.size() > most_points) input.seeds.resize(most_points);
    input.shape.num_parts = 2 + input.shape.num_parts % 3;
    input.part_sizes.clear();
    return input;
}

/// Counts how often the imbalance of refined cuts comes near the least there is.
void expect_nearly_least(bool on_lines, Refine refine, double tolerance, double share) {
    int num_answers = 0;
    int num_near = 0;
    double worst = 1;
    expect_for_all_cases(
        [&](const Case& any) -> std::string {
            const Case input = small(any, on_lines);
            const Cloud cloud = cloud_of(input, num_ranks());
            if (cloud.size() == 0) return {};
            Options options = limited_options(input, bounding_box(cloud.points()));
            options.refine = refine;
            options.imbalance_tolerance = tolerance;
            const Cloud mine = cloud.of_rank(rank());
            const auto answer =
                answer_of([&] { return balance(mine.points(), MPI_COMM_WORLD, options); });
            const double least = least_imbalance(cloud.points(), options);
            if (answer.has_value() == std::isinf(least)) return "wrong about the room there is";
            if (!answer) return {};
            ++num_answers;
            const double ratio = answer->report.imbalance / std::max(least, tolerance);
            num_near += ratio <= 1.05 ? 1 : 0;
            worst = std::max(worst, ratio);
            return {};
        },
        num_cases);
    if (rank() == 0)
        std::printf("%d answers, %d of them not within 1.05 of the least imbalance, worst %.3f\n",
                    num_answers, num_answers - num_near, worst);
    EXPECT_GE(num_near, share * num_answers);
}

TEST(LimitedBalance, comes_near_the_least_imbalance_of_a_few_points) {
    expect_nearly_least(false, Refine::exact, 1, 0.9);
    expect_nearly_least(false, Refine::tolerance, 1.01, 0.9);
}

TEST(LimitedBalance, comes_near_the_least_imbalance_on_lines) {
    expect_nearly_least(true, Refine::exact, 1, 0.85);
    expect_nearly_least(true, Refine::tolerance, 1.01, 0.85);
}

}  // namespace
}  // namespace rrcb::test
