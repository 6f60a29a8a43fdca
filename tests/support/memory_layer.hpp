#pragma once

#include <cstddef>

/// The program's allocations, which are counted, and of which chosen ones fail; linked in tests
/// only. The counts are those of the thread that asks.
namespace memory_layer {

enum class Shortage {
    once,    ///< the one allocation fails
    lasting  ///< and all after it
};

/// Makes the `number`-th allocation from now on, counted from 1, fail on this rank; 0 fails none.
/// Counted are those by operator new, and where next_fails is asked.
void fail_allocation(long number, Shortage shortage = Shortage::once);

/// From here on no allocation fails nor is counted, until fail_allocation.
void end_shortage();

/// Counts an allocation by other means; true when it is to fail.
bool next_fails(std::size_t bytes = 0);

/// How many allocations were counted since fail_allocation, and the bytes that were asked for.
long counted_allocations();
long counted_bytes();

/// How many blocks of operator new are in use, and their bytes.
long live_blocks();
long live_bytes();

/// Most bytes that blocks of operator new had in use at a time since restart_peak, beyond those in
/// use then.
long peak_bytes();
void restart_peak();

}  // namespace memory_layer
