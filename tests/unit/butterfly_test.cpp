// Records of virtual ranks reach their owners joined, and answers come back to all that asked.
#include "collective/butterfly.hpp"

#include "../support/common.hpp"
#include "../support/virtual_butterfly.hpp"

#include <bit>

namespace rrcb {
namespace {

using test::run_pass;
using Way = Butterfly::Way;

constexpr auto nobody_fails = [](int, int) { return false; };

/// Sums of whole numbers, which are exact, and the largest length.
void add_up(std::span<const double> a, std::span<const double> b, std::vector<double>& joined) {
    for (std::size_t k = 0; k < std::max(a.size(), b.size()); ++k)
        joined.push_back((k < a.size() ? a[k] : 0) + (k < b.size() ? b[k] : 0));
}

/// Ranks with random records: some none, some many, keys of any owner.
struct Ranks {
    int num_ranks;
    std::vector<Butterfly> all;
    std::vector<std::set<Key>> asked;
    std::map<Key, std::vector<double>> sums;  ///< of each key, added up here one by one

    explicit Ranks(int num, Butterfly::Join join = add_up, Way way = Way::spread)
        : num_ranks(num), asked(static_cast<std::size_t>(num)) {
        for (int rank = 0; rank < num; ++rank) all.emplace_back(rank, num, join, way);
        add_records();
    }

    int owner_of(Key key) const {
        return all[0].is_central() ? 0 : static_cast<int>((key * 7) % static_cast<Key>(num_ranks));
    }

    void add_records() {
        std::mt19937 random(static_cast<unsigned>(num_ranks));
        for (std::size_t rank = 0; rank < all.size(); ++rank) {
            const std::size_t count = random() % 4 == 0 ? 0 : random() % 12;
            for (std::size_t k = 0; k < count; ++k)
                asked[rank].insert(random() % (2 * all.size() + 3));
            for (const Key key : asked[rank]) {
                std::vector<double> payload(1 + random() % 3);
                for (double& x : payload) x = static_cast<double>(random() % 1000);
                all[rank].add(key, owner_of(key), payload);
                std::vector<double>& sum = sums[key];
                sum.resize(std::max(sum.size(), payload.size()));
                for (std::size_t i = 0; i < payload.size(); ++i) sum[i] += payload[i];
            }
        }
    }

