#include "failing_memory.hpp"

#include "clouds.hpp"
#include "part_ranks.hpp"

#include <rrcb/detail/paper_steps.hpp>
#include <rrcb/experimental/cost.h>
#include <rrcb/experimental/cost.hpp>
#include <rrcb/rrcb.h>
#include <rrcb/rrcb.hpp>

namespace rrcb {
namespace {

using test::FailingMemory;

constexpr int ok = -1;

/// Code of the Error that `step` throws, ok when it throws none.
template <class Step>
int code_of(Step&& step) {
    try {
        step();
        return ok;
    } catch (const Error& error) {
        return static_cast<int>(error.code());
    }
}

/// Fails each allocation of `call`, and hands the results of calls that succeed to `expect_result`.
template <class Call, class ExpectResult>
void fail_in(Call&& call, ExpectResult&& expect_result) {
    decltype(call()) result;
    FailingMemory(
        {ok, static_cast<int>(ErrorCode::out_of_memory)},
        [&] {
            result = {};
            return code_of([&] { result = call(); });
        },
        [&] { expect_result(result); })
        .run();
}

std::vector<double> cloud_here(int dimension) {
    return test::uniform_cloud(120, dimension, static_cast<unsigned>(rank() + 1));
}

/// Balances again and again by `options`, from `previous` if given.
void fail_in_balance(const Options& options, const Cuts* previous = nullptr,
                     const std::vector<double>& coordinates = cloud_here(2)) {
    const Points points(coordinates, 2);
    const auto call = [&] {
        return previous ? balance(points, MPI_COMM_WORLD, options, *previous)
                        : balance(points, MPI_COMM_WORLD, options);
    };
    const std::vector<Part> expected = call().parts;
    fail_in(call, [&](const Balance& result) { EXPECT_EQ(result.parts, expected); });
}

Options refining(Refine refine) {
    Options options{.num_parts = 6, .imbalance_tolerance = 1.01, .refine = refine};
    return options;
}

TEST(FailingMemory, in_estimated_cuts) {
    fail_in_balance(refining(Refine::none));
}

TEST(FailingMemory, in_cuts_of_the_paper) {
    const std::vector<double> coordinates = cloud_here(2);
    const Points points(coordinates, 2);
    for (const PaperDomain domain : {PaperDomain::sampled, PaperDomain::points}) {
        PaperOptions options{.num_parts = 6, .domain = domain};
        const auto call = [&] { return balance_as_in_paper(points, MPI_COMM_WORLD, options); };
        const std::vector<Part> expected = call().parts;
        fail_in(call, [&](const Balance& result) { EXPECT_EQ(result.parts, expected); });
    }
}

TEST(FailingMemory, in_cuts_refined_to_a_tolerance) {
    fail_in_balance(refining(Refine::tolerance));
}

TEST(FailingMemory, in_exact_cuts) {
    fail_in_balance(refining(Refine::exact));
}

TEST(FailingMemory, in_parts_that_many_ranks_make) {
    if (num_ranks() < 3) return;
    for (const Refine refine : {Refine::tolerance, Refine::exact}) {
        Options options = refining(refine);
        options.expert.max_root_parts = 2;
        fail_in_balance(options);
    }
}

TEST(FailingMemory, in_cuts_from_an_earlier_call) {
    const std::vector<double> coordinates = cloud_here(2);
    const Cuts good = balance(Points(coordinates, 2), MPI_COMM_WORLD, refining(Refine::exact)).cuts;
    Cuts moved = good;
    for (Cut& cut : moved.tree) cut.at[static_cast<std::size_t>(cut.axis)] += 0.05;
    for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact}) {
        fail_in_balance(refining(refine), &good);
        fail_in_balance(refining(refine), &moved);
    }
}

