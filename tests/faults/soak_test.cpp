// All collective functions of the interface, one directly after the other in random order, while
// ranks are late at random. Nothing else synchronises the ranks: each knows what the others hold,
// and so what every call must give.
#include "mpi_layer.hpp"
#include "ranks.hpp"

#include <rrcb/paper.hpp>
#include <rrcb/rrcb.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <string>

namespace rrcb {
namespace {

using test::num_ranks;
using test::rank;

/// Splitmix64 (Steele et al. 2014), one step for each number.
template <class... Numbers>
std::uint64_t mixed(Numbers... numbers) {
    std::uint64_t state = 0;
    for (const std::uint64_t number : {static_cast<std::uint64_t>(numbers)...}) {
        state = (state + number + 1) * 0x9e3779b97f4a7c15u;
        state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9u;
        state = (state ^ (state >> 27)) * 0x94d049bb133111ebu;
        state ^= state >> 31;
    }
    return state;
}

enum Use { count_use, part_use, previous_use, weight_use, position_use, call_use, options_use };

/// What a rank holds in a round, told alike by all of them. One rank never has points, others
/// sometimes.
struct Holding {
    Holding(int round, int of_rank) {
        const std::uint64_t drawn = mixed(round, of_rank, count_use);
        count = of_rank == 1 || drawn % 4 == 0 ? 0 : drawn / 4 % 32;
        num_parts = 1 + static_cast<int>(mixed(round, options_use) % 16);
        const auto drawn_part = [&](std::size_t i, Use use) {
            return static_cast<Part>(mixed(round, of_rank, i, use) %
                                     static_cast<std::uint64_t>(num_parts));
        };
        for (std::size_t i = 0; i < count; ++i) {
            parts.push_back(drawn_part(i, part_use));
            previous.push_back(drawn_part(i, previous_use));
            weights.push_back(1 + static_cast<double>(mixed(round, of_rank, i, weight_use) % 4));
            for (const int axis : {0, 1})
                coordinates.push_back(std::ldexp(
                    static_cast<double>(mixed(round, of_rank, i, axis, position_use)), -64));
        }
    }

    Points points() const { return interleaved_points(coordinates, 2, weights); }

    std::size_t count = 0;
    int num_parts = 1;
    std::vector<Part> parts;
    std::vector<Part> previous;
    std::vector<double> weights;
    std::vector<double> coordinates;
};

struct Round {
    explicit Round(int round) : number(round) {
        for (int of_rank = 0; of_rank < num_ranks(); ++of_rank) all.emplace_back(round, of_rank);
    }

    const Holding& mine() const { return all[static_cast<std::size_t>(rank())]; }
    int num_parts() const { return mine().num_parts; }
    std::uint64_t drawn() const { return mixed(number, options_use, 1); }

    template <class Visit>
    void for_each(Visit&& visit) const {
        for (int of_rank = 0; of_rank < num_ranks(); ++of_rank) {
            const Holding& held = all[static_cast<std::size_t>(of_rank)];
            for (std::size_t i = 0; i < held.count; ++i) visit(of_rank, held, i);
        }
    }

    GlobalCount num_points() const {
        GlobalCount sum = 0;
        for (const Holding& held : all) sum += static_cast<GlobalCount>(held.count);
        return sum;
    }

