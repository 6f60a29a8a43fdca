// All collective functions of the interface, one directly after the other in random order, while
// ranks are late at random. Nothing else synchronises the ranks. What a call must give is what it
// gives after a barrier, which the other tests check.
#include "../support/common.hpp"
#include "mpi_layer.hpp"
#include "ranks.hpp"

#include <rrcb/paper.hpp>
#include <rrcb/rrcb.hpp>

#include <cstdlib>
#include <type_traits>

namespace rrcb {
namespace {

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

/// What a rank holds in a round. One rank never has points, others sometimes none.
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

    Points points() const { return Points(coordinates, 2, weights); }

    std::size_t count = 0;
    int num_parts = 1;
    std::vector<Part> parts;
    std::vector<Part> previous;
    std::vector<double> weights;
    std::vector<double> coordinates;
};

/// Bytes of all that a call gave this rank; where a call fails, its text.
class Answer {
  public:
    template <class T>
    Answer& operator<<(const std::vector<T>& values) {
        const auto bytes = std::as_bytes(std::span(values));
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        return *this;
    }
    Answer& operator<<(const std::vector<RankCount>& counts) {
        for (const RankCount& one : counts) *this << one.rank << one.count;
        return *this;
    }
    template <class T>
    requires std::is_arithmetic_v<T> Answer& operator<<(T value) {
        return *this << std::vector{value};
    }
    Answer& operator<<(const Balance& made) {
        for (const Cut& cut : made.cuts.tree)
            for (const double at : cut.at) *this << at;
        return *this << made.parts << made.report.imbalance << made.report.details.num_points;
    }
    Answer& operator<<(const Plan& lists) {
        return *this << lists.export_indices << lists.export_ranks << lists.import_ranks
                     << lists.import_indices << lists.import_parts;
    }

    bool operator==(const Answer&) const = default;

  private:
    std::vector<std::byte> bytes_;
};

/// What this rank holds in a call.
struct Round {
    explicit Round(int round) : number(round), mine(round, rank()) {}

    int num_parts() const { return mine.num_parts; }
    std::uint64_t drawn() const { return mixed(number, options_use, 1); }