TEST(FailingMemory, in_cuts_made_by_many_ranks) {
    if (num_ranks() < 3) return;
    Options options = refining(Refine::tolerance);
    options.expert.max_root_parts = 2;
    options.num_parts = 9;
    options.imbalance_tolerance = 1.5;
    std::vector<double> coordinates = cloud_here(2);
    const Points points(coordinates, 2);
    Cuts cuts = balance(points, MPI_COMM_WORLD, options).cuts;
    cuts = unstamped(cuts);  // the points stay where they are
    for (double& x : coordinates) x = 1 - x;
    fail_in_balance(options, &cuts, coordinates);
    options.imbalance_tolerance = 1000;
    fail_in_balance(options, &cuts, coordinates);
    std::vector<Part> expected(points.count);
    assign(cuts, points, expected);
    fail_in([&] { return assign(cuts, points, MPI_COMM_WORLD); },
            [&](const std::vector<Part>& parts) { EXPECT_EQ(parts, expected); });
    const auto ghosts_here = [&] {
        return ghost_plan(cuts, points, MPI_COMM_WORLD, {.cutoff = 0.2});
    };
    const GhostPlan near = ghosts_here();
    fail_in(ghosts_here,
            [&](const GhostPlan& found) { EXPECT_EQ(found.send_indices, near.send_indices); });
}

TEST(FailingMemory, in_groups) {
    const std::vector<double> coordinates = cloud_here(2);
    const Points points(coordinates, 2);
    std::vector<std::uint64_t> keys;
    for (LocalIndex i = 0; i < points.count; ++i) keys.push_back(i / 3);
    const auto groups_here = [&] { return groups(points, keys, MPI_COMM_WORLD); };
    const Groups right = groups_here();
    fail_in(groups_here,
            [&](const Groups& found) { EXPECT_EQ(found.coordinates, right.coordinates); });
    const std::vector<double> expected = to_points(right, right.weights, MPI_COMM_WORLD);
    fail_in([&] { return to_points(right, right.weights, MPI_COMM_WORLD); },
            [&](const std::vector<double>& found) { EXPECT_EQ(found, expected); });
    fail_in(
        [&] { return group_sums(right, expected, MPI_COMM_WORLD); },
        [&](const std::vector<double>& found) { EXPECT_EQ(found.size(), right.weights.size()); });
}

TEST(FailingMemory, in_earlier_cuts_that_move) {
    Options options{.num_parts = 2, .imbalance_tolerance = 1.1};
    const std::vector<double> coordinates = cloud_here(2);
    const Points points(coordinates, 2);
    Cuts moved = balance(points, MPI_COMM_WORLD, options).cuts;
    moved.tree[0].at[static_cast<std::size_t>(moved.tree[0].axis)] += 0.12;
    ASSERT_GT(balance(points, MPI_COMM_WORLD, options, moved).report.details.rounds, 1);
    fail_in_balance(options, &moved, coordinates);
}

/// The cloud in slabs, one for each rank, but for a share of it, which the first one has as well.
std::vector<double> slab_here(std::size_t surplus) {
    std::vector<double> coordinates = cloud_here(2);
    for (std::size_t i = 0; i < coordinates.size(); i += 2) coordinates[i] += rank();
    if (rank() > 0) coordinates.resize(coordinates.size() - 2 * surplus);
    return coordinates;
}

TEST(FailingMemory, in_parts_that_stay) {
    // At once; because new ones are no better; or not, as they are too uneven.
    for (const std::size_t surplus : {0u, 4u, 20u}) {
        for (const Refine refine : {Refine::none, Refine::tolerance}) {
            Options options = refining(refine);
            options.num_parts = 0;
            options.imbalance_tolerance = 1.05;
            options.expert.axes.order =
                AxisOrder::given(std::vector<int>(static_cast<std::size_t>(num_ranks() - 1), 0));
            fail_in_balance(options, nullptr, slab_here(surplus));
        }
    }
}

/// Parts that send points from every rank to every other.
std::vector<Part> parts_here() {
    std::vector<Part> parts(60);
    for (std::size_t i = 0; i < parts.size(); ++i)
        parts[i] = static_cast<Part>(i) % (2 * num_ranks());
    return parts;
}

TEST(FailingMemory, in_a_plan) {
    const std::vector<Part> parts = parts_here();
    const auto call = [&] { return plan(parts, 2 * num_ranks(), MPI_COMM_WORLD); };
    const Plan expected = call();
    fail_in(call, [&](const Plan& result) {
        EXPECT_EQ(result.export_indices, expected.export_indices);
        EXPECT_EQ(result.import_indices, expected.import_indices);
        EXPECT_EQ(result.import_ranks, expected.import_ranks);
    });
}

