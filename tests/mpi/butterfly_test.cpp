// The messages of butterflies: whatever their length, and whatever fails on a rank.
#include "../support/common.hpp"
#include "../support/ranks.hpp"
#include "collective/butterfly_mpi.hpp"
#include "collective/duplicate.hpp"

namespace rrcb {
namespace {

void add_up(std::span<const double> a, std::span<const double> b, std::vector<double>& joined) {
    std::ranges::transform(a, b, std::back_inserter(joined), std::plus<>());
}

/// A search of all ranks: rank r asks for the keys 0, 1 + r % 2, 3 + r, ..., which rank
/// key % num_ranks owns, each with as many doubles as `length` says of it.
class ButterflyMessagesTest : public testing::Test {
  protected:
    static bool asks(int who, Key key) {
        return key == 0 || (key + static_cast<Key>(who)) % 3 == 0;
    }
    static int owner_of(Key key) { return static_cast<int>(key % static_cast<Key>(num_ranks())); }

    void add_all(Butterfly& butterfly, std::size_t length) const {
        for (Key key = 0; key < num_keys; ++key)
            if (asks(rank(), key))
                butterfly.add(key, owner_of(key), std::vector<double>(length + key, rank() + 1.0));
    }

    double sum_of(Key key) const {
        double sum = 0;
        for (int who = 0; who < num_ranks(); ++who) sum += asks(who, key) ? who + 1 : 0;
        return sum;
    }

    void expect_owned(const Butterfly& butterfly, std::size_t length) const {
        Key num_owned = 0;
        butterfly.owned().for_each([&](const Record& record) {
            ++num_owned;
            EXPECT_EQ(owner_of(record.key), rank());
            EXPECT_EQ(record.payload.size(), length + record.key);
            EXPECT_EQ(std::ranges::count(record.payload, sum_of(record.key)),
                      std::ssize(record.payload));
        });
        Key expected = 0;
        for (Key key = 0; key < num_keys; ++key)
            expected += owner_of(key) == rank() && sum_of(key) > 0;
        EXPECT_EQ(num_owned, expected);
    }

    void answer_all(Butterfly& butterfly, std::size_t length) const {
        butterfly.owned().for_each([&](const Record& record) {
            butterfly.answer(record.key, std::vector<double>(length, -sum_of(record.key)));
        });
    }

    void expect_answers(const Butterfly& butterfly, std::size_t length) const {
        std::vector<Key> answered;
        butterfly.answers().for_each([&](const Record& answer) {
            answered.push_back(answer.key);
            EXPECT_EQ(answer.payload.size(), length);
            EXPECT_EQ(std::ranges::count(answer.payload, -sum_of(answer.key)),
                      std::ssize(answer.payload));
        });
        for (Key key = 0; key < num_keys; ++key)
            EXPECT_TRUE(!asks(rank(), key) || std::ranges::count(answered, key) == 1);
    }

