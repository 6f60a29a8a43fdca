// A flow changes its shape: cuts that keep their axes become bad ones.
#include "../support/clouds.hpp"
#include "../support/ranks.hpp"

#include <rrcb/rrcb.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace rrcb {
namespace {

using test::num_ranks;
using test::rank;

constexpr std::size_t num_points = 12000;

/// Points at one time.
struct State {
    int dimension;
    double spacing;
    Refine refine = Refine::tolerance;
    std::vector<Vector> positions{};

    std::vector<double> mine() const {
        std::vector<double> coordinates;
        for (auto i = static_cast<std::size_t>(rank()); i < positions.size();
             i += static_cast<std::size_t>(num_ranks()))
            coordinates.insert(coordinates.end(), positions[i].begin(),
                               positions[i].begin() + dimension);
        return coordinates;
    }
    Balance balance(const Cuts& previous, const AxisOrder& order = {}) const {
        Options options;
        options.expert.axes.order = order;
        options.num_parts = 4;
        options.refine = refine;
        const std::vector<double> coordinates = mine();
        return rrcb::balance(Points(coordinates, dimension), MPI_COMM_WORLD, options, previous);
    }
    std::vector<Part> parts(const Cuts& cuts) const {
        std::vector<Part> parts;
        for (const Vector& x : positions) parts.push_back(part_of(cuts, x));
        return parts;
    }
    /// Points with a part that is not theirs within two spacings.
    int num_ghosts(const Cuts& cuts) const {
        int number = 0;
        for (const Vector& x : positions) {
            bool is_near = false;
            for (int corner = 0; corner < 1 << dimension; ++corner) {
                Vector y = x;
                for (int a = 0; a < dimension; ++a)
                    y[a] += (corner >> a & 1) != 0 ? 2 * spacing : -2 * spacing;
                is_near = is_near || part_of(cuts, y) != part_of(cuts, x);
            }
            number += is_near ? 1 : 0;
        }
        return number;
    }
};

/// A column of 1 x 2 at time 0 that is a layer of 10 x 0.2 at time 1, and drops.
struct Flow {
    Refine refine = Refine::tolerance;
    std::vector<double> start = test::uniform_cloud(num_points, 2, 21);

    State at(double time) const {
        const double width = std::pow(10, time);
        const double height = 2 * std::pow(0.1, time);
        State state{2, std::sqrt(2.0 / num_points), refine};
        for (std::size_t i = 0; i < num_points; ++i)
            state.positions.push_back(
                {width * start[2 * i], (i % 300 == 0 ? 2 : height) * start[2 * i + 1], 0});
        return state;
    }
};

/// A column of 38 x 16 x 10 at time 0 that grows to a height of 35 by points poured on it, and from
/// time 0.5 to 1 spreads to a layer of 120 x 51 x 3.5.
struct Pour {
    std::vector<double> start = test::uniform_cloud(num_points, 3, 22);