TEST(FailingMemory, in_new_part_numbers) {
    const std::vector<Part> parts = parts_here();
    const std::vector<Part> previous(parts.rbegin(), parts.rend());
    const std::vector<RankRange> ranks = test::ranks_of_parts(2 * num_ranks());
    for (const bool on_rank : {true, false}) {
        const auto call = [&] {
            return on_rank ? remap(parts, ranks, MPI_COMM_WORLD)
                           : remap(parts, previous, ranks, MPI_COMM_WORLD);
        };
        const Remap expected = call();
        fail_in(call, [&](const Remap& result) {
            EXPECT_EQ(result.numbers, expected.numbers);
            EXPECT_EQ(result.kept_after, expected.kept_after) << "a rank was left out";
        });
    }
}

TEST(FailingMemory, in_the_weights_of_the_parts) {
    const std::vector<double> coordinates = cloud_here(2);
    const Points points(coordinates, 2);
    const std::vector<Part> parts(points.count, rank());
    fail_in([&] { return part_weights(points, parts, num_ranks(), MPI_COMM_WORLD); },
            [](const std::vector<double>& weights) { EXPECT_EQ(weights[0], 120); });
}

TEST(FailingMemory, in_columns_that_move) {
    const std::vector<Part> parts = parts_here();
    const Plan lists = plan(parts, 2 * num_ranks(), MPI_COMM_WORLD);
    const std::vector<double> positions(3 * parts.size(), rank());
    const auto call = [&] {
        return transfer(lists, columns(parts, column(positions, 3)), MPI_COMM_WORLD, {300});
    };
    const auto expected = call();
    fail_in(call, [&](const auto& result) { EXPECT_EQ(result, expected); });
}

TEST(FailingMemory, in_ghosts_and_columns_fetched_and_added) {
    const std::vector<double> coordinates = cloud_here(2);
    const Points points(coordinates, 2);
    Options options{.num_parts = 2 * num_ranks()};
    Cuts cuts = balance(points, MPI_COMM_WORLD, options).cuts;
    cuts = unstamped(cuts);  // the points stay where they are
    const auto call = [&] {
        const GhostPlan lists = ghost_plan(cuts, points, MPI_COMM_WORLD, {.cutoff = 0.1});
        const std::vector<double> near = fetch(lists, column(coordinates, 2), MPI_COMM_WORLD);
        return accumulate(lists, column(near, 2), column(coordinates, 2), MPI_COMM_WORLD);
    };
    const std::vector<double> expected = call();
    fail_in(call, [&](const std::vector<double>& result) { EXPECT_EQ(result, expected); });
}

TEST(FailingMemory, in_a_cost_model_whose_controller_goes_on) {
    const auto call = [] {
        std::pair<std::optional<Controller>, std::optional<experimental::CostModel>> made;
        Controller& controller = made.first.emplace(MPI_COMM_WORLD);
        try {
            made.second.emplace(controller, 3);
            return made;
        } catch (const std::exception&) {
            for (int step = 0; step < 3; ++step) controller.step({.load = 1});
            throw;
        }
    };
    fail_in(call, [](auto& made) {
        const std::array columns{1.0, 2.0, 3.0};
        for (int step = 0; step < 3; ++step) made.second->step(1, columns);
        EXPECT_FALSE(made.first->due());
    });
}

TEST(FailingMemory, in_a_cost_model_of_its_own) {
    const auto call = [] {
        return std::optional<experimental::CostModel>(std::in_place, MPI_COMM_WORLD, 3);
    };
    fail_in(call, [](auto& made) {
        const std::array columns{1.0, 2.0, 3.0};
        for (int step = 0; step < 3; ++step) made->step(1, columns);
        EXPECT_FALSE(made->uses_costs());
    });
}

TEST(FailingMemory, in_a_cost_model_on_a_new_communicator) {
    MPI_Comm comm = MPI_COMM_NULL;
    FailingMemory(
        {ok, static_cast<int>(ErrorCode::out_of_memory)},
        [&] {
            MPI_Comm_dup(MPI_COMM_WORLD, &comm);
            const int code = code_of([&] { experimental::CostModel(comm, 3); });
            MPI_Comm_free(&comm);
            return code;
        },
        [] {})
        .run();
}