    int number;
    Holding mine;
};

Options options_of(const Round& round) {
    constexpr std::array refinements = {Refine::none, Refine::tolerance, Refine::exact};
    Options options{.num_parts = round.num_parts(), .refine = refinements[round.drawn() / 3 % 3]};
    return options;
}

void balances(const Round& round, MPI_Comm comm, Answer& answer) {
    answer << balance(round.mine.points(), comm, options_of(round));
}

void balances_as_in_paper(const Round& round, MPI_Comm comm, Answer& answer) {
    PaperOptions options{
        .num_parts = round.num_parts(),
        .domain = round.drawn() % 2 == 0 ? PaperDomain::sampled : PaperDomain::points};
    answer << balance_as_in_paper(round.mine.points(), comm, options);
}

void balances_twice(const Round& round, MPI_Comm comm, Answer& answer) {
    const Options options = options_of(round);
    const Points points = round.mine.points();
    const Balance first = balance(points, comm, options);
    answer << first << balance(points, comm, options, first.cuts);
}

void plans(const Round& round, MPI_Comm comm, Answer& answer) {
    answer << plan(round.mine.parts, round.num_parts(), comm);
}

TransferOptions transfer_options_of(const Round& round) {
    return {std::size_t{64} << (round.drawn() % 8)};
}

/// Names a point by where it lies.
std::vector<int> numbers_here(const Round& round) {
    std::vector<int> numbers(round.mine.count);
    std::iota(numbers.begin(), numbers.end(), 100 * rank());
    return numbers;
}

void moves(const Round& round, MPI_Comm comm, Answer& answer) {
    const Plan lists = plan(round.mine.parts, round.num_parts(), comm);
    const auto [numbers, x] =
        transfer(lists, columns(numbers_here(round), column(round.mine.coordinates, 2)), comm,
                 transfer_options_of(round));
    answer << lists << numbers << x;
}

void fetches_ghosts(const Round& round, MPI_Comm comm, Answer& answer) {
    const Points points = round.mine.points();
    Cuts cuts = balance(points, comm, options_of(round)).cuts;
    cuts = unstamped(cuts);  // the points stay where they are
    const double radius = std::ldexp(static_cast<double>(round.drawn() % 8), -4);
    const GhostPlan lists = ghost_plan(cuts, points, comm, {.cutoff = radius});
    answer << lists.send << lists.send_indices
           << fetch(lists, numbers_here(round), comm, transfer_options_of(round));
}

void renumbers(const Round& round, MPI_Comm comm, Answer& answer) {
    std::vector<RankRange> ranks;
    for (Part part = 0; part < round.num_parts(); ++part)
        ranks.push_back({ranks_of_part(part, round.num_parts(), num_ranks()).first_rank, 1});
    const Holding& mine = round.mine;
    const Remap result = round.drawn() % 2 == 0 ? remap(mine.parts, mine.previous, ranks, comm)
                                                : remap(mine.parts, ranks, comm);
    answer << result.numbers << result.num_points << result.kept_before << result.kept_after;
}

void measures(const Round& round, MPI_Comm comm, Answer& answer) {
    const Holding& mine = round.mine;
    if (round.drawn() % 2 == 0)
        answer << part_weights(mine.points(), mine.parts, round.num_parts(), comm);
    else
        answer << moved_fraction(mine.points(), mine.parts, round.num_parts(), comm);
}

/// One rank gives a part that is none: all are told, and the next call is none the wiser.
void refuses(const Round& round, MPI_Comm comm, Answer& answer) {
    const auto faulty = static_cast<int>(round.drawn() % static_cast<unsigned>(num_ranks()));
    const std::vector<Part> wrong(1, rank() == faulty ? round.num_parts() : 0);
    try {
        plan(wrong, round.num_parts(), comm);
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_TRUE(text.starts_with("rank " + std::to_string(faulty) + ": ")) << text;
        answer << std::vector<char>(text.begin(), text.end());
    }
}

/// A call is the first one with its communicator, which is freed at once.
void meets_a_new_communicator(const Round& round, MPI_Comm comm, Answer& answer) {
    MPI_Comm other = MPI_COMM_NULL;
    PMPI_Comm_dup(comm, &other);
    plans(round, other, answer);
    MPI_Comm_free(&other);
}

using Call = void (*)(const Round&, MPI_Comm, Answer&);

Call call_of(const Round& round) {
    constexpr std::array<Call, 9> usual = {
        balances, balances_as_in_paper, balances_twice, plans, moves, renumbers, measures,
        refuses,  fetches_ghosts};
    const std::uint64_t drawn = mixed(round.number, call_use);
    // Seldom, since a new communicator takes long to make.
    return drawn % 64 == 0 ? meets_a_new_communicator : usual[drawn / 64 % usual.size()];
}

/// Answers to calls, each by itself or one directly after the other.
std::vector<Answer> answers_to(int first, int num_calls, bool alone) {
    std::vector<Answer> answers(static_cast<std::size_t>(num_calls));
    mpi_layer::delay_calls(alone ? 0 : mixed(rank(), first));
    for (int k = 0; k < num_calls; ++k) {
        const Round round(first + k);
        if (alone) MPI_Barrier(MPI_COMM_WORLD);
        try {
            call_of(round)(round, MPI_COMM_WORLD, answers[static_cast<std::size_t>(k)]);
        } catch (const std::exception& error) {
            ADD_FAILURE() << error.what();
        }
    }
    mpi_layer::delay_calls(0);
    return answers;
}

TEST(Soak, calls_back_to_back_in_any_order_give_what_each_gives_alone) {
    const char* asked = std::getenv("RRCB_TEST_CALLS");
    const int num_calls = asked == nullptr ? 500 : std::atoi(asked);
    const int first = num_calls * num_ranks();  // other rounds for other numbers of ranks
    const std::vector<Answer> expected = answers_to(first, num_calls, true);
    EXPECT_TRUE(answers_to(first, num_calls, false) == expected);
}

}  // namespace
}  // namespace rrcb