    State at(double time) const {
        const double height = 10 + 50 * std::min(time, 0.5);
        const double wider = std::pow(10, std::max(0.0, time - 0.5));
        State state{3, std::cbrt(38.0 * 16 * 35 / num_points)};
        for (std::size_t i = 0; static_cast<double>(i) < num_points * height / 35; ++i)
            state.positions.push_back({38 * wider * start[3 * i], 16 * wider * start[3 * i + 1],
                                       height / (wider * wider) * start[3 * i + 2]});
        return state;
    }
};

/// Returns the number of points that change parts, of those of both states.
std::size_t num_moved(const std::vector<Part>& before, const std::vector<Part>& after) {
    std::size_t number = 0;
    for (std::size_t i = 0; i < before.size(); ++i) number += before[i] != after[i] ? 1 : 0;
    return number;
}

/// Balances along a motion from earlier cuts; returns how many points move in all.
template <class Motion>
std::size_t follow(const Motion& motion, Balance& balance) {
    balance = motion.at(0).balance({});
    std::vector<Part> parts = motion.at(0).parts(balance.cuts);
    std::size_t moved = 0;
    for (int step = 1; step <= 100; ++step) {
        const State state = motion.at(step / 100.0);
        balance = state.balance(balance.cuts);
        const std::vector<Part> before = std::exchange(parts, state.parts(balance.cuts));
        moved += num_moved(before, parts);
        EXPECT_TRUE(balance.report.within_tolerance);
        if (step % 10 != 0) continue;
        const Cuts anew = state.balance({}).cuts;
        EXPECT_LE(state.num_ghosts(balance.cuts), 1.15 * state.num_ghosts(anew)) << step;
    }
    return moved;
}

TEST(TurningAxes, follow_a_flow_and_move_few_points) {
    Balance balance;
    // Three quarters of the points would change parts if these were numbered as the ends.
    EXPECT_LT(follow(Flow{}, balance), 0.9 * num_points);
    for (const Cut& cut : balance.cuts.tree) EXPECT_EQ(cut.axis, 0);
}

TEST(TurningAxes, follow_a_flow_if_cuts_are_exact) {
    Balance balance;
    EXPECT_LT(follow(Flow{Refine::exact}, balance), 2 * num_points);
    for (const Cut& cut : balance.cuts.tree) EXPECT_EQ(cut.axis, 0);
}

TEST(TurningAxes, follow_a_pour_to_better_axes_although_the_kept_ones_are_no_worse) {
    Balance balance;
    EXPECT_LT(follow(Pour{}, balance), 2 * num_points);
    for (const Cut& cut : balance.cuts.tree) EXPECT_NE(cut.axis, 2);
}

/// Returns how many points change parts at least, however the later parts are numbered.
std::size_t least_moved(const std::vector<Part>& before, const std::vector<Part>& after) {
    std::array<Part, 4> numbers{0, 1, 2, 3};
    std::size_t least = before.size();
    do {
        std::size_t moved = 0;
        for (std::size_t i = 0; i < before.size(); ++i)
            moved += before[i] != numbers[static_cast<std::size_t>(after[i])] ? 1 : 0;
        least = std::min(least, moved);
    } while (std::ranges::next_permutation(numbers).found);
    return least;
}

std::vector<int> axes_of(const Cuts& cuts) {
    std::vector<int> axes;
    for (const Cut& cut : cuts.tree) axes.push_back(cut.axis);
    return axes;
}

/// The debt of the axes of cuts, from counted ghosts and counted moves.
struct CountedDebt {
    double debt = 0;  ///< in points
    bool is_paid = false;

    void add(const State& state, const Cuts& earlier) {
        const std::vector<int> axes = axes_of(earlier);
        const Cuts along = state.balance({}, AxisOrder::given(axes)).cuts;
        const Cuts free = state.balance({}).cuts;
        if (axes_of(free) == axes) return;
        debt += Axes{}.steps / 10 * (state.num_ghosts(along) - state.num_ghosts(free));
        const std::vector<Part> before = state.parts(earlier);
        const auto moved = [&](const Cuts& cuts) {
            return static_cast<double>(least_moved(before, state.parts(cuts)));
        };
        constexpr double half_a_part = num_points / 8.0;  // less is not compared
        is_paid = 3 * debt > std::max(half_a_part, moved(free) - moved(along));
    }
};

/// Returns the numbers of calls that make new cuts until the first turn, and until counts would
/// have turned the cuts; 0: not until then.
template <class Motion>
std::pair<int, int> calls_until_a_turn(const Motion& motion) {
    Balance balance = motion.at(0).balance({});
    CountedDebt counted;
    int paid = 0;
    int calls = 0;
    for (int step = 1; step <= 100; ++step) {
        const State state = motion.at(step / 100.0);
        const Cuts earlier = std::exchange(balance, state.balance(balance.cuts)).cuts;
        if (std::ranges::equal(earlier.tree, balance.cuts.tree, {}, &Cut::at, &Cut::at)) continue;
        ++calls;
        counted.add(state, earlier);
        if (paid == 0 && counted.is_paid) paid = calls;
        if (axes_of(balance.cuts) != axes_of(earlier)) return {calls, paid};
    }
    return {0, paid};
}

TEST(TurningAxes, come_at_most_a_call_after_counts_have_paid) {
    for (const auto& [turn, paid] : {calls_until_a_turn(Flow{}), calls_until_a_turn(Pour{})}) {
        EXPECT_GT(turn, 0);
        EXPECT_TRUE(paid == 0 || turn <= paid + 1) << turn << " " << paid;
    }
}

TEST(TurningAxes, are_kept_by_points_at_rest_and_on_request) {
    const State start = Flow{}.at(0);
    Balance balance = start.balance({});
    const std::vector<Part> parts = start.parts(balance.cuts);
    for (int call = 0; call < 5; ++call) balance = start.balance(balance.cuts);
    EXPECT_EQ(start.parts(balance.cuts), parts);
    std::vector<int> axes;
    for (const Cut& cut : balance.cuts.tree) axes.push_back(cut.axis);
    const Cuts kept = Flow{}.at(1).balance(balance.cuts, AxisOrder::given(axes)).cuts;
    for (std::size_t k = 0; k < kept.tree.size(); ++k) EXPECT_EQ(kept.tree[k].axis, axes[k]);
}

}  // namespace
}  // namespace rrcb
