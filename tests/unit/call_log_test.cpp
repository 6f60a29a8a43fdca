#include "collective/call_log.hpp"

#include "../support/common.hpp"

#include <initializer_list>

namespace rrcb {
namespace {

CallRecord record_of(std::initializer_list<CallName> calls) {
    CallRecord record;
    for (const CallName call : calls) record.add(call);
    return record;
}

TEST(CallLog, finds_the_lowest_rank_that_made_another_call_than_rank_0) {
    const CallRecord most = record_of({CallName::balance, CallName::plan});
    const CallRecord other = record_of({CallName::balance, CallName::transfer, CallName::plan});
    const auto found = find_different_calls(std::vector{most, most, other, other});
    ASSERT_TRUE(found);
    EXPECT_EQ(
        text_of(*found),
        "rank 0 calls plan, rank 2 calls transfer; every rank must make the same calls in the "
        "same order");
}

TEST(CallLog, blames_no_rank_that_has_made_fewer_calls_so_far) {
    const CallRecord ahead = record_of({CallName::balance, CallName::plan});
    EXPECT_FALSE(find_different_calls(std::vector{ahead, record_of({CallName::balance})}));
    EXPECT_FALSE(find_different_calls(std::vector{ahead, CallRecord{}}));
}

TEST(CallLog, forgets_calls_that_all_ranks_have_left) {
    std::vector<CallRecord> known(2);
    for (std::uint32_t k = 0; k < 3 * CallRecord::num_kept; ++k)
        for (CallRecord& one : known) one.add(k % 3 == 0 ? CallName::plan : CallName::transfer);
    EXPECT_FALSE(find_different_calls(known));
    known[0].add(CallName::sums);
    known[1].add(CallName::remap);
    ASSERT_TRUE(find_different_calls(known));
    EXPECT_EQ(find_different_calls(known)->calls, (std::array{CallName::sums, CallName::remap}));
}

TEST(CallLog, has_a_tag_for_each_kind_of_message_and_call_that_every_mpi_allows) {
    std::set<int> tags;
    CallLog log;
    for (std::uint32_t k = 0; k < 2 * CallRecord::num_kept; ++k) {
        log.add(static_cast<CallName>(1 + k % 3));
        for (int kind = 1; kind < 16; ++kind) tags.insert(log.tag(kind));
    }
    EXPECT_EQ(tags.size(), 15 * 2 * CallRecord::num_kept);
    EXPECT_GE(*tags.begin(), 16);
    EXPECT_LT(*tags.rbegin(), 32767);
}

}  // namespace
}  // namespace rrcb