    std::vector<Flags> flags() const { return std::vector<Flags>(all.size()); }
};

int log2_up(int n) {
    return std::bit_width(static_cast<unsigned>(n - 1));
}

std::vector<int> numbers_of_ranks() {
    std::vector<int> numbers(70);
    std::iota(numbers.begin(), numbers.end(), 1);
    numbers.insert(numbers.end(), {127, 128, 129, 1000, 2049});
    return numbers;
}

template <class Visit>
void for_each_case(Visit&& visit) {
    for (const int num_ranks : numbers_of_ranks())
        for (const Way way : {Way::spread, Way::central}) visit(num_ranks, way);
}

TEST(Butterfly, brings_records_joined_to_their_owners) {
    for_each_case([](int num_ranks, Way way) {
        Ranks ranks(num_ranks, add_up, way);
        run_pass(ranks.all, Butterfly::to_owners, ranks.flags(), nobody_fails);
        std::map<Key, std::vector<double>> found;
        for (const Butterfly& rank : ranks.all)
            rank.owned().for_each([&](const Record& record) {
                EXPECT_EQ(record.owner, rank.rank());
                EXPECT_EQ(ranks.owner_of(record.key), rank.rank());
                EXPECT_FALSE(found.contains(record.key)) << "twice";
                found[record.key] = {record.payload.begin(), record.payload.end()};
            });
        ASSERT_EQ(found, ranks.sums) << num_ranks << " ranks";
    });
}

TEST(Butterfly, brings_answers_back_to_all_that_asked) {
    for_each_case([](int num_ranks, Way way) {
        Ranks ranks(num_ranks, add_up, way);
        run_pass(ranks.all, Butterfly::to_owners, ranks.flags(), nobody_fails);
        for (Butterfly& rank : ranks.all)
            rank.owned().for_each([&](const Record& record) {
                const std::vector<double> answer(1 + record.key % 5, record.payload[0] + 1);
                rank.answer(record.key, answer);
            });
        run_pass(ranks.all, Butterfly::back, ranks.flags(), nobody_fails);
        for (std::size_t rank = 0; rank < ranks.all.size(); ++rank) {
            std::set<Key> answered;
            ranks.all[rank].answers().for_each([&](const Record& answer) {
                EXPECT_TRUE(answered.empty() || *answered.rbegin() < answer.key);
                answered.insert(answer.key);
                EXPECT_EQ(answer.payload.size(), 1 + answer.key % 5);
                EXPECT_EQ(answer.payload[0], ranks.sums.at(answer.key)[0] + 1);
            });
            EXPECT_TRUE(std::ranges::includes(answered, ranks.asked[rank])) << num_ranks;
        }
    });
}

TEST(Butterfly, takes_a_message_a_step_and_a_step_a_halving) {
    for (const int num_ranks : numbers_of_ranks()) {
        Ranks ranks(num_ranks);
        const auto there = run_pass(ranks.all, Butterfly::to_owners, ranks.flags(), nobody_fails);
        EXPECT_EQ(there.num_steps, log2_up(num_ranks));
        EXPECT_LE(there.most_messages, static_cast<std::size_t>(log2_up(num_ranks)));
        const auto back = run_pass(ranks.all, Butterfly::back, ranks.flags(), nobody_fails);
        EXPECT_EQ(back.num_steps, log2_up(num_ranks));
        EXPECT_LE(back.most_messages, 2U * static_cast<std::size_t>(log2_up(num_ranks)));
    }
}

TEST(Butterfly, sends_one_message_less_than_there_are_ranks_in_a_central_pass) {
    for (const int num_ranks : numbers_of_ranks()) {
        Ranks ranks(num_ranks, add_up, Way::central);
        for (const auto direction : {Butterfly::to_owners, Butterfly::back}) {
            auto flags = ranks.flags();
            for (std::size_t rank = 0; rank < flags.size(); ++rank)
                flags[rank][1] = rank == 0 ? 1 : 2;
            const auto counts = run_pass(ranks.all, direction, flags, nobody_fails);
            EXPECT_EQ(counts.num_steps, log2_up(num_ranks));
            EXPECT_EQ(counts.num_messages, static_cast<std::size_t>(num_ranks - 1));
            const bool is_there = direction == Butterfly::to_owners;
            EXPECT_EQ(ranks.all[0].flags()[1], is_there && num_ranks > 1 ? 2 : 1)
                << "rank 0 hears of all on the way there, and of none on the way back";
        }
    }
}

TEST(Butterfly, sends_along_a_link_what_its_other_end_receives) {
    for_each_case([](int num_ranks, Way way) {
        Ranks ranks(num_ranks, add_up, way);
        // Both forwards and back, as a rank is asked.
        for (const auto direction : {Butterfly::to_owners, Butterfly::back})
            for (Butterfly& rank : ranks.all)
                for (int k = 0; k < rank.num_steps(); ++k) {
                    const bool is_there = direction == Butterfly::to_owners;
                    const int step = is_there ? k : rank.num_steps() - 1 - k;
                    for (const auto& link : rank.links(step, direction)) {
                        Butterfly& other = ranks.all[static_cast<std::size_t>(link.rank)];
                        int matching = 0;
                        for (const auto& there : other.links(step, direction))
                            matching += there.rank == rank.rank() && there.sends == link.receives &&
                                        there.receives == link.sends;
                        ASSERT_EQ(matching, 1) << num_ranks;
                        ASSERT_LT(step, other.num_steps());
                    }
                }
    });
}

TEST(Butterfly, tells_the_largest_flags_to_all_also_where_ranks_send_no_records) {
    const auto some_fail = [](int rank, int step) { return (rank + step) % 3 == 0; };
    for (const int num_ranks : numbers_of_ranks()) {
        Ranks ranks(num_ranks);
        for (const auto direction : {Butterfly::to_owners, Butterfly::back}) {
            // Each rank in turn is the only one with a flag.
            for (int one = 0; one < (num_ranks < 100 ? num_ranks : 3); ++one) {
                auto flags = ranks.flags();
                mark_failed(flags[static_cast<std::size_t>(one)], one, num_ranks);
                flags[static_cast<std::size_t>(num_ranks - 1)][1] = 5;
                flags[static_cast<std::size_t>(num_ranks / 2)][2] = 0.5;
                run_pass(ranks.all, direction, flags, some_fail);
                for (const Butterfly& rank : ranks.all) {
                    ASSERT_EQ(failing_rank(rank.flags(), num_ranks), one) << num_ranks;
                    ASSERT_EQ(rank.flags()[1], 5);
                    ASSERT_EQ(rank.flags()[2], 0.5);
                }
            }
        }
    }
}

TEST(Butterfly, names_the_lowest_of_the_failing_ranks_and_none_where_there_is_none) {
    Ranks ranks(11);
    auto flags = ranks.flags();
    run_pass(ranks.all, Butterfly::to_owners, flags, nobody_fails);
    for (const Butterfly& rank : ranks.all) EXPECT_EQ(failing_rank(rank.flags(), 11), no_rank);
    for (const int failing : {9, 4, 10})
        mark_failed(flags[static_cast<std::size_t>(failing)], failing, 11);
    run_pass(ranks.all, Butterfly::back, flags, nobody_fails);
    for (const Butterfly& rank : ranks.all) EXPECT_EQ(failing_rank(rank.flags(), 11), 4);
}

TEST(Butterfly, loses_no_more_than_what_a_failing_rank_had) {
    // The rank's own record is lost, and what is owned beyond it arrives from all others.
    const int num_ranks = 6;
    std::vector<Butterfly> all;
    for (int rank = 0; rank < num_ranks; ++rank) {
        all.emplace_back(rank, num_ranks, add_up);
        all.back().add(0, 0, std::vector<double>{1});
    }
    run_pass(all, Butterfly::to_owners, std::vector<Flags>(6),
             [](int rank, int) { return rank == 5; });
    ASSERT_FALSE(all[0].owned().empty());
    EXPECT_EQ(all[0].owned().read().next().payload[0], 5);
}

TEST(Butterfly, keeps_records_of_one_key_apart_where_they_are_not_joined) {
    Ranks ranks(9, nullptr);
    std::map<Key, std::size_t> expected;
    for (const auto& keys : ranks.asked)
        for (const Key key : keys) ++expected[key];
    run_pass(ranks.all, Butterfly::to_owners, ranks.flags(), nobody_fails);
    std::map<Key, std::size_t> found;
    for (const Butterfly& rank : ranks.all)
        rank.owned().for_each([&](const Record& record) { ++found[record.key]; });
    EXPECT_EQ(found, expected);
}

TEST(Butterfly, starts_anew_once_cleared) {
    Ranks ranks(5);
    run_pass(ranks.all, Butterfly::to_owners, ranks.flags(), nobody_fails);
    for (Butterfly& rank : ranks.all) rank.clear();
    ranks.all[4].add(3, 2, std::vector<double>{8});
    run_pass(ranks.all, Butterfly::to_owners, ranks.flags(), nobody_fails);
    for (Butterfly& rank : ranks.all) EXPECT_EQ(rank.owned().empty(), rank.rank() != 2);
    ranks.all[2].answer(3, std::vector<double>{9});
    run_pass(ranks.all, Butterfly::back, ranks.flags(), nobody_fails);
    ASSERT_FALSE(ranks.all[4].answers().empty());
    EXPECT_EQ(ranks.all[4].answers().read().next().payload[0], 9);
    EXPECT_TRUE(ranks.all[1].answers().empty()) << "rank 1 is on no way from 4 to 2";
}

}  // namespace
}  // namespace rrcb