/// Fails each allocation of a call that is not collective; nothing but Error may leave it.
template <class Call>
void fail_locally(const char* name, Call&& call) {
    SCOPED_TRACE(name);
    for (const auto shortage : {memory_layer::Shortage::once, memory_layer::Shortage::lasting}) {
        int code = !ok;
        for (long number = 1; code != ok; ++number) {
            memory_layer::fail_allocation(number, shortage);
            code = code_of(call);
            memory_layer::fail_allocation(0);
            if (code == ok) continue;
            EXPECT_EQ(code, static_cast<int>(ErrorCode::out_of_memory)) << number;
        }
        EXPECT_EQ(code_of(call), ok);
    }
}

TEST(FailingMemory, in_functions_of_one_rank) {
    experimental::CostModel model(MPI_COMM_WORLD, 2);
    const std::vector<double> coordinates = cloud_here(2);
    const Points points(coordinates, 2);
    const Cuts cuts = balance(points, MPI_COMM_WORLD, refining(Refine::exact)).cuts;
    const Box box = bounding_box(points);
    const SupportMesh mesh = make_support_mesh(box, 2, 4);
    const std::vector<CellMoments> cells = cell_moments(points, mesh);
    std::vector<Part> parts(points.count);
    fail_locally("weights", [&] { (void)model.weights(coordinates); });
    fail_locally("costs", [&] { (void)model.costs(); });
    fail_locally("report", [&] { (void)model.report(); });
    fail_locally("assign", [&] { assign(cuts, points, parts); });
    fail_locally("parts_touching", [&] { (void)parts_touching(cuts, box); });
    fail_locally("load_unbalance_percent", [&] { (void)load_unbalance_percent(coordinates); });
    fail_locally("cell_moments", [&] { (void)cell_moments(points, mesh); });
    fail_locally("analytic_domain", [&] { (void)analytic_domain(cells, 2, box); });
    fail_locally("bisect", [&] { (void)bisect(StatisticalDomain{2}, 5, {}); });
    fail_locally("mass_points", [&] { (void)mass_points(points); });
    fail_locally("sample_points", [&] { (void)sample_points(cells, 2, {}); });
    fail_locally("bisect_points", [&] { (void)bisect_points({}, 2, 5); });
}

TEST(FailingMemory, in_handles_of_c) {
    rrcb_controller* controller = nullptr;
    rrcb_cost_model* model = nullptr;
    const auto destroy = [&] {
        rrcb_cost_model_destroy(&model);
        rrcb_controller_destroy(&controller);
        model = nullptr;
        controller = nullptr;
    };
    const auto create = [&] {
        destroy();
        const int code = rrcb_controller_create(MPI_COMM_WORLD, &controller);
        return code == RRCB_OK ? rrcb_cost_model_create(MPI_COMM_WORLD, controller, 2, &model)
                               : code;
    };
    FailingMemory({RRCB_OK, RRCB_OUT_OF_MEMORY}, create, [&] {
        const std::array columns{1.0, 2.0};
        EXPECT_EQ(rrcb_cost_model_step(model, 1, 2, columns.data()), RRCB_OK);
    }).run();
    destroy();
}

TEST(Memory, of_a_transfer_fifty_times_its_limit_stays_below_it) {
    constexpr std::size_t limit = 1 << 18;
    struct Point {
        std::array<char, 1 << 12> bytes;
    };
    const std::size_t num_points = 50 * limit / sizeof(Point) + 1;
    const std::vector<Part> parts(num_points, (rank() + 1) % num_ranks());
    const Plan lists = plan(parts, num_ranks(), MPI_COMM_WORLD);
    const std::vector<Point> points(num_points);
    TransferReport report;
    memory_layer::restart_peak();
    const std::vector<Point> moved = transfer(lists, points, MPI_COMM_WORLD, {limit, &report});
    const long peak = memory_layer::peak_bytes();
    // Beside the result and the messages there is a list of the points to send, and of the pieces.
    const long lists_bytes = static_cast<long>(64 * num_points + 4096);
    const long of_messages = peak - static_cast<long>(num_points * sizeof(Point)) - lists_bytes;
    EXPECT_EQ(moved.size(), num_points);
    EXPECT_LE(report.peak_bytes, limit);
    EXPECT_LE(of_messages, static_cast<long>(limit));
    EXPECT_LE(static_cast<long>(report.peak_bytes), of_messages + lists_bytes);
}

}  // namespace
}  // namespace rrcb
