// States saved as bytes: a loop goes on as if it had not stopped, other ranks and machines read
// them, and what is no complete state is refused.
#include "../support/clouds.hpp"
#include "../support/ranks.hpp"
#include "../support/same_error.hpp"

#include <rrcb/experimental/cost.hpp>
#include <rrcb/rrcb.hpp>

#include <bit>

namespace rrcb {
namespace {

using test::expect_same_error;

using Bytes = std::vector<std::byte>;

/// A loop whose controller and model may be saved and loaded between two steps.
struct Loop {
    Controller controller;
    experimental::CostModel model;
    std::vector<int> rebalances{};
    std::vector<std::uint64_t> bits{};  ///< of costs and loads after each step
    int last = 0;

    explicit Loop(MPI_Comm comm) : controller(comm), model(controller, 2) {
        controller.rebalanced({.cost = 0.5});
    }
    Loop(const Bytes& state, const Bytes& of_model, MPI_Comm comm)
        : controller(load<Controller>(state, comm)),
          model(experimental::load_cost_model(of_model, controller)) {}

    void run(int begin, int end, bool rebalances_too = true) {
        for (int step = begin; step < end; ++step) {
            if (rebalances_too && controller.due()) {
                rebalances.push_back(step);
                (void)model.weights({});
                controller.rebalanced({.cost = 0.4 + 0.001 * rank() + 0.01 * (step % 3)});
                last = step;
            }
            // Costs of 2 ms and 10 ms, and a noise of 1 %.
            std::mt19937_64 engine(static_cast<unsigned>(step * 64 + rank()));
            const double drift = (rebalances_too ? step - last : 0) * (rank() == 0 ? 0.04 : -0.002);
            const std::vector<double> columns{100 * (1 + drift),
                                              10.0 + 5 * (rank() % 3) + step % 7};
            const double seconds = 0.002 * columns[0] + 0.01 * columns[1];
            model.step(seconds * test::uniform(engine, 0.99, 1.01), columns);
            for (const double cost : model.costs())
                bits.push_back(std::bit_cast<std::uint64_t>(cost));
        }
    }
};

TEST(Restart, makes_new_parts_from_the_cuts_of_another_number_of_ranks) {
    const std::vector<double> x{0.1 + rank(), 0.3 + rank(), 0.5 + rank(), 0.7 + rank()};
    const Points points(x, 1);
    const Cuts none;
    EXPECT_TRUE(none.empty());
    for (const int others : {1, num_ranks() + 1, 2 * num_ranks()}) {
        const Balance earlier = balance(points, MPI_COMM_WORLD, {.num_parts = others});
        EXPECT_FALSE(earlier.cuts.empty());
        const Cuts loaded = load<Cuts>(save(earlier.cuts));
        const Balance here = balance(points, MPI_COMM_WORLD, {}, loaded);
        EXPECT_EQ(here.cuts.num_parts, num_ranks());
        EXPECT_EQ(here.report.imbalance, 1);
        const Balance same = balance(points, MPI_COMM_WORLD, {.num_parts = others}, loaded);
        EXPECT_EQ(same.cuts.num_parts, others);
    }
}

TEST(Restart, continues_a_loop_with_the_same_rebalances_and_bits) {
    Loop whole(MPI_COMM_WORLD);
    whole.run(0, 200);
    for (const int stop : {0, 1, 2, 37, 100, 101}) {
        Loop first(MPI_COMM_WORLD);
        first.run(0, stop);
        const Bytes state = save(first.controller);
        const Bytes of_model = save(first.model);
        if (num_ranks() <= 8) {
            EXPECT_LE(std::max(state.size(), of_model.size()), 1024U);
        }
        EXPECT_TRUE(test::same_on_all_ranks(static_cast<int>(state.size())));
        Loop second(state, of_model, MPI_COMM_WORLD);
        EXPECT_EQ(second.controller.due(), first.controller.due());
        EXPECT_EQ(second.model.report(), first.model.report());
        second.last = first.last;
        second.run(stop, 200);
        first.rebalances.insert(first.rebalances.end(), second.rebalances.begin(),
                                second.rebalances.end());
        first.bits.insert(first.bits.end(), second.bits.begin(), second.bits.end());
        EXPECT_EQ(first.rebalances, whole.rebalances) << stop;
        EXPECT_EQ(first.bits, whole.bits) << stop;
    }
    EXPECT_EQ(whole.rebalances.size() > 3, num_ranks() > 1);
}

TEST(Restart, changes_nothing_in_what_is_saved) {
    Loop whole(MPI_COMM_WORLD);
    Loop saved(MPI_COMM_WORLD);
    for (int step = 0; step < 100; ++step) {
        whole.run(step, step + 1);
        saved.run(step, step + 1);
        (void)save(saved.controller);
        (void)save(saved.model);
    }
    EXPECT_EQ(saved.rebalances, whole.rebalances);
    EXPECT_EQ(saved.bits, whole.bits);
}

TEST(Restart, uses_costs_from_the_first_step_on_with_another_number_of_ranks) {
    if (num_ranks() < 3) GTEST_SKIP() << "needs two numbers of ranks, both above 1";
    Loop loop(MPI_COMM_WORLD);
    loop.run(0, 100, false);
    const Bytes state = save(loop.controller);
    const Bytes of_model = save(loop.model);
    MPI_Comm fewer = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, rank() < 2 ? 0 : 1, 0, &fewer);
    if (rank() < 2) {
        Loop other(state, of_model, fewer);
        EXPECT_TRUE(other.model.uses_costs()) << other.model.report();
        EXPECT_NEAR(other.model.costs()[0], 0.002, 1e-4);
        EXPECT_NEAR(other.model.costs()[1], 0.01, 1e-4);
        EXPECT_NE(other.model.report().find("loaded from"), std::string::npos);
        EXPECT_FALSE(other.controller.due());
        for (int step = 100; step < 130; ++step) {
            EXPECT_TRUE(other.model.uses_costs()) << step << ": " << other.model.report();
            other.run(step, step + 1, false);
        }
        experimental::CostModel alone = experimental::load_cost_model(of_model, fewer);
        EXPECT_TRUE(alone.uses_costs());
    }
    MPI_Comm_free(&fewer);
}

Cuts cuts_of(int num_parts) {
    const std::vector<double> cloud =
        test::uniform_cloud(200, 2, static_cast<unsigned>(rank() + 3));
    Options options{.num_parts = num_parts};
    return balance(Points(cloud, 2), MPI_COMM_WORLD, options).cuts;
}

/// Returns the bytes as a machine of the other byte order writes them.
Bytes reversed(Bytes bytes) {
    for (std::size_t k = 0; k < bytes.size(); k += 8)
        std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(k),
                     bytes.begin() + static_cast<std::ptrdiff_t>(k + 8));
    return bytes;
}