    static constexpr Key num_keys = 40;
    Participant self{mpi::enter(MPI_COMM_WORLD, CallName::none).comm};
    ButterflyMessages messages;
};

TEST_F(ButterflyMessagesTest, bring_records_to_owners_and_answers_back) {
    // From nothing but heads to several pieces, more in one direction than in the other; one round
    // after the other, without a barrier.
    for (const std::size_t length : {1U, 0U, 300U, 20000U, 1U}) {
        Butterfly butterfly(rank(), num_ranks(), add_up);
        for (const std::size_t answer : {0U, 3U, 9000U}) {
            butterfly.clear();
            add_all(butterfly, length);
            messages.run(butterfly, Butterfly::to_owners, {}, self);
            expect_owned(butterfly, length);
            answer_all(butterfly, answer);
            messages.run(butterfly, Butterfly::back, {}, self);
            expect_answers(butterfly, answer);
        }
    }
}

TEST_F(ButterflyMessagesTest, tell_all_ranks_the_largest_flags) {
    Butterfly butterfly(rank(), num_ranks(), add_up);
    for (const auto direction : {Butterfly::to_owners, Butterfly::back}) {
        messages.run(butterfly, direction, {0, 1.0 + rank(), rank() == 0 ? 7.5 : 0}, self);
        EXPECT_EQ(butterfly.flags(), (Flags{0, 1.0 * num_ranks(), 7.5, 0}));
    }
}

TEST_F(ButterflyMessagesTest, tell_all_ranks_what_failed_on_one_before) {
    Butterfly butterfly(rank(), num_ranks(), add_up);
    for (const auto direction : {Butterfly::to_owners, Butterfly::back}) {
        for (int failing = 0; failing < num_ranks(); ++failing) {
            Participant mine{self.comm};
            butterfly.clear();
            add_all(butterfly, 2000);
            // Those above fail as well: the lowest is named.
            if (rank() >= failing)
                mine.failure = failure_of(ErrorCode::internal, "broken " + std::to_string(rank()));
            try {
                messages.run(butterfly, direction, {}, mine);
                ADD_FAILURE() << "expected an error";
            } catch (const Error& error) {
                const std::string number = std::to_string(failing);
                EXPECT_EQ(error.what(), "rank " + number + ": broken " + number);
            }
        }
    }
}

TEST_F(ButterflyMessagesTest, end_where_a_rank_fails_in_a_pass_and_tell_of_it_in_the_next) {
    // Payloads that do not fit together: the first rank that joins two fails there.
    const auto refuse = [](std::span<const double>, std::span<const double>, std::vector<double>&) {
        throw Error(ErrorCode::internal, "no join");
    };
    if (num_ranks() == 1) return;
    Butterfly butterfly(rank(), num_ranks(), refuse);
    add_all(butterfly, 3000);
    messages.run(butterfly, Butterfly::to_owners, {}, self);
    try {
        messages.run(butterfly, Butterfly::back, {}, self);
        ADD_FAILURE() << "expected an error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("no join"), std::string::npos) << error.what();
    }
}

TEST_F(ButterflyMessagesTest, tell_all_ranks_by_way_of_rank_0_what_failed_on_one_before) {
    Butterfly butterfly(rank(), num_ranks(), add_up, Butterfly::Way::central);
    for (int failing = 0; failing < num_ranks(); ++failing) {
        Participant mine{self.comm};
        butterfly.clear();
        butterfly.add(5, 0, std::vector<double>(2000, 1.0));
        if (rank() == failing) mine.failure = failure_of(ErrorCode::internal, "broken");
        messages.run(butterfly, Butterfly::to_owners, {0, 1.0 + rank()}, mine);
        try {
            messages.run(butterfly, Butterfly::back, {}, mine);
            ADD_FAILURE() << "expected an error";
        } catch (const Error& error) {
            EXPECT_EQ(error.what(), "rank " + std::to_string(failing) + ": broken");
        }
    }
}

TEST_F(ButterflyMessagesTest, bring_records_to_rank_0_and_what_it_tells_to_all) {
    Butterfly butterfly(rank(), num_ranks(), add_up, Butterfly::Way::central);
    for (const std::size_t length : {1U, 0U, 20000U}) {
        butterfly.clear();
        butterfly.add(5, 0, std::vector<double>(length, 1.0));
        messages.run(butterfly, Butterfly::to_owners, {0, 1.0 + rank()}, self);
        if (rank() == 0) {
            EXPECT_EQ(butterfly.flags()[1], num_ranks());
            const Record all = butterfly.owned().read().next();
            EXPECT_EQ(all.payload.size(), length);
            EXPECT_EQ(std::ranges::count(all.payload, num_ranks()), std::ssize(all.payload));
            butterfly.answer(5, std::vector<double>(length + 1, 7.0));
        }
        messages.run(butterfly, Butterfly::back, {0, rank() == 0 ? 0.5 : 9}, self);
        EXPECT_EQ(butterfly.flags()[1], 0.5) << "as rank 0 has it";
        const Record answer = butterfly.answers().read().next();
        EXPECT_EQ(answer.payload.size(), length + 1);
        EXPECT_EQ(std::ranges::count(answer.payload, 7.0), std::ssize(answer.payload));
    }
}

}  // namespace
}  // namespace rrcb
