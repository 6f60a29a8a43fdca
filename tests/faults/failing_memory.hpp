#pragma once

#include "../support/common.hpp"
#include "memory_layer.hpp"
#include "ranks.hpp"

namespace rrcb::test {

/// A call whose allocations fail one after the other.
class FailingMemory {
  public:
    struct Codes {
        int success;
        int out_of_memory;
    };

    /// `call` returns a code; `expect_result` follows each call that succeeds.
    FailingMemory(Codes codes, std::function<int()> call, std::function<void()> expect_result)
        : codes_(codes), call_(std::move(call)), expect_result_(std::move(expect_result)) {}

    /// Each allocation fails on the first, a middle and the last rank, by itself and with all after
    /// it. All ranks must then get the same code, and be out of memory unless the call can do
    /// without; the call after it must succeed. Nothing may leak.
    void run() {
        // What is kept for later calls does not count.
        fail(0, 0, memory_layer::Shortage::once);
        succeed();
        const long live_before = memory_layer::live_blocks();
        const int step = num_ranks() > 3 ? 11 : 1;  // few ranks try all, more of them a sample
        for (const int faulty : std::set{0, num_ranks() / 2, num_ranks() - 1}) {
            const int num_allocations = largest(rank() == faulty ? num_allocations_ : 0);
            ASSERT_GT(num_allocations, 0);
            int num_failed = 0;
            for (const auto shortage :
                 {memory_layer::Shortage::once, memory_layer::Shortage::lasting})
                for (int number = 1; number <= num_allocations; number += step)
                    num_failed += fail(faulty, number, shortage);
            EXPECT_GT(num_failed, 0);
        }
        EXPECT_EQ(memory_layer::live_blocks(), live_before);
    }

  private:
    int call(long number, memory_layer::Shortage shortage) {
        memory_layer::fail_allocation(number, shortage);
        const int code = call_();
        num_allocations_ = static_cast<int>(memory_layer::counted_allocations());
        memory_layer::fail_allocation(0);
        return code;
    }

    void succeed() {
        ASSERT_EQ(call(0, memory_layer::Shortage::once), codes_.success);
        expect_result_();
    }

    /// 1 when the call failed.
    int fail(int faulty, int number, memory_layer::Shortage shortage) {
        SCOPED_TRACE(testing::Message()
                     << "rank " << faulty << ", allocation " << number
                     << (shortage == memory_layer::Shortage::once ? "" : " and all after it"));
        const int code = call(rank() == faulty ? number : 0, shortage);
        EXPECT_TRUE(same_on_all_ranks(code)) << code;
        if (code == codes_.success) {
            expect_result_();
            return 0;
        }
        EXPECT_EQ(code, codes_.out_of_memory);
        succeed();
        return 1;
    }

    Codes codes_;
    std::function<int()> call_;
    std::function<void()> expect_result_;
    int num_allocations_ = 0;  ///< of the last call
};

}  // namespace rrcb::test