TEST(Restart, reads_cuts_on_any_ranks_and_in_either_byte_order) {
    Cuts cuts = cuts_of(8);
    cuts.numbers = {7, 0, 6, 1, 5, 2, 4, 3};
    cuts.debt = 0.125;
    const std::vector<double> cloud = test::uniform_cloud(100, 2, 5);
    const Points points(cloud, 2);
    std::vector<Part> expected(points.count);
    assign(cuts, points, expected);
    for (const Bytes& bytes : {save(cuts), reversed(save(cuts))}) {
        const Cuts loaded = load<Cuts>(bytes);
        std::vector<Part> parts(points.count);
        assign(loaded, points, parts);
        EXPECT_EQ(parts, expected);
        EXPECT_EQ(save(loaded), save(cuts));
        EXPECT_EQ(loaded.numbers, cuts.numbers);
        EXPECT_EQ(loaded.debt, cuts.debt);
        // 8 parts on these ranks, whose number is another.
        parts = assign(loaded, points, MPI_COMM_WORLD);
        EXPECT_EQ(parts, expected);
        (void)transfer(plan(parts, 8, MPI_COMM_WORLD), column(cloud, 2), MPI_COMM_WORLD);
        Options options{.num_parts = 7};
        expect_same_error([&] { (void)balance(points, MPI_COMM_WORLD, options, loaded); },
                          "previous cuts have 8 parts, not 7");
        options.num_parts = loaded.num_parts;
        EXPECT_TRUE(balance(points, MPI_COMM_WORLD, options, loaded).report.imbalance < 1.2);
    }
    Loop loop(MPI_COMM_WORLD);
    loop.run(0, 20);
    Loop second(reversed(save(loop.controller)), reversed(save(loop.model)), MPI_COMM_WORLD);
    EXPECT_EQ(second.model.costs(), loop.model.costs());
}

void set_word(Bytes& bytes, std::size_t place, std::uint64_t word) {
    std::memcpy(bytes.data() + 8 * place, &word, 8);
}

TEST(Restart, refuses_what_is_truncated_foreign_newer_or_changed) {
    const auto expect_refused = [](const Bytes& bytes, const std::string& text) {
        expect_same_error([&] { (void)load<Controller>(bytes, MPI_COMM_WORLD); }, text);
        expect_same_error([&] { (void)experimental::load_cost_model(bytes, MPI_COMM_WORLD); },
                          text);
        expect_same_error([&] { (void)load<Cuts>(bytes); }, text);
    };
    const Bytes good = save(cuts_of(5));
    for (std::size_t size = 0; size < good.size(); ++size) {
        const Bytes begin(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_THROW((void)load<Cuts>(begin), Error) << size;
    }
    expect_refused({}, "no state");
    expect_refused(Bytes(100, std::byte{7}), "no state");
    expect_refused(Bytes(good.begin(), good.end() - 8), "pass all bytes");
    expect_refused(Bytes(good.begin(), good.end() - 1), "pass all bytes");
    Bytes longer = good;
    longer.push_back({});
    expect_refused(longer, "pass all bytes");
    Bytes newer = good;
    set_word(newer, 1, 1000);
    expect_refused(newer, "newer RRCB");
    Bytes changed = good;
    changed.back() ^= std::byte{1};
    expect_refused(changed, "checksum");
    expect_same_error([&] { (void)load<Controller>(good, MPI_COMM_WORLD); }, "but of Cuts");
    Loop loop(MPI_COMM_WORLD);
    const Bytes state = save(loop.controller);
    expect_same_error([&] { (void)load<Cuts>(state); }, "but of a Controller");
    // Ranks that read different files.
    if (num_ranks() > 1)
        expect_same_error(
            [&] { (void)load<Controller>(rank() == 0 ? state : reversed(state), MPI_COMM_WORLD); },
            "the saved state");
}

}  // namespace
}  // namespace rrcb