    int number;
    std::vector<Holding> all;
};

bool is_near(double a, double b) {
    return std::abs(a - b) <= 1e-12 * std::abs(b);
}

/// Weight of every part when the points of all ranks are looked up in the cuts.
std::vector<double> weights_by(const Cuts& cuts, const Round& round) {
    std::vector<double> weights(static_cast<std::size_t>(cuts.num_parts));
    round.for_each([&](int, const Holding& held, std::size_t i) {
        const Part part = part_of(cuts, held.points().position(i));
        weights[static_cast<std::size_t>(part)] += held.weights[i];
    });
    return weights;
}

bool is_right(const Balance& result, const Round& round) {
    const Points points = round.mine().points();
    bool right = result.report.details.num_points == round.num_points() &&
                 result.parts.size() == points.count;
    for (std::size_t i = 0; right && i < points.count; ++i)
        right = result.parts[i] == part_of(result.cuts, points.position(i));
    const double measured = result.report.imbalance;
    return right &&
           (std::isnan(measured) || is_near(measured, imbalance(weights_by(result.cuts, round))));
}

Options options_of(const Round& round) {
    constexpr std::array refinements = {Refine::none, Refine::tolerance, Refine::exact};
    Options options;
    options.num_parts = round.num_parts();
    options.refine = refinements[round.drawn() / 3 % 3];
    return options;
}

bool balances(const Round& round, MPI_Comm comm) {
    return is_right(balance(round.mine().points(), options_of(round), {}, comm), round);
}

bool balances_as_in_paper(const Round& round, MPI_Comm comm) {
    PaperOptions options;
    options.num_parts = round.num_parts();
    options.domain = round.drawn() % 2 == 0 ? PaperDomain::sampled : PaperDomain::points;
    return is_right(balance_as_in_paper(round.mine().points(), options, comm), round);
}

bool balances_twice(const Round& round, MPI_Comm comm) {
    const Options options = options_of(round);
    const Points points = round.mine().points();
    const Balance first = balance(points, options, {}, comm);
    return is_right(first, round) && is_right(balance(points, options, first.cuts, comm), round);
}

bool plans(const Round& round, MPI_Comm comm) {
    const Plan lists = plan(round.mine().parts, round.num_parts(), comm);
    Plan expected;
    round.for_each([&](int source, const Holding& held, std::size_t i) {
        const RankRange ranks = ranks_of_part(held.parts[i], round.num_parts(), num_ranks());
        const bool stays = source >= ranks.first_rank && source < ranks.first_rank + ranks.count;
        const int destination = stays ? source : ranks.first_rank + source % ranks.count;
        if (stays) return;
        if (source == rank()) {
            expected.export_indices.push_back(i);
            expected.export_ranks.push_back(destination);
        }
        if (destination == rank()) {
            expected.import_ranks.push_back(source);
            expected.import_indices.push_back(i);
            expected.import_parts.push_back(held.parts[i]);
        }
    });
    return lists.export_indices == expected.export_indices &&
           lists.export_ranks == expected.export_ranks &&
           lists.import_ranks == expected.import_ranks &&
           lists.import_indices == expected.import_indices &&
           lists.import_parts == expected.import_parts;
}

/// Names a point by where it lies.
int number_of(int rank, std::size_t index) {
    return 100 * rank + static_cast<int>(index);
}

std::vector<int> numbers_here(const Round& round) {
    std::vector<int> numbers(round.mine().count);
    std::iota(numbers.begin(), numbers.end(), number_of(rank(), 0));
    return numbers;
}

TransferLimits limits_of(const Round& round) {
    return {std::size_t{64} << (round.drawn() % 8)};
}

bool moves(const Round& round, MPI_Comm comm) {
    const Holding& mine = round.mine();
    const Plan lists = plan(mine.parts, round.num_parts(), comm);
    const auto [numbers, x] = transfer(
        lists, columns(numbers_here(round), column(mine.coordinates, 2)), comm, limits_of(round));
    std::vector<int> expected = numbers_here(round);
    for (const LocalIndex index : lists.export_indices)
        std::erase(expected, number_of(rank(), index));
    for (std::size_t k = 0; k < lists.import_ranks.size(); ++k)
        expected.push_back(number_of(lists.import_ranks[k], lists.import_indices[k]));
    bool right = numbers == expected && x.size() == 2 * expected.size();
    for (std::size_t k = 0; right && k < expected.size(); ++k) {
        const Holding& origin = round.all[static_cast<std::size_t>(expected[k] / 100)];
        right =
            x[2 * k + 1] == origin.coordinates[static_cast<std::size_t>(expected[k] % 100) * 2 + 1];
    }
    return right;
}

/// Square of the distance of a position to the nearest region of this rank.
double square_apart(const Cuts& cuts, const Vector& x) {
    double least = std::numeric_limits<double>::infinity();
    for (Part part = 0; part < cuts.num_parts; ++part) {
        const RankRange ranks = ranks_of_part(part, cuts.num_parts, num_ranks());
        if (rank() < ranks.first_rank || rank() >= ranks.first_rank + ranks.count) continue;
        const Box box = box_of(cuts, part);
        double sum = 0;
        for (const std::size_t a : {0, 1}) {
            const double apart = std::max({0.0, box.lower[a] - x[a], x[a] - box.upper[a]});
            sum += apart * apart;
        }
        least = std::min(least, sum);
    }
    return least;
}

bool fetches_ghosts(const Round& round, MPI_Comm comm) {
    const Points points = round.mine().points();
    Cuts cuts = balance(points, options_of(round), {}, comm).cuts;
    cuts.points = 0;  // the points stay where they are
    const double radius = std::ldexp(static_cast<double>(round.drawn() % 8), -4);
    const GhostPlan lists = ghosts(cuts, points, {.radius = radius}, comm);
    std::vector<int> expected;
    round.for_each([&](int source, const Holding& held, std::size_t i) {
        if (source != rank() && square_apart(cuts, held.points().position(i)) <= radius * radius)
            expected.push_back(number_of(source, i));
    });
    return fetch(lists, numbers_here(round), comm, limits_of(round)) == expected;
}

/// Points that stay under the numbers: in their part, or on their rank.
GlobalCount kept_under(const std::vector<Part>& numbers, const Round& round, bool in_part) {
    GlobalCount kept = 0;
    round.for_each([&](int source, const Holding& held, std::size_t i) {
        const Part number = numbers[static_cast<std::size_t>(held.parts[i])];
        const int home = ranks_of_part(number, round.num_parts(), num_ranks()).first_rank;
        kept += in_part ? number == held.previous[i] : home == source;
    });
    return kept;
}

bool renumbers(const Round& round, MPI_Comm comm) {
    std::vector<RankRange> ranks;
    for (Part part = 0; part < round.num_parts(); ++part)
        ranks.push_back({ranks_of_part(part, round.num_parts(), num_ranks()).first_rank, 1});
    const bool in_part = round.drawn() % 2 == 0;
    const Holding& mine = round.mine();
    const Remap result =
        in_part ? remap(mine.parts, mine.previous, ranks, comm) : remap(mine.parts, ranks, comm);
    std::vector<Part> unchanged(ranks.size());
    std::iota(unchanged.begin(), unchanged.end(), 0);
    return result.num_points == round.num_points() &&
           result.kept_before == kept_under(unchanged, round, in_part) &&
           result.kept_after == kept_under(result.numbers, round, in_part) &&
           result.kept_after >= result.kept_before;
}

bool measures(const Round& round, MPI_Comm comm) {
    const Holding& mine = round.mine();
    std::vector<double> expected(static_cast<std::size_t>(round.num_parts()));
    double moves = 0;
    double all = 0;
    round.for_each([&](int source, const Holding& held, std::size_t i) {
        expected[static_cast<std::size_t>(held.parts[i])] += held.weights[i];
        const RankRange ranks = ranks_of_part(held.parts[i], round.num_parts(), num_ranks());
        if (source < ranks.first_rank || source >= ranks.first_rank + ranks.count)
            moves += held.weights[i];
        all += held.weights[i];
    });
    if (round.drawn() % 2 == 0)
        return part_weights(mine.points(), mine.parts, round.num_parts(), comm) == expected;
    const double moved = moved_fraction(mine.points(), mine.parts, round.num_parts(), comm);
    return moved == (all > 0 ? moves / all : 0);
}

/// One rank gives a part that is none: all are told, and the next call is none the wiser.
bool refuses(const Round& round, MPI_Comm comm) {
    const auto faulty = static_cast<int>(round.drawn() % static_cast<unsigned>(num_ranks()));
    const std::vector<Part> wrong(1, rank() == faulty ? round.num_parts() : 0);
    try {
        plan(wrong, round.num_parts(), comm);
    } catch (const Error& error) {
        const std::string start = "rank " + std::to_string(faulty) + ": ";
        return std::string(error.what()).starts_with(start);
    }
    return false;
}

/// A call is the first one with its communicator, which is freed at once.
bool meets_a_new_communicator(const Round& round, MPI_Comm comm) {
    MPI_Comm other = MPI_COMM_NULL;
    PMPI_Comm_dup(comm, &other);
    const bool right = plans(round, other);
    MPI_Comm_free(&other);
    return right;
}

using Call = bool (*)(const Round&, MPI_Comm);

Call call_of(const Round& round) {
    constexpr std::array<Call, 9> usual = {
        balances, balances_as_in_paper, balances_twice, plans, moves, renumbers, measures,
        refuses,  fetches_ghosts};
    const std::uint64_t drawn = mixed(round.number, call_use);
    // Seldom, since a new communicator takes long to make.
    return drawn % 64 == 0 ? meets_a_new_communicator : usual[drawn / 64 % usual.size()];
}

TEST(Soak, calls_back_to_back_in_any_order_give_what_each_gives_alone) {
    const char* asked = std::getenv("RRCB_TEST_CALLS");
    const int num_calls = asked == nullptr ? 500 : std::atoi(asked);
    const int first = num_calls * num_ranks();  // other rounds for other numbers of ranks
    mpi_layer::delay_calls(mixed(rank()));
    for (int number = first; number < first + num_calls; ++number) {
        const Round round(number);
        bool right = false;
        try {
            right = call_of(round)(round, MPI_COMM_WORLD);
        } catch (const std::exception& error) {
            ADD_FAILURE() << error.what();
        }
        EXPECT_TRUE(right) << "call " << number;
    }
    mpi_layer::delay_calls(0);
}

}  // namespace
}  // namespace rrcb
